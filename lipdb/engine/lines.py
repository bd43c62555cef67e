"""Lines as the engine takes them: edges and phones, checked, in flat arrays, with rest at both ends of each line."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np

from lipdb.engine.table import CurveTable, Ints
from lipdb.errors import CurveError, ScheduleError

REST = 250_000
"""The most of a pause, in microseconds, that a pair with silence covers; also the silence put before and after speech."""

Line = tuple[Sequence[int], Sequence[str]]
"""Edges in microseconds, one more than there are phones, and the common phones between them."""


def flat(table: CurveTable, lines: Sequence[Line]) -> tuple[Ints, Ints]:
    """All phones of *lines*: rows (line, number in the table, start, end in microseconds), shape ``(4, n)``; and how many a line.

    Raises `ScheduleError` and `CurveError` for what can't be played.
    """
    sizes = np.array([len(phones) for _, phones in lines])
    spans = np.array([len(edges) for edges, _ in lines])
    bad = (spans != sizes + 1) | (sizes == 0)
    if bad.any():
        i = int(bad.argmax())
        raise ScheduleError(f"line {i}: {sizes[i]} phones and {spans[i]} edges; give a phone or more, and one edge more than phones")
    total = int(sizes.sum())
    rows = np.empty((4, total), dtype=np.int64)
    rows[0] = np.arange(len(lines)).repeat(sizes)
    try:
        rows[1] = np.fromiter(map(table.number.__getitem__, chain.from_iterable([phones for _, phones in lines])), np.int64, total)
    except KeyError as error:
        raise CurveError(f"the table of curves has no phone {error.args[0]!r}; build it with every phone of the schedule") from None
    edges = _whole([edges for edges, _ in lines], total + len(lines))
    at = rows[0] + np.arange(total)
    rows[2], rows[3] = edges[at], edges[at + 1]
    backwards = rows[3] <= rows[2]
    if backwards.any():
        line, _, start, end = rows[:, int(backwards.argmax())].tolist()
        raise ScheduleError(f"line {line}: a phone lasts from {start} to {end} µs; every phone must last a microsecond or more")
    return rows, sizes


def _whole(parts: Sequence[Sequence[int]], size: int) -> Ints:
    """All *parts* in one array. Raises `ScheduleError` for anything but whole numbers."""
    if isinstance(parts[0], np.ndarray):
        numbers = np.concatenate(parts).astype(np.float64)
    else:
        numbers = np.fromiter(chain.from_iterable(parts), np.float64, size)
    with np.errstate(invalid="ignore"):
        whole = numbers.astype(np.int64)
    if (whole != numbers).any():
        raise ScheduleError("edges must be whole microseconds; round(seconds * 1_000_000) gives them")
    return whole


def rested(rows: Ints, sizes: Ints) -> tuple[Ints, Ints]:
    """The same with a short silence before and after every line that has none there."""
    last = sizes.cumsum() - 1
    lead, trail = rows[1, last - sizes + 1] != 0, rows[1, last] != 0
    if not (lead.any() or trail.any()):
        return rows, sizes
    before = lead.cumsum() + trail.cumsum() - trail
    out = np.zeros((4, rows.shape[1] + int(before[-1] + trail[-1])), dtype=np.int64)
    at = before[rows[0]] + np.arange(rows.shape[1])
    out[:, at] = rows
    first, end = at[(last - sizes + 1)[lead]], at[last[trail]]
    out[:, first - 1] = np.stack((out[0, first], 0 * first, out[2, first] - REST, out[2, first]))
    out[:, end + 1] = np.stack((out[0, end], 0 * end, out[3, end], out[3, end] + REST))
    return out, sizes + lead + trail


def merged(rows: Ints, sizes: Ints) -> tuple[Ints, Ints]:
    """The same with neighbouring silences made one; every line begins and ends in silence."""
    silent = rows[1] == 0
    again = silent[1:] & silent[:-1]
    if np.count_nonzero(again) == len(sizes) - 1:  # those of one line's end and the next one's beginning
        return rows, sizes
    again &= rows[0, 1:] == rows[0, :-1]
    kept = np.concatenate(([0], 1 + (~again).nonzero()[0]))
    out = rows[:, kept]
    out[3] = rows[3, np.concatenate((kept[1:], [rows.shape[1]])) - 1]
    return out, np.bincount(out[0], minlength=len(sizes))
