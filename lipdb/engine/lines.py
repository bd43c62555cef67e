"""Lines as the engine takes them: edges and phones, checked, in flat arrays, with rest at both ends of each line."""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from itertools import chain

import numpy as np

from lipdb.engine.table import CurveTable, Ints
from lipdb.errors import CurveError, ScheduleError

Line = tuple[Sequence[int], Sequence[str]]
"""Edges in microseconds, one more than there are phones, and the common phones between them."""


def flat(table: CurveTable, lines: Sequence[Line]) -> tuple[Ints, Ints, Ints]:
    """Edges (microseconds) and phones (numbers in the table) of *lines* one after another, and how many phones each has.

    Neighbouring silences are one. Raises `ScheduleError` and `CurveError` for what can't be played.
    """
    sizes = np.array([len(phones) for _, phones in lines])
    spans = np.array([len(edges) for edges, _ in lines])
    bad = (spans != sizes + 1) | (sizes == 0)
    if bad.any():
        i = int(bad.argmax())
        raise ScheduleError(f"line {i}: {sizes[i]} phones and {spans[i]} edges; give a phone or more, and one edge more than phones")
    try:
        phone = _packed(map(table.number.__getitem__, chain.from_iterable([phones for _, phones in lines])), int(sizes.sum()))
    except KeyError as error:
        raise CurveError(f"the table of curves has no phone {error.args[0]!r}; build it with every phone of the schedule") from None
    edges = _whole([edges for edges, _ in lines], int(spans.sum()))
    heads = spans.cumsum() - spans
    short = edges[1:] <= edges[:-1]
    short[heads[1:] - 1] = False  # from one line's end to the next one's start time may run anyhow
    if short.any():
        i = int(short.argmax())
        line = int(heads.searchsorted(i, side="right")) - 1
        raise ScheduleError(f"line {line}: a phone lasts from {edges[i]} to {edges[i + 1]} µs; every phone must last a microsecond or more")
    return _merged(edges, phone, sizes)


def _whole(parts: Sequence[Sequence[int]], count: int) -> Ints:
    """All *parts* in one array of *count*. Raises `ScheduleError` for anything but whole numbers."""
    try:
        if isinstance(parts[0], np.ndarray):
            return np.concatenate(parts).astype(np.int64, casting="safe")
        return _packed(chain.from_iterable(parts), count)
    except (TypeError, struct.error):
        raise ScheduleError("edges must be whole microseconds; round(seconds * 1_000_000) gives them") from None


def _packed(numbers: Iterable[int], count: int) -> Ints:
    """*count* whole *numbers* in an array; `struct` takes half as long as numpy does."""
    return np.frombuffer(bytearray(struct.pack(f"{count}q", *numbers)), dtype=np.int64)


def _merged(edges: Ints, phone: Ints, sizes: Ints) -> tuple[Ints, Ints, Ints]:
    """The same with neighbouring silences made one."""
    silent = phone == 0
    again = silent[1:] & silent[:-1]
    if not again.any():
        return edges, phone, sizes
    line = np.arange(len(sizes)).repeat(sizes)
    kept = np.ones(len(phone), dtype=bool)
    kept[1:] = ~(again & (line[1:] == line[:-1]))
    inner = np.ones(len(edges), dtype=bool)
    inner[line + np.arange(len(phone))] = kept
    return edges[inner], phone[kept], np.bincount(line[kept], minlength=len(sizes))
