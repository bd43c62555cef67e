"""A recording that was aligned already: the phones and words of a Praat TextGrid as a schedule."""

from __future__ import annotations

import math
import re
from bisect import bisect_right
from collections.abc import Sequence
from pathlib import Path

from lipdb.errors import InputError, ScheduleError
from lipdb.schedule import LONGEST, SILENCE, Phone, Schedule
from lipdb.speech.praat import Interval, Tier, parse_textgrid

# Names that aligners give their tiers, the most telling first: MFA and Gentle, SPPAS, WebMAUS, and what people write.
PHONE_TIERS = ("phones", "phone", "phonalign", "mau", "phonemes", "phoneme", "segments", "segment", "phon", "phns", "phn", "sounds", "seg")
WORD_TIERS = ("words", "word", "tokensalign", "ort-mau", "ort", "tokens", "token", "orthography", "orth", "wrd")
# MFA writes "Alice - phones" when a file has several speakers.
_SPEAKER = re.compile(r"(?P<speaker>.+) - (?P<kind>[^-]+)")
_OVERLAP = 1e-6


def read_textgrid(path: Path, *, tier: str | None = None) -> Schedule:
    """The phones of *path* with their words; symbols as they stand in the file, unnamed stretches as silence.

    *tier* names the tier of phones (case does not matter); without it the tier is found by the names that aligners use.
    Raises `InputError` for a file that is no whole TextGrid or has no such tier, and `ScheduleError` for times that
    can't be; both say what, where and what to do.
    """
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: can't be read ({error.strerror or error}); give a TextGrid") from error
    name = _printable(str(path))
    tiers = parse_textgrid(raw, name=name)
    phones = _phone_tier(tiers, tier, name)
    intervals = _checked(phones, name)
    words = _word_tier(tiers, phones)
    spans = [span for span in _checked(words, name) if _is_word(span.label)] if words else []
    return Schedule.from_intervals(
        ((start, end, Phone(_one_line(label) or SILENCE, word=_word_at((start + end) / 2, spans))) for start, end, label in intervals),
        words=[_one_line(span.label) for span in spans],
    )


def _phone_tier(tiers: Sequence[Tier], wanted: str | None, name: str) -> Tier:
    if wanted is not None:
        found = [t for t in tiers if t.name == wanted] or [t for t in tiers if t.name.strip().casefold() == wanted.strip().casefold()]
        missing = f"there is no tier {_printable(wanted)!r}"
    else:
        found = next((named for kind in PHONE_TIERS if (named := [t for t in tiers if _kind(t) == kind])), [])
        missing = "it has no tier of phones"
    if not found:
        raise InputError(f"{name}: {missing}; its tiers are {_names(tiers)}: name the one with phones with --tier, or align it first")
    if len(found) > 1:
        raise InputError(
            f"{name}: several tiers could be the phones: {_names(found)}; choose one with --tier, or give them names of their own"
        )
    if found[0].intervals is None:
        raise InputError(
            f"{name}: tier {_printable(found[0].name)!r} has points, but phones need a start and an end; choose another with --tier"
        )
    if not found[0].intervals:
        raise InputError(f"{name}: tier {_printable(found[0].name)!r} is empty; choose another with --tier")
    return found[0]


def _word_tier(tiers: Sequence[Tier], phones: Tier) -> Tier | None:
    """The tier of words of the same speaker, if there is one."""
    speaker = _speaker(phones)
    for kind in WORD_TIERS:
        for tier in tiers:
            if tier is not phones and tier.intervals and _kind(tier) == kind and _speaker(tier) == speaker:
                return tier
    return None


def _kind(tier: Tier) -> str:
    match = _SPEAKER.fullmatch(tier.name.strip())
    return (match["kind"] if match else tier.name).strip().casefold()


def _speaker(tier: Tier) -> str:
    match = _SPEAKER.fullmatch(tier.name.strip())
    return match["speaker"] if match else ""


def _checked(tier: Tier, name: str) -> tuple[Interval, ...]:
    """The intervals of *tier*. Raises `ScheduleError` naming the first whose times can't be."""
    last = 0.0
    for number, (start, end, label) in enumerate(tier.intervals or (), 1):
        where = f"{name}: tier {_printable(tier.name)!r}, interval {number} ({_printable(label)!r})"
        if not (math.isfinite(start) and math.isfinite(end) and end <= LONGEST):
            raise ScheduleError(f"{where} has a time that is no number of seconds ({start:g} to {end:g}); mend it in Praat")
        if start < 0:
            raise ScheduleError(f"{where} starts before 0 ({start:g} s); shift the times so that the sound starts at 0")
        if end - start < _OVERLAP:
            raise ScheduleError(f"{where} lasts from {start:g} to {end:g} s; its end must come after its start, mend it in Praat")
        if start < last - _OVERLAP:
            raise ScheduleError(f"{where} starts at {start:g} s, before the one in front of it ends ({last:g} s); mend it in Praat")
        last = end
    return tier.intervals or ()


def _is_word(label: str) -> bool:
    """Whether this is a word and no mark such as ``#`` or ``<eps>``."""
    return any(c.isalnum() for c in label) and not re.fullmatch(r"<.*>|\[.*\]", label.strip())


def _word_at(time: float, spans: Sequence[Interval]) -> int:
    index = bisect_right(spans, time, key=lambda span: span.start) - 1
    return index if index >= 0 and time < spans[index].end else -1


def _names(tiers: Sequence[Tier]) -> str:
    return ", ".join(repr(_printable(tier.name)) for tier in tiers[:12]) + (" and more" if len(tiers) > 12 else "") or "none"


def _one_line(label: str) -> str:
    return " ".join(label.split())


def _printable(text: str) -> str:
    """*text* on one line and not too long, for an error."""
    shown = "".join(c if c.isprintable() else "?" for c in text)
    return shown if len(shown) <= 120 else shown[:119] + "…"
