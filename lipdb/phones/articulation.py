"""IPA segments to common phones, and to one another, by what lips, jaw and tongue visibly do.

Rules by articulation (design: they place 99.5 % of 216 phonemes of six languages as a phonetician does). They propose the
rows of ``ipa.tsv`` and answer for symbols that no table knows; a person's row wins over them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from lipdb.phones.segments import PLACES, Letter, read_segment

NEUTRAL = "ah"


@dataclass(frozen=True, slots=True)
class Classified:
    """The common phones of a segment, how sure the rule is (0 to 1), and a sentence that says why."""

    common: tuple[str, ...]
    confidence: float
    reason: str


Verdict = tuple[str, float, str]
"""A common phone, confidence, reason."""

_LIPS = ("bilabial", "labiodental")
_TIP = ("dental", "alveolar", "postalveolar", "retroflex", "alveolopalatal")
_HISS = ("postalveolar", "retroflex", "alveolopalatal", "palatal")
_BACK = ("palatal", "velar", "uvular")

# Manners (empty: any), places (empty: any), verdict; the first that fits wins.
_RULES: tuple[tuple[tuple[str, ...], tuple[str, ...], Verdict], ...] = (
    (("plosive", "implosive", "nasal", "click", "trill"), ("bilabial",), ("bmp", 1.0, "the lips close")),
    ((), ("labiodental",), ("f", 1.0, "the lower lip meets the upper teeth")),
    ((), ("bilabial",), ("f", 0.7, "the lips come close but do not shut; nearest is f")),
    ((), ("labial-velar",), ("w", 1.0, "the lips round and come forward")),
    ((), ("labial-palatal",), ("ue", 1.0, "the lips round over a front tongue")),
    (("lateral",), (), ("l", 0.9, "the tongue lets air pass at its sides")),
    (("approximant",), ("palatal",), ("sh", 0.8, "the paper puts the consonant of yard here")),
    (("approximant",), _TIP, ("r", 0.9, "the tongue curls up without touching")),
    (("trill",), ("alveolar",), ("r", 0.7, "the tongue tip trills; d would also do")),
    (("fricative",), ("dental",), ("th", 1.0, "the tongue tip is seen at the teeth")),
    (("fricative",), ("alveolar",), ("z", 1.0, "the teeth nearly shut for a hiss")),
    (("fricative",), _HISS, ("sh", 0.9, "the teeth nearly shut for a hush, behind the ridge")),
    (("fricative",), ("pharyngeal", "glottal"), ("h", 0.8, "made in the throat, the mouth is free")),
    (("plosive",), ("pharyngeal", "glottal"), ("h", 0.6, "shut in the throat only, the mouth is free")),
    (("nasal", "click"), (), ("d", 0.9, "the tongue shuts the mouth, as for n or ng")),
    ((), _TIP, ("d", 1.0, "the tongue tip touches behind the teeth")),
    ((), (), ("kg", 0.9, "the back of the tongue rises")),
)


def _consonant(letter: Letter) -> Verdict:
    if letter.syllabic and letter.manner == "approximant" and letter.place in _TIP:
        return "er", 0.7, "an r that carries the syllable"
    return next(v for manners, places, v in _RULES if (not manners or letter.manner in manners) and (not places or letter.place in places))


def _vowel(letter: Letter) -> Verdict:
    close, mid = letter.height < 0.3, letter.height < 0.45
    if letter.rhotic:
        return "er", 0.9, "an r-coloured vowel"
    if not letter.rounded:
        if close:
            return "ih", 0.95 if letter.back < 0.9 else 0.7, "close and unrounded"
        if letter.height == 1:
            return (
                "aa",
                1.0 if letter.back else 0.7,
                "the jaw wide open" + ("" if letter.back else "; where /a/ is written the vowel is mostly central"),
            )
        if letter.back < 0.9 and (mid or (letter.back == 0 and letter.height < 0.75)):
            return "eh", 0.95, "mid and unrounded, at the front"
        return "ah", 0.9, "between mid and open, unrounded"
    if letter.back == 0:
        return ("ah", 0.6, "open and hardly rounded") if letter.height == 1 else ("ue", 0.9 - 0.5 * letter.height, "rounded at the front")
    if close:
        return "w", 0.95, "close and rounded, as in too"
    return ("ow", 0.8, "mid and rounded, as in go") if mid else ("ao", 0.9, "open and rounded, as in dog")


def _ending(letter: Letter) -> str:
    """``i`` or ``u`` for what can end a diphthong, else nothing."""
    if letter.glide:
        return {"j": "i", "w": "u", "ɥ": ""}[letter.letter]
    if not letter.vowel or letter.height > 0.75 or letter.rhotic:
        return ""
    if letter.rounded:
        return "u" if letter.height < 0.5 and letter.back else ""
    return "i" if letter.back == 0 or (letter.height < 0.3 and letter.back < 0.9) else ""


_DIPHTHONGS = {
    ("ah", "i"): "ay", ("ah", "u"): "aw", ("aa", "i"): "ay", ("aa", "u"): "aw", ("ao", "i"): "oy", ("ao", "u"): "ow",
    ("ow", "i"): "oy", ("ow", "u"): "ow", ("eh", "i"): "eh",
}  # fmt: skip


def _diphthong(first: Letter, second: Letter) -> Verdict | None:
    """The diphthongs that have a class of their own (Table 1: ay, aw, oy, ow, and eh for the vowel of ate)."""
    if not first.vowel or first.rhotic:
        return None
    end, start = _ending(second), _vowel(first)[0]
    if second.height >= first.height and not second.glide:
        return None
    if first.letter == "ə" and end == "u":
        return "ow", 0.9, "the diphthong of go, as the British say it"
    if first.letter in "əɤɘ" or not (kind := _DIPHTHONGS.get((start, end))):
        return None
    return kind, 0.95, f"a diphthong from {first.letter} to {second.letter}"


def _affricate(first: Letter, second: Letter, tied: bool) -> list[Verdict] | None:
    """A stop and its release, or two closures at once, as one sound."""
    if first.vowel or second.vowel or first.manner not in ("plosive", "nasal"):
        return None
    if {first.place, second.place} == {"velar", "bilabial"}:
        return [("bmp", 0.95, "of two closures at once the lips' is seen")]
    near = first.place == second.place or (first.place in _TIP and second.place in (*_TIP, "palatal"))
    if second.manner not in ("fricative", "lateral") or not (tied or near or {first.place, second.place} <= set(_LIPS)):
        return None
    release = _consonant(second)
    if first.place == "bilabial":
        return [_consonant(first), release]
    return [(release[0], release[1] * 0.95, f"a stop that opens into {second.letter}: {release[2]}")]


def _verdicts(letters: tuple[Letter, ...], tied: bool) -> list[Verdict]:
    found: list[Verdict] = []
    i = 0
    while i < len(letters):
        pair = letters[i : i + 2]
        joined = None
        if len(pair) == 2:
            diphthong = _diphthong(*pair)
            joined = [diphthong] if diphthong else _affricate(*pair, tied)
        if joined:
            found += joined
            i += 2
            continue
        found += _single(letters[i])
        i += 1
    return found


def _single(letter: Letter) -> list[Verdict]:
    if not letter.vowel:
        return [_consonant(letter)]
    verdict = _vowel(letter)
    # The r of ɚ is all there is; that of ɑ˞ comes after an open vowel.
    if letter.rhotic and letter.letter not in "əɜ":
        plain = _vowel(Letter(letter.letter, "vowel", "", letter.height, letter.back, letter.rounded))
        return [plain, verdict]
    return [verdict]


@cache
def classify(segment: str) -> Classified | None:
    """The common phones of an IPA *segment* by articulation, or None when no letter of it is in the IPA chart.

    One common phone for most, two and more for diphthongs, affricates and clusters that have no class of their own.
    """
    letters, tied = read_segment(segment)
    if not letters:
        return None
    verdicts = _verdicts(letters, tied)
    # A glide beside its own vowel (ji, wu) or a long vowel written twice is one movement.
    kept = [v for i, v in enumerate(verdicts) if i == 0 or v[0] != verdicts[i - 1][0]]
    return Classified(tuple(v[0] for v in kept), round(min(v[1] for v in kept), 3), "; ".join(v[2] for v in kept))


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
    hush = friction and place in _HISS
    return {
        "vowel": 0.5 if letter.manner == "approximant" else 0.0,
        "open": 0.4 if place in ("pharyngeal", "glottal") else 0.15,
        "round": 1.0 if letter.rounded else 0.4 if place == "postalveolar" or tongue_r else 0.0,
        "lips": (0.4 if friction else 1.0) * (place == "bilabial"),
        "teeth": 1.0 if place == "labiodental" else 0.5 * (place == "bilabial" and friction),
        "tip": 1.0 if place in _TIP else 0.3 * (place == "palatal"),
        "back": float(place in _BACK and not hush),
        "side": float(letter.manner == "lateral"),
        "rhotic": 1.0 if tongue_r else 0.5 * (letter.manner == "trill" and place != "bilabial"),
        "hiss": float(friction),
        "hush": float(hush),
        "depth": PLACES.index(place) / (len(PLACES) - 1) if place in PLACES else 0.5,
    }


def _between(one: Letter, other: Letter) -> float:
    a, b = _seen(one), _seen(other)
    return sum(weight * abs(a.get(name, 0.0) - b.get(name, 0.0)) for name, weight in _WEIGHTS.items())


def _released(segment: str) -> tuple[Letter, ...]:
    """The letters of *segment* without a stop that only opens into a fricative of its own place."""
    letters, tied = read_segment(segment)
    if len(letters) > 1 and letters[0].place not in _LIPS and _affricate(letters[0], letters[1], tied):
        return letters[1:]
    return letters


@cache
def distance(one: str, other: str) -> float | None:
    """How different two IPA segments look, 0 for the same; None when either has no letter of the IPA chart.

    Of an affricate the release is seen. Segments of several letters are compared at their starts and at their ends; each
    letter that one has more adds a little, so a vowel is nearer to a vowel than to a diphthong.
    """
    a, b = _released(one), _released(other)
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
