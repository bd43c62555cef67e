"""The letters of the IPA chart and what each of them does: manner, place, height, backness, rounding.

The chart itself (International Phonetic Association, revised to 2020) with the letters for Swedish sj, Mandarin apical
vowels and alveolo-palatals that sinologists add. Voicing is left out: the face does not show it.
"""

from __future__ import annotations

from dataclasses import dataclass

PLACES = (
    "bilabial", "labiodental", "dental", "alveolar", "postalveolar", "retroflex", "alveolopalatal", "palatal", "velar", "uvular",
    "pharyngeal", "glottal",
)  # fmt: skip
LIPS = ("bilabial", "labiodental")
TIP = ("dental", "alveolar", "postalveolar", "retroflex", "alveolopalatal")
HUSH = ("postalveolar", "retroflex", "alveolopalatal", "palatal")
BACK = ("palatal", "velar", "uvular")

# Columns are PLACES; a dot is an empty cell.
_CONSONANTS = """
plosive      pb .  .  td .  ʈɖ ȶȡ cɟ kɡ qɢ ʡ    ʔ
implosive    ɓ  .  .  ɗ  .  ᶑ  .  ʄ  ɠ  ʛ  .    .
nasal        m  ɱ  .  n  .  ɳ  ȵ  ɲ  ŋ  ɴ  .    .
click        ʘ  .  ǀ  ǃ  .  𝼊  .  ǂ  .  .  .    .
trill        ʙ  .  .  r  .  .  .  .  .  ʀ  .    .
tap          .  ⱱ  .  ɾ  .  ɽ  .  .  .  .  .    .
fricative    ɸβ fv θð sz ʃʒ ʂʐ ɕʑ çʝ xɣ χʁ ħʕʜʢ hɦ
lateral      .  .  .  lɫɬɮɺ . ɭꞎ𝼅𝼈 ȴ ʎ𝼆 ʟ𝼄 .  .    .
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


@dataclass(frozen=True, slots=True)
class Letter:
    """What one letter, with its diacritics, says of mouth and tongue.

    *manner* is ``vowel`` or a manner of consonants; *place* names a place of consonants. *height* runs from 0 (close) to
    1 (open) and *back* from 0 (front) to 1 (back), for vowels. *labial* is what labialises a consonant beside its own
    place (``w``, ``ɥ`` or nothing), *tied* whether a tie bar joins it to the next letter, *sure* what its diacritics
    leave of the certainty (0..1), *text* how it is written.
    """

    letter: str
    manner: str
    place: str = ""
    height: float = 0.0
    back: float = 0.0
    rounded: bool = False
    rhotic: bool = False
    syllabic: bool = False
    glide: bool = False
    labial: str = ""
    tied: bool = False
    sure: float = 1.0
    text: str = ""

    @property
    def vowel(self) -> bool:
        """Whether this is a vowel."""
        return self.manner == "vowel"


def _consonant_letters() -> dict[str, Letter]:
    found: dict[str, Letter] = {}
    for line in _CONSONANTS.split("\n")[1:-1]:
        manner, *cells = line.split()
        for place, cell in zip(PLACES, cells, strict=True):
            found |= {letter: Letter(letter, manner, place) for letter in cell if letter != "."}
    # The glides are vowels to the lips.
    found["j"] = Letter("j", "approximant", "palatal", glide=True)
    found |= {letter: Letter(letter, "approximant", "labial-velar", rounded=True, glide=letter == "w") for letter in "wʍ"}
    found["ɥ"] = Letter("ɥ", "approximant", "labial-palatal", rounded=True, glide=True)
    found["ǁ"] = Letter("ǁ", "lateral click", "alveolar")
    # Swedish sj: whatever the tongue does, the lips come forward as for sh.
    found["ɧ"] = Letter("ɧ", "fricative", "postalveolar", rounded=True)
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
