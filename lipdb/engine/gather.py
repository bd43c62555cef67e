"""Gather and stitch: the curves of all pairs laid on the time line, and the largest taken where they overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.engine.table import GRAIN, Bools, CurveTable, Floats, Ints

TINY = 1e-300


@dataclass(frozen=True, slots=True, eq=False)
class Keys:
    """The keys of a stretch of pairs on a grid, curve by curve, by time; each array ``(keys,)``.

    A key stands *place* steps after grid point *base*; *index* is its number in the table.
    """

    base: Ints
    place: Floats
    index: Ints


def gather(table: CurveTable, pair: Ints, base: Ints, rest: Ints, first: Ints, second: Ints, step: int) -> Keys:
    """Lay the keys of every pair on a grid of *step* units.

    Time 0 of a pair lies *rest* units after grid point *base*; its phones last *first* and *second* units; all ``(n,)``.
    Keys are mapped one by one, and joined by straight lines only then (design: warp in two pieces).
    """
    begin = table.first[pair]
    count = table.first[pair + 1] - begin
    shift = np.cumsum(count)
    index = np.repeat(begin - shift + count, count)
    index += np.arange(len(index))
    place = table.left.take(index)
    place *= np.repeat(first.astype(np.float64), count)
    place += np.repeat(rest.astype(np.float64), count)
    right = table.right.take(index)
    right *= np.repeat(second.astype(np.float64), count)
    place += right
    place /= step
    return Keys(np.repeat(base, count), place, index)


def stitch(table: CurveTable, keys: Keys, row: Ints, held: int, *, begin: int, width: int) -> Floats:
    """The largest of all curves at grid points *begin* to *begin* + *width*, shape ``(P, width)``.

    *row* is the row of the result that each pose takes. In the first *held* rows (must-reach poses) each grid point
    also takes the keys within half a step of it, so that no peak falls between two.
    """
    out = np.zeros((len(row), width))
    start = (row * width - begin).take(table.pose).take(keys.index)
    start += keys.base
    weight = table.weight.take(keys.index)
    _draw(out.reshape(-1), start, keys.place, weight, table.joined.take(keys.index))
    if held:
        sharp = np.flatnonzero((row < held).take(table.pose).take(keys.index))
        np.maximum.at(out.reshape(-1), start[sharp] + np.floor(keys.place[sharp] + 0.5).astype(np.int64), weight[sharp])
    return out


def _draw(out: Floats, start: Ints, place: Floats, weight: Floats, joined: Bools) -> None:
    """Draw straight lines from each key to the next, where *joined*, into flat *out* by maximum.

    A line takes every grid point from one key to the other, both included. Lines that meet at most one grid point may
    be as steep as they like; the others change by at most 1 a step, so counting steps through them loses no digits.
    """
    if len(place) < 2:
        return
    here, there, low = place[:-1], place[1:], weight[:-1]
    first, width, rise = np.ceil(here), there - here, weight[1:] - low
    count = np.floor(there)
    count -= first
    count += 1
    count *= joined[:-1]
    counts = np.maximum(count, 0, out=count).astype(np.int64)
    value = first - here
    value /= np.maximum(width, TINY)
    value *= rise
    value += low
    rise /= np.maximum(width, 1, out=width)
    offset = np.cumsum(counts)
    offset -= counts
    value -= rise * offset
    begin = first.astype(np.int64)
    begin += start[:-1]
    begin -= offset
    at = np.repeat(begin, counts)
    steps = np.arange(len(at))
    at += steps
    values = np.repeat(rise, counts)
    values *= steps
    values += np.repeat(value, counts)
    values += GRAIN
    values -= GRAIN
    np.maximum.at(out, at, values)
