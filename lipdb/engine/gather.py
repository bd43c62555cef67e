"""Gather and stitch: the curves of all pairs laid on the time line, and the largest taken where they overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.engine.table import GRAIN, CurveTable, Floats, Ints

TINY = 1e-300
"""Keeps lines without length from dividing by 0; lost in the length of every other."""


@dataclass(frozen=True, slots=True, eq=False)
class Keys:
    """The keys of a stretch of pairs on a grid, strip by strip (see `CurveTable`).

    Key ``(k, i)`` stands *place* ``(K, n)`` steps after grid point *base* ``(n,)``; *strip* ``(n,)`` is its number in the table.
    """

    base: Ints
    place: Floats
    strip: Ints


def gather(table: CurveTable, pair: Ints, base: Ints, rest: Ints, first: Ints, second: Ints, step: int) -> Keys:
    """Lay the keys of every pair on a grid of *step* units.

    Time 0 of a pair lies *rest* units after grid point *base*; its phones last *first* and *second* units; all ``(n,)``.
    Keys are mapped one by one, and joined by straight lines only then (design: warp in two pieces).
    """
    begin = table.first[pair]
    count = table.first[pair + 1]
    count -= begin
    begin -= count.cumsum()
    begin += count
    owner = np.arange(len(pair)).repeat(count)
    strip = begin.take(owner)
    strip += np.arange(len(strip))
    place = table.left.take(strip, axis=1)
    place *= first.astype(np.float64).take(owner)
    place += rest.astype(np.float64).take(owner)
    right = table.right.take(strip, axis=1)
    right *= second.astype(np.float64).take(owner)
    place += right
    place /= step
    return Keys(base.take(owner), place, strip)


def stitch(table: CurveTable, keys: Keys, row: Ints, held: int, *, begin: int, width: int) -> Floats:
    """The largest of all curves at grid points *begin* to *begin* + *width*, shape ``(P, width)``.

    *row* is the row of the result that each pose takes. In the first *held* rows (must-reach poses) each grid point
    also takes the keys within half a step of it, so that no peak falls between two.
    """
    out = np.zeros(len(row) * width)
    start = (row * width - begin).take(table.pose.take(keys.strip))
    start += keys.base
    weight = table.weight.take(keys.strip, axis=1)
    if held:
        sharp = (start < held * width).nonzero()[0]
        nearest = np.floor(keys.place.take(sharp, axis=1) + 0.5).astype(np.int64)
        nearest += start[sharp]
        np.maximum.at(out, nearest.reshape(-1), weight.take(sharp, axis=1).reshape(-1))
    _draw(out, start, keys.place, weight)
    return out.reshape(len(row), width)


def _draw(out: Floats, start: Ints, place: Floats, weight: Floats) -> None:
    """Draw straight lines from each key to the next one of its strip into flat *out* by maximum.

    A line takes every grid point from one key to the other, both included: two on average. So the first two are drawn of
    all lines side by side, and only the others, a quarter, are spread out one by one. Where a line is over already, no
    points are left of it: no weight is above 1, so the smaller of the two raises nothing there.
    """
    first = np.ceil(place[:-1])
    left = np.floor(place[1:])
    left -= first
    left += 1
    width = place[1:] - place[:-1]
    width += TINY
    rise = weight[1:] - weight[:-1]
    rise /= width
    value = first - place[:-1]
    value *= rise
    value += weight[:-1]
    at = first.astype(np.int64)
    at += start
    for _ in range(2):
        _raise(out, at, np.minimum(value, left))
        left -= 1
        at += 1
        value += rise
    line = (left > 0).reshape(-1).nonzero()[0]
    counts = left.reshape(-1).take(line).astype(np.int64)
    offset = counts.cumsum()
    offset -= counts
    line = line.repeat(counts)
    steps = np.arange(len(line))
    steps -= offset.repeat(counts)
    values = rise.reshape(-1).take(line)
    values *= steps
    values += value.reshape(-1).take(line)
    steps += at.reshape(-1).take(line)
    _raise(out, steps, values)


def _raise(out: Floats, at: Ints, values: Floats) -> None:
    """Raise flat *out* at points *at* to *values*, rounded to the grain."""
    values += GRAIN
    values -= GRAIN
    np.maximum.at(out, at.reshape(-1), values.reshape(-1))
