"""The letters of the IPA chart and what each of them does: manner, place, height, backness, rounding.

The chart itself (International Phonetic Association, revised to 2020) with the letters for Swedish sj, Mandarin apical
vowels and alveolo-palatals that sinologists add. Voicing is left out: the face does not show it.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from functools import cache

PLACES = (
    "bilabial", "labiodental", "dental", "alveolar", "postalveolar", "retroflex", "alveolopalatal", "palatal", "velar", "uvular",
    "pharyngeal", "glottal",
)  # fmt: skip

# Columns are PLACES; a dot is an empty cell.
_CONSONANTS = """
plosive      pb .  .  td .  ʈɖ .  cɟ kɡ qɢ ʡ    ʔ
implosive    ɓ  .  .  ɗ  .  ᶑ  .  ʄ  ɠ  ʛ  .    .
nasal        m  ɱ  .  n  .  ɳ  ȵ  ɲ  ŋ  ɴ  .    .
click        ʘ  .  ǀ  ǃ  .  .  .  ǂ  .  .  .    .
trill        ʙ  .  .  r  .  .  .  .  .  ʀ  .    .
tap          .  ⱱ  .  ɾ  .  ɽ  .  .  .  .  .    .
fricative    ɸβ fv θð sz ʃʒ ʂʐ ɕʑ çʝ xɣ χʁ ħʕʜʢ hɦ
lateral      .  .  .  lɫɬɮɺǁ . ɭ .  ʎ  ʟ  .  .    .
approximant  .  ʋ  .  ɹ  .  ɻ  .  j  ɰ  .  .    .
"""
# Front, central, back; in each cell the unrounded letter, then the rounded one.
_VOWELS = """
close       iy ɨʉ ɯu
near-close  ɪʏ ᵻᵿ .ʊ
close-mid   eø ɘɵ ɤo
mid         .. ə. ..
open-mid    ɛœ ɜɞ ʌɔ
near-open   æ. ɐ. ..
open        aɶ .. ɑɒ
"""
# One letter for several, or another letter for the same sound.
_SPELLINGS = str.maketrans(
    {
        "g": "ɡ", "ʦ": "ts", "ʣ": "dz", "ʧ": "tʃ", "ʤ": "dʒ", "ʨ": "tɕ", "ʥ": "dʑ", "ꭧ": "tʂ", "ꭦ": "dʐ", "ᴀ": "a", "ɚ": "ə˞",
        "ɝ": "ɜ˞", "ǝ": "ə",
    }
)  # fmt: skip


_SHOWN = "\u0361\u035c˞"


@dataclass(frozen=True, slots=True)
class Letter:
    """What one letter says of mouth and tongue.

    *manner* is ``vowel`` or a manner of consonants; *place* names a place of consonants. *height* runs from 0 (close) to
    1 (open) and *back* from 0 (front) to 1 (back), for vowels.
    """

    letter: str
    manner: str
    place: str = ""
    height: float = 0.0
    back: float = 0.0
    rounded: bool = False
    rhotic: bool = False
    syllabic: bool = False

    @property
    def vowel(self) -> bool:
        """Whether this is a vowel."""
        return self.manner == "vowel"

    @property
    def glide(self) -> bool:
        """Whether this is one of the consonants j, w and ɥ, which are vowels to the lips."""
        return self.letter in ("j", "w", "ɥ")


def _consonant_letters() -> dict[str, Letter]:
    found: dict[str, Letter] = {}
    for line in _CONSONANTS.split("\n")[1:-1]:
        manner, *cells = line.split()
        for place, cell in zip(PLACES, cells, strict=True):
            found |= {letter: Letter(letter, manner, place) for letter in cell if letter != "."}
    found |= {letter: Letter(letter, "approximant", "labial-velar", rounded=True) for letter in "wʍ"}
    found["ɥ"] = Letter("ɥ", "approximant", "labial-palatal", rounded=True)
    found["ɧ"] = Letter("ɧ", "fricative", "velar", rounded=True)
    return found


def _vowel_letters() -> dict[str, Letter]:
    found: dict[str, Letter] = {}
    rows = _VOWELS.split("\n")[1:-1]
    for height, line in enumerate(rows):
        for back, cell in enumerate(line.split()[1:]):
            for rounded, letter in enumerate(cell):
                found[letter] = Letter(letter, "vowel", "", height / (len(rows) - 1), back / 2, bool(rounded))
    del found["."]
    # Apical vowels: the tongue of z and of a retroflex, the lips of i or (rounded) of y.
    found |= {letter: Letter(letter, "vowel", "", 0.0, 0.0, letter in "ʮʯ") for letter in "ɿʅʮʯ"}
    return found


LETTERS = _consonant_letters() | _vowel_letters()


@cache
def read_segment(text: str) -> tuple[tuple[Letter, ...], bool]:
    """The letters of an IPA segment, diacritics applied or dropped, and whether a tie bar joins them.

    Length, tone, stress, nasality, voice and secondary articulation are dropped: they don't change what is seen. Letters
    that the chart does not know are dropped too; a text without any known letter gives no letters.
    """
    plain = unicodedata.normalize("NFD", text).replace("c\u0327", "ç").translate(_SPELLINGS)
    letters: list[Letter] = []
    for sign in plain:
        if sign in LETTERS:
            letters.append(LETTERS[sign])
        elif letters and sign in "˞\u0329\u030d":
            last = letters[-1]
            rhotic, syllabic = last.rhotic or sign == "˞", last.syllabic or sign != "˞"
            letters[-1] = Letter(last.letter, last.manner, last.place, last.height, last.back, last.rounded, rhotic, syllabic)
    return tuple(letters), bool(set(plain) & set("\u0361\u035c"))


def without_diacritics(segment: str) -> str:
    """*segment* with its letters, tie bar and r colour only: what is left is all that shows."""
    plain = unicodedata.normalize("NFD", segment).replace("c\u0327", "ç")
    return "".join(
        sign for sign in plain if sign in _SHOWN or not (unicodedata.combining(sign) or unicodedata.category(sign) in ("Lm", "Sk"))
    )
