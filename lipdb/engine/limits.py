"""The small filters that keep the promises: hold, erode, limit from above and from below, spline.

All work along the last axis of arrays ``(n, T)`` and take what lies outside for rest: lay zeros around.
"""

from __future__ import annotations

import numpy as np

from lipdb.engine.table import Floats


def hold(weights: Floats) -> Floats:
    """The running maximum over 3 frames."""
    out = weights.copy()
    np.maximum(out[:, 1:], weights[:, :-1], out=out[:, 1:])
    np.maximum(out[:, :-1], weights[:, 1:], out=out[:, :-1])
    return out


def erode(bound: Floats) -> Floats:
    """The running minimum over 3 frames."""
    out = bound.copy()
    np.minimum(out[..., 1:], bound[..., :-1], out=out[..., 1:])
    np.minimum(out[..., :-1], bound[..., 1:], out=out[..., :-1])
    return out


def limit_below(weights: Floats, most: Floats) -> None:
    """Lower *weights* in place to the largest curves that are nowhere higher and change by at most *most* ``(n, 1)`` a frame.

    It is the smallest of the weights around plus what may be walked from there. Weights lie in 0..1, so only
    neighbours within 1 / most matter, and reaches double: 1, 2, 4 frames.
    """
    reach, slowest = 1, float(most.min(initial=1))
    while reach * slowest < 1 and reach < weights.shape[1]:
        np.minimum(weights[:, reach:], weights[:, :-reach] + reach * most, out=weights[:, reach:])
        np.minimum(weights[:, :-reach], weights[:, reach:] + reach * most, out=weights[:, :-reach])
        reach *= 2


def limit_above(weights: Floats, most: Floats) -> None:
    """Raise *weights* in place to the smallest curves that are nowhere lower and change by at most *most* ``(n, 1)`` a frame."""
    reach, slowest = 1, float(most.min(initial=1))
    while reach * slowest < 1 and reach < weights.shape[1]:
        np.maximum(weights[:, reach:], weights[:, :-reach] - reach * most, out=weights[:, reach:])
        np.maximum(weights[:, :-reach], weights[:, reach:] - reach * most, out=weights[:, :-reach])
        reach *= 2


def spline(control: Floats) -> Floats:
    """A uniform cubic B-spline at its own control points: the filter (1, 4, 1) / 6."""
    out = 4 * control
    out[:, 1:] += control[:, :-1]
    out[:, :-1] += control[:, 1:]
    out /= 6
    return out
