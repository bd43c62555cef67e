"""Smooth: fill the valleys between neighbouring peaks of one pose (Xu et al. 2013, section 3.2.1)."""

from __future__ import annotations

import numpy as np

from lipdb.engine.table import Bools, Floats, Ints


def valleys(weights: Floats, window: float) -> tuple[Ints, Ints]:
    """Where the valleys narrower than *window* steps begin and end, as flat indices into *weights* ``(P, T)``.

    A valley goes down from one peak and up to the next: it begins at the last point of the first and ends at the first
    point of the second. A level stretch as long as the window ends a valley beside it like a peak does, so that what
    happens here depends on nothing further away than the window.
    """
    step = np.diff(weights.ravel())
    moves = np.flatnonzero(step)
    if len(moves) < 2:
        return moves[:0], moves[:0]
    up = step[moves] > 0
    parts = np.flatnonzero((up[:-1] & ~up[1:]) | (np.diff(moves) > window)) + 1
    parts = np.concatenate(([0], parts, [len(moves)]))
    begin, end = moves[parts[:-1]], moves[parts[1:] - 1] + 1
    found = ~up[parts[:-1]] & up[parts[1:] - 1] & (end - begin < window)
    return begin[found], end[found]


def fill(weights: Floats, begin: Ints, end: Ints) -> None:
    """Raise *weights* to the straight line from each *begin* to its *end* (flat indices), in place."""
    flat = weights.reshape(-1)
    inner = end - begin - 1
    total = int(inner.sum())
    if not total:
        return
    low, high = flat[begin], flat[end]
    step = np.arange(total) - np.repeat(np.cumsum(inner) - inner, inner) + 1
    line = np.repeat(low, inner) + np.repeat((high - low) / (end - begin), inner) * step
    at = np.repeat(begin, inner) + step
    flat[at] = np.maximum(flat[at], line)


def smooth(weights: Floats, window: float, held: int, borders: Floats, closing: Bools) -> None:
    """Fill the valleys of *weights* ``(P, T)`` that are narrower than *window* steps, in place.

    The first *held* rows are must-reach poses: their valleys are filled only where no phone but closing ones lies in
    them ("Bob" must open between its closures). A phone begins at each of *borders* (steps); *closing* says whether it
    is one that closes a must-reach pose.
    """
    begin, end = valleys(weights, window)
    width = weights.shape[1]
    count = int(np.searchsorted(begin, held * width))
    if count:
        row = begin[:count] // width
        opened = np.concatenate(([0], np.cumsum(~closing)))
        low = np.searchsorted(borders, begin[:count] - row * width, side="right") - 1
        high = np.searchsorted(borders, end[:count] - row * width, side="left") - 1
        shut = (low >= 0) & (opened[high + 1] == opened[np.maximum(low, 0)])
        keep = np.concatenate((np.flatnonzero(shut), np.arange(count, len(begin))))
        begin, end = begin[keep], end[keep]
    fill(weights, begin, end)
