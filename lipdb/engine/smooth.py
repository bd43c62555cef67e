"""Smooth: fill the valleys between neighbouring peaks of one pose (Xu et al. 2013, section 3.2.1)."""

from __future__ import annotations

import numpy as np

from lipdb.engine.table import Bools, Floats, Ints


def moves(weights: Floats) -> tuple[Ints, Ints, Bools]:
    """The stretches over which *weights* ``(P, T)`` rise or fall: first and last point (flat indices), and whether up."""
    flat = weights.reshape(-1)
    if len(flat) < 2:
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros(0, bool)
    way = (flat[1:] > flat[:-1]).view(np.int8) - (flat[1:] < flat[:-1]).view(np.int8)
    turns = (way[1:] != way[:-1]).nonzero()[0] + 1
    edges = np.concatenate(([0], turns, [len(way)]))
    sign = way[edges[:-1]]
    moving = (sign != 0).nonzero()[0]
    return edges[moving], edges[moving + 1], sign[moving] > 0


def valleys(weights: Floats, window: float) -> tuple[Ints, Ints]:
    """Where the valleys narrower than *window* steps begin and end, as flat indices into *weights* ``(P, T)``.

    A valley goes down from one peak and up to the next: it begins at the last point of the first and ends at the first
    point of the second. A level stretch as long as the window ends a valley beside it like a peak does, so that what
    happens here depends on nothing further away than the window.
    """
    begin, end, up = moves(weights)
    if len(begin) < 2:
        return begin[:0], end[:0]
    parts = ((up[:-1] & ~up[1:]) | (begin[1:] - end[:-1] >= window)).nonzero()[0] + 1
    parts = np.concatenate(([0], parts, [len(begin)]))
    first, last = parts[:-1], parts[1:] - 1
    begin, end = begin[first], end[last]
    found = ~up[first] & up[last] & (end - begin < window)
    return begin[found], end[found]


def fill(weights: Floats, begin: Ints, end: Ints) -> None:
    """Raise *weights* to the straight line from each *begin* to its *end* (flat indices), in place."""
    flat = weights.reshape(-1)
    inner = end - begin - 1
    if not inner.any():
        return
    step = (inner - inner.cumsum() + 1).repeat(inner)
    step += np.arange(len(step))
    low = flat[begin]
    line = ((flat[end] - low) / (end - begin)).repeat(inner)
    line *= step
    line += low.repeat(inner)
    at = begin.repeat(inner)
    at += step
    flat[at] = np.maximum(flat[at], line)


def smooth(weights: Floats, window: float, held: int, borders: Floats, closing: Bools) -> None:
    """Fill the valleys of *weights* ``(P, T)`` that are narrower than *window* steps, in place.

    The first *held* rows are must-reach poses: their valleys are filled only where no phone but closing ones lies in
    them ("Bob" must open between its closures). A phone begins at each of *borders* (steps); *closing* says whether it
    is one that closes a must-reach pose.
    """
    begin, end = valleys(weights, window)
    width = weights.shape[1]
    count = int(begin.searchsorted(held * width))
    if count:
        shut = _shut(begin[:count] % width, end[:count] % width, borders, closing)
        kept = np.concatenate((shut.nonzero()[0], np.arange(count, len(begin))))
        begin, end = begin[kept], end[kept]
    fill(weights, begin, end)


def _shut(begin: Ints, end: Ints, borders: Floats, closing: Bools) -> Bools:
    """Which valleys have nothing but closing phones in them."""
    opened = np.concatenate(([0], (~closing).cumsum()))
    first = borders.searchsorted(begin, side="right") - 1
    last = borders.searchsorted(end) - 1
    shut: Bools = (first >= 0) & (opened[last + 1] == opened[np.maximum(first, 0)])
    return shut
