"""Sparse keys of a track: as few as a straight line between them needs to stay within a tolerance."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TOLERANCE = 0.001
DECIMALS = 4

Key = tuple[int, float]
"""Frame and weight."""


def sparse_keys(weights: NDArray[np.float64], *, tolerance: float = TOLERANCE) -> list[Key]:
    """Keys of one pose's *weights* (frames,), first and last frame among them; joined by straight lines they are within *tolerance*.

    Douglas and Peucker's halving, all pieces at once: every round adds, in each piece that is too far off, the frame that
    is farthest off. Weights are rounded to `DECIMALS`, and the tolerance holds after that.
    """
    if not len(weights):
        return []
    frames = np.arange(len(weights))
    rounded = np.round(weights, DECIMALS) + 0.0
    allowed = max(tolerance - 0.5 * 10.0**-DECIMALS, 0.0)
    chosen = np.unique([0, len(weights) - 1])
    while True:
        off = np.abs(np.interp(frames, chosen, rounded[chosen]) - weights)
        off[chosen] = 0
        starts = chosen[:-1] if len(chosen) > 1 else chosen
        worst = np.maximum.reduceat(off, starts)
        piece = np.repeat(np.arange(len(starts)), np.diff(np.append(starts, len(weights))))
        farthest = np.flatnonzero((off == worst[piece]) & (off > allowed))
        if not len(farthest):
            return [(int(frame), float(rounded[frame])) for frame in chosen]
        _, first = np.unique(piece[farthest], return_index=True)
        chosen = np.union1d(chosen, farthest[first])


def dense_weights(keys: list[Key], frames: int) -> NDArray[np.float64]:
    """Weights of *frames* frames along straight lines between *keys*, shape ``(frames,)``; zero when there are no keys."""
    if not keys:
        return np.zeros(frames)
    at, weights = zip(*keys, strict=True)
    dense: NDArray[np.float64] = np.interp(np.arange(frames), at, weights)
    return dense
