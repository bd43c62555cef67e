"""The small filters that keep the promises: hold peaks, limit speed from above and from below, spline.

All work along the last axis of arrays ``(n, T)``. They take what lies outside for rest: lay zeros around.
"""

from __future__ import annotations

import numpy as np

from lipdb.engine.smooth import moves
from lipdb.engine.table import Floats, Ints


def peaks(weights: Floats) -> tuple[Ints, Ints]:
    """First and last point of every peak or plateau, as flat indices."""
    begin, end, up = moves(weights)
    tops = (up[:-1] & ~up[1:]).nonzero()[0]
    return end[tops], begin[tops + 1]


def hold_peaks(weights: Floats) -> None:
    """Widen peaks of less than three points to three, in place: three equal points pass the spline unchanged.

    A single point raises both neighbours, two points the higher one of theirs: no more than the peak needs, because all
    that it takes beyond is taken from the opening after it.
    """
    flat = weights.reshape(-1)
    up, down = flat[1:] > flat[:-1], flat[1:] < flat[:-1]
    single = (up[:-1] & down[1:]).nonzero()[0] + 1
    double = (up[:-2] & ~(up | down)[1:-1] & down[2:]).nonzero()[0] + 1
    higher = np.where(flat[double - 1] >= flat[double + 2], double - 1, double + 2)
    for at, top in ((single - 1, single), (single + 1, single), (higher, double)):
        np.maximum.at(flat, at, flat[top])


def limit_below(weights: Floats, most: Floats) -> None:
    """Lower *weights* in place to the largest curves that are nowhere higher and change by at most *most* ``(n, 1)`` a point.

    It is the smallest of the weights around plus what may be walked from there. Weights lie in 0..1, so only
    neighbours within 1 / most matter, and the reach doubles: 1, 2, 4 points.
    """
    reach, slowest = 1, float(most.min(initial=1))
    while reach * slowest < 1 and 2 * reach < weights.shape[1]:
        around = np.minimum(weights[:, : -2 * reach], weights[:, 2 * reach :])
        around += reach * most
        np.minimum(weights[:, reach:-reach], around, out=weights[:, reach:-reach])
        reach *= 2


def limit_above(weights: Floats, most: Floats) -> None:
    """Raise *weights* in place to the smallest curves that are nowhere lower and change by at most *most* ``(n, 1)`` a point."""
    reach, slowest = 1, float(most.min(initial=1))
    while reach * slowest < 1 and 2 * reach < weights.shape[1]:
        around = np.maximum(weights[:, : -2 * reach], weights[:, 2 * reach :])
        around -= reach * most
        np.maximum(weights[:, reach:-reach], around, out=weights[:, reach:-reach])
        reach *= 2


def spline(control: Floats) -> Floats:
    """A uniform cubic B-spline at its own control points: the filter (1, 4, 1) / 6."""
    out = 4 * control
    out[:, 1:] += control[:, :-1]
    out[:, :-1] += control[:, 1:]
    out *= 1 / 6
    return out
