"""Gather and stitch: the curves of all pairs laid on the time line, and the largest taken where they overlap."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.engine.table import Bools, CurveTable, Floats, Ints


@dataclass(frozen=True, slots=True, eq=False)
class Keys:
    """The keys of a stretch of pairs on a grid, curve by curve, by time.

    Key ``k`` stands *place* ``k`` steps after grid point *base* ``k``; *index* is its number in the table.
    """

    base: Ints
    place: Floats
    index: Ints
    owner: Ints


def gather(table: CurveTable, pair: Ints, start: Ints, first: Ints, second: Ints, *, step: int, base: Ints) -> Keys:
    """Lay the keys of every pair on a grid of *step* units; *base* is the grid point at which each pair's time 0 lies.

    *start*, *first* and *second* are where the pairs start and how long their phones last, in units, shape ``(n,)``.
    Keys are mapped one by one, and joined by straight lines only then (design: warp in two pieces).
    """
    count = table.first[pair + 1] - table.first[pair]
    shift = np.cumsum(count)
    total = int(shift[-1]) if len(shift) else 0
    index = np.arange(total) + np.repeat(table.first[pair] - shift + count, count)
    whole, rest = np.divmod(start, step)
    place = np.repeat(rest, count) + table.left[index] * np.repeat(first, count) + table.right[index] * np.repeat(second, count)
    place /= step
    return Keys(np.repeat(base + whole, count), place, index, np.repeat(np.arange(len(pair)), count))


def stitch(table: CurveTable, keys: Keys, row: Ints, held: Ints, *, begin: int, width: int) -> Floats:
    """The largest of all curves at grid points *begin* to *begin* + *width*, shape ``(P, width)``.

    *row* says which row of the result each pose takes; rows in *held* (must-reach poses) take at every grid point the
    largest weight within half a step, so that no peak falls between two frames.
    """
    out = np.zeros((len(row), width + 1))
    of_key = row[table.pose[keys.index]]
    weight = table.weight[keys.index]
    half = np.zeros(len(row))
    half[held] = 0.5
    place = keys.place + half[of_key]
    _draw(out, of_key, keys.base - begin, place, weight, ~table.last[keys.index])
    if len(held):
        out[held, :-1] = np.maximum(out[held, :-1], out[held, 1:])
        sharp = half[of_key] > 0
        raise_at(out, of_key[sharp], (keys.base[sharp] - begin) + np.floor(place[sharp]).astype(np.int64), weight[sharp])
    return out[:, :-1]


def _draw(out: Floats, row: Ints, base: Ints, place: Floats, weight: Floats, joined: Bools) -> None:
    """Draw straight lines from each key to the next, where *joined*, into *out* by maximum."""
    if len(place) < 2:
        return
    here, there = place[:-1], place[1:]
    first = np.ceil(here)
    count = np.where(joined[:-1], np.maximum(np.floor(there) - first + 1, 0), 0).astype(np.int64)
    slope = (weight[1:] - weight[:-1]) / np.maximum(there - here, 1e-12)
    value = weight[:-1] + slope * (first - here)
    slope[count < 2] = 0  # so that steep lines, which meet one grid point at most, can't lose digits below
    offset = np.cumsum(count) - count
    steps = np.arange(int(count.sum()))
    values = np.repeat(value - slope * offset, count) + np.repeat(slope, count) * steps
    start = row[:-1] * out.shape[1] + base[:-1] + first.astype(np.int64) - offset
    np.maximum.at(out.reshape(-1), np.repeat(start, count) + steps, values)


def raise_at(out: Floats, row: Ints, column: Ints, weight: Floats) -> None:
    """Raise ``out[row, column]`` to *weight* where it is lower; columns outside are left out."""
    inside = (column >= 0) & (column < out.shape[1])
    np.maximum.at(out, (row[inside], column[inside]), weight[inside])
