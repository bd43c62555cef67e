"""What a label says beside its phone: stress, tone and length are attributes, taken off and kept."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from functools import cache

IPA_NOTATIONS = frozenset({"ipa", "espeak", "mfa"})
"""Notations whose symbols are IPA segments, so the common table of IPA segments can answer for them."""
SAMPA_NOTATIONS = frozenset({"sampa", "xsampa", "sampa_gb", "sppas"})
"""Notations whose symbols are SAMPA or X-SAMPA, which the same table knows too."""

_ARPABET = frozenset({"arpabet", "cmudict"})
_TONE_DIGITS = frozenset({"pinyin"})
_POSITION = re.compile("_[BIES]$")
_PRIMARY, _SECONDARY = "ˈ'\"", "ˌ,%"
_LETTERS = str.maketrans("˥˦˧˨˩⁰¹²³⁴⁵", "54321012345")
# Chao letters of the four tones of Standard Chinese, with common variants (half third, fourth before fourth).
_CONTOURS = {"55": 1, "44": 1, "35": 2, "25": 2, "214": 3, "21": 3, "211": 3, "51": 4, "53": 4, "41": 4}
_ACCENTS = {"\u0304": 1, "\u0301": 2, "\u030c": 3, "\u0300": 4}
NEUTRAL_TONE = 5


@dataclass(frozen=True, slots=True)
class Label:
    """A symbol taken apart: as it is (*text*), without stress and tone (*bare*), and without length as well (*short*).

    Its attributes are as in `lipdb.schedule.Phone`.
    """

    text: str
    bare: str
    short: str
    tone: int = 0
    stress: int = 0
    long: bool = False

    @property
    def forms(self) -> tuple[str, ...]:
        """What to look the symbol up by, the fullest first."""
        return tuple(dict.fromkeys((self.text, self.bare, self.short)))


@cache
def read_label(symbol: str, notation: str) -> Label:
    """Take *symbol* of *notation* apart.

    Stress is a mark in front (``ˈ ˌ``, SAMPA ``" %``, espeak ``' ,``) or ARPAbet's digit 0 to 2, which is read in small letters
    and with Kaldi's place in the word (``hh_B``) as well; tone is pinyin's digit 1 to
    5 (0 counts as 5) or accent, espeak's digits, or Chao letters; length is ``ː`` or ``:``.
    """
    text = unicodedata.normalize("NFC", symbol.strip())
    bare, stress = _take_stress(text, notation)
    bare, tone = _take_tone(bare, notation)
    long = "ː" in bare or (bare.endswith(":") and len(bare) > 1)
    short = bare.replace("ː", "").replace("ˑ", "").removesuffix(":") or bare
    return Label(text, bare, short, tone, stress, long)


def _take_stress(text: str, notation: str) -> tuple[str, int]:
    bare = text.lstrip(_PRIMARY + _SECONDARY) or text
    marks = text[: len(text) - len(bare)]
    stress = 1 if set(marks) & set(_PRIMARY) else 2 if marks else 0
    if notation in _ARPABET:
        bare = _POSITION.sub("", bare.upper())
        if len(bare) > 1 and bare[-1] in "012":
            return bare[:-1], int(bare[-1])
    return bare, stress


def _take_tone(text: str, notation: str) -> tuple[str, int]:
    if notation in _TONE_DIGITS:
        if len(text) > 1 and text[-1] in "012345":
            return text[:-1], int(text[-1]) or NEUTRAL_TONE
        letters = unicodedata.normalize("NFD", text)
        tone = next((_ACCENTS[sign] for sign in letters if sign in _ACCENTS), 0)
        return unicodedata.normalize("NFC", "".join(sign for sign in letters if sign not in _ACCENTS)), tone
    if notation == "espeak" and (bare := text.rstrip("0123456789")) and (number := text[len(bare) :]):
        # The number of the tone, as in Vietnamese; in Mandarin its contour.
        return bare, int(number) if len(number) == 1 else _CONTOURS.get(number, 0)
    bare = text.rstrip("˥˦˧˨˩⁰¹²³⁴⁵")
    contour = text[len(bare) :].translate(_LETTERS)
    if not bare or not contour:
        return text, 0
    if len(contour) == 1 and text[-1] in "⁰¹²³⁴⁵":
        return bare, int(contour) or NEUTRAL_TONE
    return bare, _CONTOURS.get(contour, NEUTRAL_TONE if len(contour) == 1 else 0)
