"""Gather and stitch: the curves of all pairs laid on the time line, and the largest taken where they overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.engine.table import GRAIN, CurveTable, Floats, Ints

TINY = 1e-300


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
        nearest = np.floor(keys.place[:, sharp] + 0.5).astype(np.int64)
        nearest += start[sharp]
        np.maximum.at(out, nearest.reshape(-1), weight[:, sharp].reshape(-1))
    _draw(out, start, keys.place, weight)
    return out.reshape(len(row), width)


def _draw(out: Floats, start: Ints, place: Floats, weight: Floats) -> None:
    """Draw straight lines from each key to the next one of its strip into flat *out* by maximum.

    A line takes every grid point from one key to the other, both included.
    """
    first = np.ceil(place[:-1])
    count = np.floor(place[1:])
    count -= first
    count += 1
    width = place[1:] - place[:-1]
    np.maximum(width, TINY, out=width)
    rise = weight[1:] - weight[:-1]
    rise /= width
    value = first - place[:-1]
    value *= rise
    value += weight[:-1]
    counts = count.reshape(-1).astype(np.int64)
    offset = counts.cumsum()
    offset -= counts
    begin = first.astype(np.int64)
    begin += start
    line = np.arange(len(counts)).repeat(counts)  # one repeat and a take each are quicker than repeats
    steps = np.arange(len(line))
    steps -= offset.take(line)
    at = begin.reshape(-1).take(line)
    at += steps
    values = rise.reshape(-1).take(line)
    values *= steps
    values += value.reshape(-1).take(line)
    values += GRAIN
    values -= GRAIN
    np.maximum.at(out, at, values)
