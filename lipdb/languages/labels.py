"""Labels of espeak to IPA segments: what is one phone, what is several, and what no chart knows."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

from lipdb.phones.articulation import classify
from lipdb.phones.letters import LETTERS, LIPS, Letter
from lipdb.phones.segments import read_segment, spelled

_TONES = re.compile(r"(?<=.)[0-9]+$")
THIRD = "ɜ"
"""How espeak writes the digit of the third tone: it turns every sign of its phonemes into IPA, tones too."""
_TONES_WITH_3 = re.compile(rf"(?<=.)[0-9{THIRD}]+$")
_LENGTH = re.compile("[ːˑ]")
# Where a voice gives no IPA, espeak writes its own mnemonic: Kirshenbaum's ASCII, of which small letters are IPA.
_MNEMONICS = str.maketrans("ADEINOSTUVXZΦ", "ɑðɛɪŋɔʃθʊʌχʒɸ")


@dataclass(frozen=True, slots=True)
class Reading:
    """One label: the IPA *segments* that it stands for (none: nothing is known of it), its *tone* as it was written, and
    what of it is no IPA (*strange*).
    """

    label: str
    segments: tuple[str, ...]
    tone: str = ""
    strange: str = ""

    @property
    def bare(self) -> str:
        """The label without its tone."""
        return self.label.removesuffix(self.tone)

    @property
    def plain(self) -> bool:
        """Whether it is one segment, written as the IPA writes it."""
        return len(self.segments) == 1 and not self.strange


def has_tones(labels: Iterable[str]) -> bool:
    """Whether these are labels of a language with tones, whose numbers stand behind vowels."""
    return sum(_TONES.search(label) is not None for label in labels) >= 2


def read_espeak(label: str, *, tonal: bool) -> Reading:
    """Take *label* apart. Stress and length are left out, as they are attributes; so is the tone, if the language is *tonal*.

    Two vowels in one label are a diphthong, a stop with its release is an affricate, a nasal with a stop a prenasal; of
    anything else each letter is a segment of its own.
    """
    tones = _TONES_WITH_3 if tonal else _TONES
    found = tones.search(label)
    bare = _LENGTH.sub("", spelled(_undoubled(tones.sub("", label)).translate(_MNEMONICS)))
    read = read_segment(bare)
    ascii_signs = "".join(sign for sign in label if (sign.isascii() and not sign.isalnum()) or sign.isupper())
    strange = ascii_signs + "".join(sign for sign in read.strange + read.foreign if sign not in ascii_signs)
    units = _units(bare)
    return Reading(label, tuple(_named(group) for group in _grouped(units)), found[0] if found else "", strange)


def _undoubled(label: str) -> str:
    """``ə`` for ``əə``: espeak writes some lengthened vowels twice."""
    half = len(label) // 2
    return label[:half] if label and label[:half] == label[half:] else label


def _units(text: str) -> list[str]:
    """Letters of the IPA chart with the marks behind them; signs that are no IPA are left out."""
    units: list[str] = []
    for sign in text:
        if sign in LETTERS:
            units.append(sign)
        elif units and not sign.isascii() and (unicodedata.combining(sign) or unicodedata.category(sign) in ("Lm", "Sk")):
            units[-1] += sign
    return units


def _grouped(units: list[str]) -> list[list[str]]:
    groups: list[list[str]] = []
    for unit in units:
        if groups and _together(groups[-1], unit):
            groups[-1].append(unit)
        else:
            groups.append([unit])
    return groups


def _together(group: list[str], unit: str) -> bool:
    """Whether *unit* belongs to the phone that *group* began."""
    first, last, letter = _letter(group[0]), _letter(group[-1]), _letter(unit)
    if last.tied or first.vowel:
        return last.tied or letter.vowel
    if unit[0] == "h":
        return first.manner == "plosive"
    if letter.vowel or last.manner not in ("plosive", "nasal"):
        return False
    if last.manner == "nasal":
        return letter.manner in ("plosive", "fricative") and len(group) == 1 and _same_place(last, letter)
    if letter.manner not in ("fricative", "lateral"):
        return False
    # Where the rule sees one sound in both, its verdict speaks of both.
    found = classify(group[-1] + unit)
    return found is not None and (len(found.common) == 1 or {last.place, letter.place} <= set(LIPS))


def _same_place(one: Letter, other: Letter) -> bool:
    joined = classify(one.letter + other.letter)
    alone = classify(other.letter)
    return joined is not None and alone is not None and joined.common == alone.common


def _letter(unit: str) -> Letter:
    return read_segment(unit).letters[0]


def _named(group: list[str]) -> str:
    """The phone's name: IPA in composed form, with ``ʰ`` for the breath behind a stop."""
    text = "".join("ʰ" + unit[1:] if unit[0] == "h" and i else unit for i, unit in enumerate(group))
    return unicodedata.normalize("NFC", text)
