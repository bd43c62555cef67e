"""Constrain and limit the speed of control points, by priority, and enforce both again at the frames.

Why it holds. Control points w of a pose obey its speed limit, and so do averages of them: so does the spline S. Where
w_k + w_j <= C at every control point, S_k + S_j <= C at every time, because a spline is linear in its control points.
Only where a bound is cut off at 0 may the spline pass it, by a little; there frames are lowered to the bound. The
smaller of two curves that obey a speed limit obeys it. Must-reach poses are never lowered, and three equal control
points pass the spline unchanged, so a closure keeps its peak.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from lipdb.engine.limits import hold_peaks, limit_above, limit_below
from lipdb.engine.table import Floats, Ints
from lipdb.poses import PoseSet

Watch = Callable[[str, slice, Floats, int], None]
"""Called after each stage with its name, the rows that it worked on, all weights, and which point the first column is."""


@dataclass(frozen=True, slots=True, eq=False)
class Order:
    """A pose set's rows in the order in which they are worked out.

    *pose* ``(P,)`` is the pose of each row and *row* the other way round; *held* rows, the first, are must-reach poses;
    *levels* are the rows of the other levels; *bounds* of each row are (threshold, higher rows); *speed* ``(P, 1)`` by row,
    and *slowest* the least of must-reach poses, whose peaks spread by it; *outrun* tells for each level whether a pose in it
    can be bounded by a faster one.
    """

    pose: Ints
    row: Ints
    held: int
    levels: tuple[slice, ...]
    bounds: tuple[tuple[tuple[float, tuple[int, ...]], ...], ...]
    speed: Floats
    slowest: float
    outrun: tuple[bool, ...]


@lru_cache(maxsize=64)
def order_of(pose_set: PoseSet) -> Order:
    """The rows of *pose_set*."""
    pose = np.array([i for level in pose_set.levels for i in level], dtype=np.int64)
    row = np.empty_like(pose)
    row[pose] = np.arange(len(pose))
    stops = np.cumsum([len(level) for level in pose_set.levels]).tolist()
    levels = tuple(slice(a, b) for a, b in pairwise(stops))
    bounds = tuple(_grouped([(c, int(row[j])) for j, c in pose_set.bounds(int(i))]) for i in pose)
    speed = pose_set.speed[pose][:, None]
    outrun = tuple(
        any(speed[j] > speed[k] for k in range(rows.start, rows.stop) for _, above in bounds[k] for j in above) for rows in levels
    )
    slowest = float(speed[: stops[0]].min(initial=np.inf))
    return Order(pose, row, stops[0], levels, bounds, speed, slowest, outrun)


def _grouped(bounds: list[tuple[float, int]]) -> tuple[tuple[float, tuple[int, ...]], ...]:
    """(threshold, row) as (threshold, rows)."""
    return tuple((c, tuple(row for other, row in bounds if other == c)) for c in sorted({c for c, _ in bounds}))


def constrain(weights: Floats, order: Order, rows: slice) -> None:
    """Lower *rows* of *weights* in place to what the poses above leave them."""
    for row in range(rows.start, rows.stop):
        for threshold, higher in order.bounds[row]:
            bound = weights[higher[0]]
            for other in higher[1:]:
                bound = np.maximum(bound, weights[other])
            bound = threshold - bound
            np.maximum(bound, 0, out=bound)
            np.minimum(weights[row], bound, out=weights[row])


def control(weights: Floats, order: Order, *, rate: float, watch: Watch | None = None, first: int = 0) -> None:
    """Turn smoothed *weights* ``(P, T)``, *rate* points a second, into the spline's control points, in place.

    *watch* is told that the first column is point *first*.
    """
    most, held = order.speed / rate, slice(0, order.held)
    if order.held:
        hold_peaks(weights[held])
        if watch:
            watch("constrained", held, weights, first)
        limit_above(weights[held], most[held])
        if watch:
            watch("limited", held, weights, first)
    for rows in order.levels:
        constrain(weights, order, rows)
        if watch:
            watch("constrained", rows, weights, first)
        limit_below(weights[rows], most[rows])
        if watch:
            watch("limited", rows, weights, first)


def enforce(frames: Floats, order: Order, *, fps: float, raised: bool) -> None:
    """Keep constraints and speed limits true at the frames themselves, in place.

    *raised* says that must-reach poses were raised at single frames and have to be limited again.
    """
    most = order.speed / fps
    if raised:
        limit_above(frames[: order.held], most[: order.held])
    for rows, outrun in zip(order.levels, order.outrun, strict=True):
        constrain(frames, order, rows)
        if outrun:
            limit_below(frames[rows], most[rows])
