"""Several corpora and several languages at once: one frequency, and one answer about every pair."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from lipdb.coverage.reports.frequency import Frequency, Pair
from lipdb.curves.lookup import Found, trust
from lipdb.decisions import FALL_BACK, ORIGINS, PairUse


def summed(frequencies: Sequence[Frequency]) -> Frequency:
    """The counts of several corpora of one language together: the larger one weighs more."""
    counts = ((*pair, count) for one in frequencies for pair, count in one.counts.items())
    return Frequency.of(counts)


def balanced(frequencies: Collection[Frequency]) -> Frequency:
    """Several languages together, each weighing the same whatever its corpora's sizes; the counts are per cents.

    Of a single language the counts stay as they are. Languages in which no pair was counted take no part.
    """
    counted = [one for one in frequencies if one.counts]
    if len(counted) < 2:
        return counted[0] if counted else Frequency.of([])
    parts = ((*pair, 100 * one.share(pair) / len(counted)) for one in counted for pair in one.counts)
    return replace(Frequency.of(parts), whole=all(one.whole for one in counted), scale=100.0)


def together(by_language: Sequence[Mapping[Pair, PairUse]], frequency: Frequency) -> list[PairUse]:
    """What the pairs of several languages use, with their counts in *frequency*, in the order in which they come.

    Where languages differ, each pose's curve is the least worked on and, of equals, the least specific: the pair is as good as
    the worst that anybody hears of it.
    """
    found: dict[Pair, PairUse] = {}
    for uses in by_language:
        for pair, use in uses.items():
            found[pair] = _worse(found[pair], use) if pair in found else use
    return [replace(use, count=frequency.counts.get(pair, 0.0)) for pair, use in found.items()]


def _worse(one: PairUse, other: PairUse) -> PairUse:
    if one.curves == other.curves:
        return one
    return replace(one, curves={pose: max(found, other.curves[pose], key=_rank) for pose, found in one.curves.items()})


def _rank(found: Found) -> tuple[int, int, bool]:
    origin = FALL_BACK if found.fallback else found.curve.origin
    return ORIGINS.index(origin), trust(found.layer), bool(found.curve.keys)
