"""Read an IPA segment: its letters with their diacritics applied, whatever way it was typed."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache

from lipdb.phones.letters import BACK, LETTERS, LIPS, TIP, Letter

# Pairs: what may be written, and how the chart writes it. Ligatures; older letters and letters for voiceless implosives and
# palatalised consonants; letters of Africanists, sinologists and for disordered speech; letters of other alphabets and signs
# that look the same; Americanist letters; marks.
_OTHER_SPELLINGS = """
ʦ ts  ʣ dz  ʧ tʃ  ʤ dʒ  ʨ tɕ  ʥ dʑ  ꭧ tʂ  ꭦ dʐ  ʪ ls  ʫ lz  ɚ ə˞  ɝ ɜ˞
ᴀ a  ǝ ə  ꞵ β  ꭓ χ  ʚ ɞ  ɩ ɪ  ɷ ʊ  ɼ r̝  ʆ ʃ  ʓ ʒ  ƞ n  ł ɫ  ȷ j  ʗ ǃ  ʇ ǀ  ʖ ǁ  ƥ p  ƭ t  ƈ c  ƙ k  ʠ q
ᶀ b  ᶁ d  ᶂ f  ᶃ ɡ  ᶄ k  ᶅ l  ᶆ m  ᶇ n  ᶈ p  ᶉ r  ᶊ s  ᶋ ʃ  ᶌ v  ᶍ x  ᶎ z  ƫ t
ȹ p\u032a  ȸ b\u032a  ᴇ ɛ  ʬ ʘ  ʭ ǀ
g ɡ  α ɑ  ε ɛ  γ ɣ  δ ð  ϑ θ  φ ɸ  ϕ ɸ  υ ʊ  ι ɪ  λ ʎ  ∫ ʃ  ? ʔ
ә ə  а a  е e  о o  с c  р p  х x  у y  і i  ѕ s  ј j  һ h  ӡ ʒ
! ǃ  | ǀ  || ǁ  ‖ ǁ  = ǂ  ≠ ǂ  ‡ ǂ  ⊙ ʘ  ☉ ʘ
č tʃ  ǰ dʒ  š ʃ  ž ʒ  ř r̝  ƛ tɬ  þ θ  ƕ hw
: ː  ' ʼ  ’ ʼ  ‘ ʼ  ′ ʼ  ` ʼ  ´ ʼ  ʻ ʰ  ˖ \u031f  ˗ \u0320  ˔ \u031d  ˕ \u031e  ʵ ˞  ʴ ˞  ʳ ˞  ‿ \u0361  ⁀ \u0361  \u035d \u0361
"""
_words = unicodedata.normalize("NFD", _OTHER_SPELLINGS).split()
_SPELLINGS = dict(zip(_words[::2], _words[1::2], strict=True))
_ANY_SPELLING = re.compile("|".join(re.escape(spelling) for spelling in sorted(_SPELLINGS, key=len, reverse=True)))
_BRACKETS = re.compile(r"^\s*(?:/(.*)/|\[(.*)\]|⟨(.*)⟩)\s*$")
_STRESS = re.compile(r"^[ˈˌ'’\",]+(?=.)")
_TONE = re.compile(r"(?<=.)[0-9⁰¹²³⁴⁵⁶⁷⁸⁹]+$")

TIES = "\u0361\u035c"
RHOTIC = "˞"
# What is heard and not seen, and the signs for it.
_UNSEEN = {
    "length": "ːˑ\u0306",
    "stress": "ˈˌ.",
    "tone": "˥˦˧˨˩꜒꜓꜔꜕꜖ꜛꜜ↑↓↗↘\u030b\u0301\u0304\u0300\u030f\u030c\u0302\u1dc4\u1dc5\u1dc6\u1dc7\u1dc8\u1dc9",
    "voice": "\u0325\u030a\u032c\u0330\u0324",
    "the glottis": "ʼˀ\u0348\u0349",
    "nasality": "\u0303\u0328\u034a\u034b\u034c",
    "tongue root and blade": "ˤˠʲ\u0318\u0319\u033a\u033b\u0334\u0347\u034e",
    "release": "\u031a",
}
_UNSEEN_SIGNS = {sign: what for what, signs in _UNSEEN.items() for sign in signs}
_ACCOMPANIES = "breath, onset or release"
_STEP = 0.06
"""How far a mark of height moves a vowel: less than half a row of the chart, so no mark alone makes another vowel of it."""


def _moved(letter: Letter, height: float = 0.0, back: float = 0.0) -> Letter:
    if not letter.vowel:
        return letter
    place = (min(max(value, 0.0), 1.0) for value in (letter.height + height, letter.back + back))
    return replace(letter, height=next(place), back=next(place), sure=letter.sure * 0.95)


def _raised(letter: Letter) -> Letter:
    if letter.letter in ("r", "ɻ"):  # Czech ř, and the approximant that becomes a retroflex hush.
        return replace(letter, manner="fricative", place="postalveolar", sure=0.7)
    return _moved(letter, height=-_STEP)


def _lowered(letter: Letter) -> Letter:
    if letter.manner == "plosive" and letter.place == "bilabial":  # Lips that come close and do not shut, as in Spanish.
        return replace(letter, manner="fricative")
    return _moved(letter, height=_STEP)


def _towards_schwa(letter: Letter) -> Letter:
    return _moved(letter, (0.5 - letter.height) * 0.2, (0.5 - letter.back) * 0.2)


def _labialised(by: str) -> Callable[[Letter], Letter]:
    def apply(letter: Letter) -> Letter:
        if letter.vowel or letter.letter == "ɰ":
            return replace(letter, rounded=True, sure=letter.sure * 0.8) if by or letter.back or letter.letter == "ɰ" else letter
        return replace(letter, labial=by)

    return apply


_MARKS: dict[str, Callable[[Letter], Letter]] = {
    "\u031d": _raised,
    "\u031e": _lowered,
    "\u031f": lambda x: _moved(x, back=-0.25),
    **dict.fromkeys("\u0320\u0331", lambda x: _moved(x, back=0.25)),
    "\u0308": lambda x: _moved(x, back=(0.5 - x.back) / 2),
    "\u033d": _towards_schwa,
    # More rounded, less rounded, spread: doubt where that speaks against the letter.
    **dict.fromkeys("\u0339\u0357", lambda x: x if x.rounded else replace(x, sure=x.sure * 0.7)),
    **dict.fromkeys("\u031c\u0351\u034d", lambda x: replace(x, sure=x.sure * 0.8) if x.rounded else x),
    **dict.fromkeys("\u0329\u030d", lambda x: replace(x, syllabic=True)),
    **dict.fromkeys("\u032f\u0311", lambda x: replace(x, glide=x.vowel)),
    RHOTIC: lambda x: replace(x, rhotic=x.vowel),
    **dict.fromkeys("\u032a\u0346", lambda x: replace(x, place="labiodental") if x.place == "bilabial" else x),
    "\u033c": lambda x: replace(x, place="linguolabial") if x.place in (*TIP, "bilabial") else x,
    "\u032b": _labialised("w"),
    "ʷ": _labialised("w"),
    "ᶣ": _labialised("ɥ"),
    "ᵝ": _labialised(""),
    **dict.fromkeys(TIES, lambda x: replace(x, tied=True)),
}


@dataclass(frozen=True, slots=True)
class Segment:
    """An IPA segment: its *letters*, what its marks say that does not show (*unseen*), marks that nothing is known of (*strange*),
    and signs that are no IPA at all (*foreign*).
    """

    letters: tuple[Letter, ...]
    unseen: tuple[str, ...] = ()
    strange: str = ""
    foreign: str = ""


def spelled(text: str) -> str:
    """*text* without brackets, stress and tone numbers, decomposed (NFD), with one spelling for what is typed in several ways."""
    if found := _BRACKETS.match(text):
        text = next(part for part in found.groups() if part is not None)
    text = _TONE.sub("", _STRESS.sub("", "".join(text.split())))
    text = unicodedata.normalize("NFD", text).replace("c\u0327", "ç")
    return _ANY_SPELLING.sub(lambda found: _SPELLINGS[found[0]], text)


@cache
def read_segment(text: str) -> Segment:
    """Read an IPA segment.

    Length, tone, stress, nasality, voice, breath and most secondary articulations are left out: they don't change what
    is seen. What labialises a consonant stays, and so does what moves a vowel.
    """
    letters: list[Letter] = []
    unseen: list[str] = []
    strange, foreign = "", ""
    for sign in spelled(text):
        if sign in LETTERS:
            letters.append(replace(LETTERS[sign], text=sign))
        elif sign in _MARKS and (letters or sign != "ʷ"):
            if letters:
                letters[-1] = replace(_MARKS[sign](letters[-1]), text=letters[-1].text + sign)
        elif (small := _letter_made_small(sign)) is not None:
            follows = _is_heard(letters[-1], small) if letters else sign == "ʷ"
            letters += [replace(small, glide=small.vowel, text=sign)] if follows else []
            unseen += [] if follows else [_UNSEEN_SIGNS.get(sign, _ACCOMPANIES)]
        elif sign in _UNSEEN_SIGNS:
            unseen.append(_UNSEEN_SIGNS[sign])
            if letters:
                letters[-1] = replace(letters[-1], text=letters[-1].text + sign)
        elif unicodedata.combining(sign) or unicodedata.category(sign) in ("Lm", "Sk"):
            strange += sign
        else:
            foreign += sign
    alone = "".join(letter.text for letter in letters) == "ʷ"
    return Segment(() if alone else tuple(letters), tuple(dict.fromkeys(unseen)), strange, foreign)


def _letter_made_small(sign: str) -> Letter | None:
    """The letter that a superscript such as ⁿ or ˢ is made from."""
    plain = unicodedata.normalize("NFKC", sign)
    return LETTERS.get({"g": "ɡ", "ɒ": "ɒ"}.get(plain, plain)) if plain != sign else None


def _is_heard(letter: Letter, small: Letter) -> bool:
    """Whether *small* is a movement of its own after *letter*: the end of a diphthong, or the release of a stop."""
    if letter.vowel:
        return small.vowel
    return (
        letter.manner == "plosive"
        and small.manner == "fricative"
        and any(letter.place in near and small.place in near for near in (LIPS, TIP, BACK))
    )


def without_diacritics(segment: str) -> str:
    """*segment* with its letters, tie bar and r colour only."""
    plain = unicodedata.normalize("NFD", segment).replace("c\u0327", "ç")
    return "".join(
        sign for sign in plain if sign in TIES + RHOTIC or not (unicodedata.combining(sign) or unicodedata.category(sign) in ("Lm", "Sk"))
    )
