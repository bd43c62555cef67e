"""IPA segments to common phones, by what lips, jaw and tongue visibly do.

Rules by articulation. They propose the rows of ``ipa.tsv`` and answer for symbols that no table knows; a person's row
wins over them. ``benchmarks/mapping.py`` scores them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

from lipdb.phones.letters import BACK, HUSH, LIPS, TIP, Letter
from lipdb.phones.segments import read_segment

NEUTRAL = "ah"


@dataclass(frozen=True, slots=True)
class Verdict:
    """One *common* phone, how sure the rule is (0 to 1), a phrase that says why, and the letters (*text*) that it stands for.

    The rounding of kʷ stands for no letter. *other* is the common phone that would also do, where the rule knows one.
    """

    common: str
    confidence: float
    reason: str
    text: str = ""
    other: str = ""


@dataclass(frozen=True, slots=True)
class Classified:
    """The common phones of a segment, how sure the rules are (0 to 1), a sentence that says why, and each verdict."""

    common: tuple[str, ...]
    confidence: float
    reason: str
    verdicts: tuple[Verdict, ...] = ()


# Manners (empty: any), places (empty: any), common phone, what would also do (may be empty), confidence, reason; the first
# that fits wins.
_Rule = tuple[tuple[str, ...], tuple[str, ...], str, str, float, str]
_RULES: tuple[_Rule, ...] = (
    (("plosive", "implosive", "nasal", "click", "trill"), ("bilabial",), "bmp", "", 1.0, "the lips close"),
    ((), ("labiodental",), "f", "", 1.0, "the lower lip meets the upper teeth"),
    ((), ("bilabial",), "f", "bmp", 0.7, "the lips come close but do not shut"),
    ((), ("linguolabial",), "th", "d", 0.6, "the tongue is seen at the upper lip"),
    ((), ("labial-velar",), "w", "", 1.0, "the lips round and come forward"),
    ((), ("labial-palatal",), "ue", "", 1.0, "the lips round over a front tongue"),
    (("lateral", "lateral click"), (), "l", "d", 0.9, "the tongue lets air pass at its sides"),
    (("approximant",), ("palatal",), "sh", "ih", 0.7, "the paper puts the consonant of yard here; to the lips alone it is an ih"),
    (("approximant",), TIP, "r", "", 0.9, "the tongue curls up without touching"),
    (("trill",), ("alveolar",), "r", "d", 0.7, "the tongue tip trills"),
    (("fricative",), ("dental",), "th", "", 1.0, "the tongue tip is seen at the teeth"),
    (("fricative",), ("alveolar",), "z", "", 1.0, "the teeth nearly shut for a hiss"),
    (("fricative",), ("palatal",), "sh", "kg", 0.9, "the teeth nearly shut for a hush, at the palate"),
    (("fricative",), HUSH, "sh", "", 0.9, "the teeth nearly shut for a hush, behind the ridge"),
    (("fricative",), ("pharyngeal", "glottal"), "h", "kg", 0.8, "made in the throat, the mouth is free"),
    (("plosive",), ("pharyngeal", "glottal"), "h", "kg", 0.6, "shut in the throat only, the mouth is free"),
    (("nasal", "click"), (), "d", "", 0.9, "the tongue shuts the mouth, as for n or ng"),
    ((), TIP, "d", "", 1.0, "the tongue tip touches behind the teeth"),
    ((), ("palatal",), "kg", "d", 0.7, "the middle of the tongue rises to the palate"),
    (("fricative", "trill"), BACK, "kg", "h", 0.9, "the back of the tongue rises"),
    ((), (), "kg", "", 0.9, "the back of the tongue rises"),
)


def _consonant(letter: Letter) -> Verdict:
    if letter.syllabic and letter.manner == "approximant" and letter.place in TIP:
        return Verdict("er", 0.6, "an r that carries the syllable; where it stands for an apical vowel, ih", letter.text, "ih")
    if letter.letter == "ɰ" and letter.rounded:
        return Verdict("w", 0.8, "a w with compressed lips", letter.text)
    for manners, places, common, other, confidence, reason in _RULES:
        if (not manners or letter.manner in manners) and (not places or letter.place in places):
            return Verdict(common, confidence * letter.sure, reason, letter.text, other)
    raise AssertionError(f"the last rule fits every consonant, {letter} too")


# Rounded or not, highest height and lowest and highest backness (0..1), common phone, what would also do, confidence, reason;
# the first that fits wins.
_VowelRule = tuple[bool, float, float, float, str, str, float, str]
_VOWEL_RULES: tuple[_VowelRule, ...] = (
    (False, 0.25, 0.0, 0.7, "ih", "", 0.95, "close and unrounded"),
    (False, 0.25, 0.7, 1.0, "ih", "w", 0.7, "close and unrounded, at the back"),
    (False, 0.42, 0.0, 0.4, "eh", "", 0.95, "mid and unrounded, at the front"),
    (False, 0.42, 0.4, 0.7, "eh", "ah", 0.75, "mid and unrounded, not quite at the front"),
    (False, 0.75, 0.0, 0.4, "eh", "", 0.95, "mid and unrounded, at the front"),
    (False, 0.90, 0.0, 1.0, "ah", "", 0.9, "between mid and open, unrounded"),
    (False, 1.00, 0.0, 0.7, "aa", "ah", 0.75, "the jaw wide open; where /a/ is written the vowel is mostly central"),
    (False, 1.00, 0.7, 1.0, "aa", "", 1.0, "the jaw wide open"),
    (True, 0.25, 0.7, 1.0, "w", "", 0.95, "close and rounded, as in too"),
    (True, 0.25, 0.4, 0.7, "w", "ue", 0.8, "close and rounded, further front"),
    (True, 0.60, 0.0, 0.4, "ue", "", 0.85, "rounded at the front"),
    (True, 0.90, 0.0, 0.4, "ue", "ao", 0.6, "rounded at the front, and open"),
    (True, 0.42, 0.4, 1.0, "ow", "ao", 0.8, "mid and rounded, as in go"),
    (True, 1.00, 0.7, 1.0, "ao", "ow", 0.9, "open and rounded, as in dog"),
    (True, 1.00, 0.0, 0.7, "ao", "ue", 0.6, "open and rounded, not at the back"),
)


def _vowel(letter: Letter) -> Verdict:
    if letter.rhotic:
        return Verdict("er", 0.9 * letter.sure, "an r-coloured vowel", letter.text)
    if letter.letter == "ɜ":
        return Verdict("er", 0.6 * letter.sure, "the vowel of fur where no r is said; elsewhere ah", letter.text, "ah")
    for rounded, height, front, back, common, other, confidence, reason in _VOWEL_RULES:
        if letter.rounded == rounded and letter.height <= height and front <= letter.back <= back:
            return Verdict(common, confidence * letter.sure, reason, letter.text, other)
    raise AssertionError(f"the rules fit every vowel, {letter} too")


def _off_glide(letter: Letter) -> Verdict:
    """j, w or ɥ after a vowel: the end of a diphthong that has no class of its own."""
    common = {"j": "ih", "w": "w", "ɥ": "ue"}[letter.letter]
    return Verdict(common, 0.8, "a glide that ends the vowel", letter.text)


# How a diphthong begins and ends, and the class it has (Table 1: ay, aw, oy, ow, and eh for the vowel of ate).
_DIPHTHONGS = {
    "open i": "ay", "open u": "aw", "back i": "oy", "back y": "oy", "back u": "ow", "centre u": "ow", "front i": "eh", "neutral u": "ow",
}  # fmt: skip


def _start(letter: Letter) -> str:
    if not letter.vowel or letter.rhotic or letter.height < 0.2:
        return ""
    if letter.rounded:
        return "back" if letter.back > 0.7 else "centre" if letter.back > 0.4 else ""
    if letter.letter in "əɘɜɤ":
        return "neutral"
    return "front" if letter.back < 0.4 and letter.height < 0.75 else "open"


def _end(letter: Letter) -> str:
    if not letter.vowel:
        return {"j": "i", "w": "u", "ɥ": "y"}[letter.letter] if letter.glide else ""
    if letter.rhotic or letter.height > 0.75:
        return ""
    if letter.rounded:
        return ("y" if letter.back < 0.4 else "u") if letter.height < 0.5 or letter.back < 0.4 else ""
    return "i" if letter.back < 0.4 or letter.height < 0.25 else ""


def _diphthong(first: Letter, second: Letter) -> Verdict | None:
    """The diphthongs that have a class of their own."""
    closing = second.glide or second.height < first.height
    common = _DIPHTHONGS.get(f"{_start(first)} {_end(second)}") if closing else None
    if common is None:
        return None
    return Verdict(common, 0.95, f"a diphthong from {first.letter} to {second.letter}", first.text + second.text)


def _affricate(first: Letter, second: Letter) -> list[Verdict] | None:
    """A stop and its release, or two closures at once, as one sound."""
    if first.vowel or second.vowel or first.manner not in ("plosive", "nasal", "implosive"):
        return None
    text = first.text + second.text
    places = {first.place, second.place}
    closures = second.manner in ("plosive", "nasal", "implosive", "trill")
    if closures and "bilabial" in places and len(places) == 2 and (first.tied or places & {"velar", "uvular"}):
        return [Verdict("bmp", 0.95, "of two closures at once the lips' is seen", text)]
    near = any(places <= set(group) for group in (LIPS, (*TIP, "palatal"), BACK, ("pharyngeal", "glottal")))
    if first.manner != "plosive" or second.manner not in ("fricative", "lateral") or not near:
        return None
    release = _consonant(second)
    if first.place == "bilabial":
        return [_consonant(first), release]
    reason = f"a stop that opens into {second.letter}: {release.reason}"
    return [Verdict(release.common, release.confidence * 0.95, reason, text, release.other)]


def _essential(letters: tuple[Letter, ...]) -> tuple[Letter, ...]:
    """*letters* without those that only accompany another: what is made in the throat, behind a click, or in the nose."""
    if len(letters) < 2 or any(letter.vowel for letter in letters):
        return letters
    if clicks := tuple(letter for letter in letters if "click" in letter.manner):
        return clicks
    mouth = tuple(letter for letter in letters if letter.place != "glottal")
    letters = mouth or letters[:1]
    if len(letters) > 1 and letters[0].manner == "nasal" and letters[1].manner not in ("nasal", "lateral", "approximant"):
        same = any({letters[0].place, letters[1].place} <= set(group) for group in (LIPS, (*TIP, "palatal"), ("velar", "uvular")))
        return letters[1:] if same else letters
    return letters


def released(segment: str) -> tuple[Letter, ...]:
    """The letters of *segment* that are seen: without what only accompanies, and without a stop that opens into a fricative."""
    letters = _essential(read_segment(segment).letters)
    if len(letters) > 1 and letters[0].place not in LIPS and _affricate(letters[0], letters[1]):
        return letters[1:]
    return letters


def _verdicts(letters: tuple[Letter, ...]) -> list[Verdict]:
    found: list[Verdict] = []
    i = 0
    while i < len(letters):
        pair = letters[i : i + 2]
        joined = None
        if len(pair) == 2:
            diphthong = _diphthong(*pair)
            joined = [diphthong] if diphthong else _affricate(*pair)
        found += joined or _single(letters[i], after_vowel=i > 0 and letters[i - 1].vowel)
        i += 2 if joined else 1
        found += _lips(letters[i - 1], found[-1])
    return found


def _single(letter: Letter, *, after_vowel: bool) -> list[Verdict]:
    if not letter.vowel:
        return [_off_glide(letter) if letter.glide and after_vowel else _consonant(letter)]
    verdict = _vowel(letter)
    # The r of ɚ is all there is; that of ɑ˞ comes after an open vowel.
    return [_vowel(replace(letter, rhotic=False)), verdict] if letter.rhotic and letter.letter not in "əɜ" else [verdict]


def _lips(letter: Letter, before: Verdict) -> list[Verdict]:
    """The rounding of kʷ and the like, unless the lips are forward already."""
    if not letter.labial or before.common in ("w", "ue", "sh"):
        return []
    common = "ue" if letter.labial == "ɥ" else "w"
    return [Verdict(common, 0.8, "the lips round as it is let go")]


@cache
def classify(segment: str) -> Classified | None:
    """The common phones of an IPA *segment* by articulation, or None when no letter of it is in the IPA chart.

    One common phone for most, two and more for diphthongs, affricates and clusters that have no class of their own.
    """
    letters = read_segment(segment).letters
    if not letters:
        return None
    kept: list[Verdict] = []
    for verdict in _verdicts(_essential(letters)):
        # A glide beside its own vowel (wu) or a long vowel written twice is one movement.
        if not kept or kept[-1].common != verdict.common:
            kept.append(verdict)
    confidence = round(min(verdict.confidence for verdict in kept), 3)
    return Classified(tuple(v.common for v in kept), confidence, "; ".join(v.reason for v in kept), tuple(kept))
