"""Lay two rows of symbols side by side, many pairs of rows at once (Needleman and Wunsch 1970)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Costs = NDArray[np.int16]
Symbols = NDArray[np.integer]
Places = NDArray[np.int64]

_ROWS = 512


def align(left: Sequence[Symbols], right: Sequence[Symbols], costs: Costs, *, skip: int) -> list[Places]:
    """For each pair of rows, the place in the right row of every symbol of the left one, -1 where it has none.

    The sum of ``costs[left, right]`` of what stands side by side and of *skip* for every symbol that stands alone is the
    smallest that there is; of several such the one whose symbols meet latest.
    """
    found: list[Places] = [np.zeros(0, np.int64)] * len(left)
    order = sorted(range(len(left)), key=lambda i: len(left[i]) + len(right[i]))
    for first in range(0, len(order), _ROWS):
        batch = order[first : first + _ROWS]
        for i, places in zip(batch, _align([left[i] for i in batch], [right[i] for i in batch], costs, skip), strict=True):
            found[i] = places
    return found


def _align(left: Sequence[Symbols], right: Sequence[Symbols], costs: Costs, skip: int) -> list[Places]:
    a, b = _padded(left), _padded(right)
    lengths, others = np.array([len(row) for row in left]), np.array([len(row) for row in right])
    table = _table(a, b, costs, skip)
    places = np.full(a.shape, -1)
    rows, i, j = np.arange(len(a)), lengths.copy(), others.copy()
    while (open := (i > 0) & (j > 0)).any():
        r, x, y = rows[open], i[open], j[open]
        here = table[x, r, y]
        meet = here == table[x - 1, r, y - 1] + costs[a[r, x - 1], b[r, y - 1]]
        alone = ~meet & (here == table[x - 1, r, y] + skip)
        places[r[meet], x[meet] - 1] = y[meet] - 1
        i[r[meet | alone]] -= 1
        j[r[~alone]] -= 1
    return [row[:length] for row, length in zip(places, lengths, strict=True)]


def _table(a: Symbols, b: Symbols, costs: Costs, skip: int) -> NDArray[np.int16]:
    """The smallest cost of the first i symbols of *a* and the first j of *b*, of shape (i, row, j)."""
    steps = (np.arange(b.shape[1] + 1) * skip).astype(np.int16)
    table = np.empty((a.shape[1] + 1, len(a), len(steps)), np.int16)
    table[0] = steps
    for i in range(a.shape[1]):
        best = table[i] + np.int16(skip)
        np.minimum(best[:, 1:], table[i, :, :-1] + costs[a[:, i, None], b], out=best[:, 1:])
        # Symbols of b that stand alone: the best of all ways from further left.
        table[i + 1] = np.minimum.accumulate(best - steps, axis=1) + steps
    return table


def _padded(rows: Sequence[Symbols]) -> Symbols:
    padded = np.zeros((len(rows), max(map(len, rows))), np.int64)
    for row, symbols in zip(padded, rows, strict=True):
        row[: len(symbols)] = symbols
    return padded
