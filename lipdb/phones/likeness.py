"""How alike two IPA segments look, by what lips, jaw and tongue visibly do."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from lipdb.phones.articulation import released
from lipdb.phones.letters import BACK, HUSH, PLACES, TIP, Letter

# What is seen, each 0 to 1, and how much it counts.
_WEIGHTS = {
    "vowel": 3.0, "open": 3.0, "round": 4.0, "lips": 5.0, "teeth": 4.0, "tip": 2.0, "back": 1.5, "side": 2.0, "rhotic": 2.0, "hiss": 1.0,
    "hush": 2.0, "depth": 1.0,
}  # fmt: skip
_GLIDES = {"j": 0.0, "ɥ": 0.0, "w": 1.0}
_STEP = 0.5


def _seen(letter: Letter) -> dict[str, float]:
    """How much of each visible thing *letter* has, 0 to 1; what is left out is 0."""
    if letter.letter in _GLIDES:
        return {"vowel": 0.7, "round": float(letter.rounded), "depth": _GLIDES[letter.letter]}
    if letter.vowel:
        return {"vowel": 1.0, "open": letter.height, "round": float(letter.rounded), "rhotic": float(letter.rhotic), "depth": letter.back}
    friction, place, tongue_r = letter.manner == "fricative", letter.place, letter.letter in "ɹɻ"
    hush = friction and place in HUSH
    return {
        "vowel": 0.5 if letter.manner == "approximant" else 0.0,
        "open": 0.4 if place in ("pharyngeal", "glottal") else 0.15,
        "round": 1.0 if letter.rounded or letter.labial else 0.4 if place == "postalveolar" or tongue_r else 0.0,
        "lips": (0.4 if friction else 1.0) * (place == "bilabial"),
        "teeth": 1.0 if place == "labiodental" else 0.5 * (place == "bilabial" and friction),
        "tip": 1.0 if place in TIP else 0.3 * (place == "palatal"),
        "back": float(place in BACK and not hush),
        "side": float("lateral" in letter.manner),
        "rhotic": 1.0 if tongue_r else 0.5 * (letter.manner == "trill" and place != "bilabial"),
        "hiss": float(friction),
        "hush": float(hush),
        "depth": PLACES.index(place) / (len(PLACES) - 1) if place in PLACES else 0.5,
    }


def _between(one: Letter, other: Letter) -> float:
    a, b = _seen(one), _seen(other)
    return sum(weight * abs(a.get(name, 0.0) - b.get(name, 0.0)) for name, weight in _WEIGHTS.items())


@cache
def distance(one: str, other: str) -> float | None:
    """How different two IPA segments look, 0 for the same; None when either has no letter of the IPA chart.

    Of an affricate the release is seen. Segments of several letters are compared at their starts and at their ends; each
    letter that one has more adds a little, so a vowel is nearer to a vowel than to a diphthong.
    """
    a, b = released(one), released(other)
    if not a or not b:
        return None
    return round((_between(a[0], b[0]) + _between(a[-1], b[-1])) / 2 + _STEP * abs(len(a) - len(b)), 6)


def nearest(segment: str, candidates: Mapping[str, str]) -> tuple[str, float] | None:
    """The name among *candidates* (name to IPA segment) that looks most like *segment*, and how far off it is.

    The first of equals in the order given; None when *segment* or all candidates have no letter of the IPA chart.
    """
    found = [(far, name) for name, ipa in candidates.items() if (far := distance(segment, ipa)) is not None]
    if not found:
        return None
    far, name = min(found, key=lambda item: item[0])
    return name, far
