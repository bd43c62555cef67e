"""A second opinion on an IPA segment's common phone: the nearest of the paper's phonemes by PanPhon's features.

PanPhon (Mortensen et al. 2016, MIT licence) describes some 6,400 segments with 24 phonological features. Its table is read
where it is installed, without importing the package: that would take half a second and pull in pandas. Features weigh
by what can be seen, so voice, nasality and tone count nothing. Without PanPhon there is no second opinion.
"""

from __future__ import annotations

import csv
import unicodedata
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lipdb.phones.segments import RHOTIC, TIES, spelled, without_diacritics

Array = NDArray[np.float64]
_VALUES = {"+": 1.0, "0": 0.0, "-": -1.0}
# How much a feature shows: lips and jaw first, then the tongue that can be seen, the throat and the nose not at all.
_WEIGHTS = {
    "syl": 8, "son": 0.5, "cons": 1, "cont": 1.5, "delrel": 0.25, "lat": 4, "strid": 3, "ant": 1.5, "cor": 2, "distr": 0.75, "lab": 5,
    "hi": 3, "lo": 4, "back": 1.5, "round": 5, "tense": 0.25,
}  # fmt: skip
# The phonemes of the paper's Table 1, and the vowels and the glide that lipdb adds; diphthongs by start and end.
_ANCHORS = {
    "ah": "æ ʌ ə", "aa": "ɑ", "ao": "ɔ", "eh": "e ɛ e-ɪ", "ih": "i ɪ", "w": "w u ʊ", "ow": "o o-ʊ", "aw": "a-ʊ", "oy": "ɔ-ɪ", "ay": "a-ɪ",
    "ue": "y ø ɥ", "h": "h", "r": "ɹ", "l": "l", "z": "s z", "sh": "ʃ t͡ʃ d͡ʒ ʒ j", "th": "θ ð", "f": "f v", "d": "d t n ŋ", "kg": "k ɡ",
    "bmp": "p b m",
}  # fmt: skip


class Opinion(NamedTuple):
    """A common phone and how far off its nearest phoneme is, in weighted features."""

    common: str
    distance: float


class _Anchors(NamedTuple):
    """The phonemes' common phones, and their features at their start and end, shape (N, 2, F)."""

    common: tuple[str, ...]
    features: Array


@cache
def _table() -> dict[str, Array]:
    """PanPhon's segments (NFD) and their weighted features, shape (F,); nothing when it is not installed."""
    spec = find_spec("panphon")
    path = Path(spec.origin).parent / "data" / "ipa_all.csv" if spec and spec.origin else None
    if path is None or not path.is_file():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.reader(file)
        names = next(rows)[1:]
        weights = np.array([_WEIGHTS.get(name, 0.0) for name in names])
        segments, values = zip(*((row[0], [_VALUES[cell] for cell in row[1:]]) for row in rows), strict=True)
    features = np.array(values) * weights
    return dict(zip((unicodedata.normalize("NFD", segment).replace("c\u0327", "ç") for segment in segments), features, strict=True))


@cache
def _anchors() -> _Anchors:
    found = [(common, phoneme) for common, phonemes in _ANCHORS.items() for phoneme in phonemes.split()]
    ends = [phoneme.partition("-")[::2] for _, phoneme in found]
    features = [(_table()[start], _table()[end or start]) for start, end in ends]
    return _Anchors(tuple(common for common, _ in found), np.array(features))


def segments() -> tuple[str, ...]:
    """Every segment that PanPhon knows; none when it is not installed."""
    return tuple(_table())


# Lips that round beside the letter's own place (judged apart), and vowels that carry no syllable.
_LEFT_OUT = dict.fromkeys(map(ord, "ʷᶣ\u032b\u032f\u0311"))


def _features(text: str) -> Array | None:
    """The features of *text* at its start and end, shape (2, F); None when PanPhon does not know it.

    Of vowels coloured by r it knows only what is around them, so it is not asked.
    """
    plain = spelled(text).translate(_LEFT_OUT)
    if RHOTIC in plain:
        return None
    letters = without_diacritics(plain)
    bare = letters.translate(dict.fromkeys(map(ord, TIES)))
    for whole in (plain, letters, TIES[0].join(bare)):
        if whole in _table():
            return np.stack([_table()[whole]] * 2)
    if bare and bare[0] in _table() and bare[-1] in _table():
        return np.stack([_table()[bare[0]], _table()[bare[-1]]])
    return None


@cache
def opinions(text: str) -> tuple[Opinion, ...]:
    """Every common phone, the one whose phonemes are nearest to the segment *text* first.

    Nothing when PanPhon does not know the segment, or is not installed.
    """
    if not _table() or (features := _features(text)) is None:
        return ()
    far = np.abs(_anchors().features - features).sum(axis=2).mean(axis=1)
    found: dict[str, float] = {}
    for at in np.argsort(far, kind="stable"):
        found.setdefault(_anchors().common[at], round(float(far[at]), 3))
    return tuple(Opinion(common, distance) for common, distance in found.items())
