"""Constrain, limit the speed and spline, pose by pose in descending priority (design: all of them true at once).

Why it holds. After constraining and limiting, the control points of a pose are, for neighbouring frames s and t, at most
the bound at t; so their average at t is. Lowering never breaks an upper bound. Averages of values in 0..1 that obey a
speed limit obey both. Must-reach poses are never lowered, and three equal control points pass the filter unchanged, so a
closure keeps its peak.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from lipdb.engine.limits import erode, hold, limit_above, limit_below, spline
from lipdb.engine.table import Floats, Ints
from lipdb.poses import PoseSet

Watch = Callable[[str, slice, Floats], None]
"""Called after each stage with its name, the rows and their weights."""


@dataclass(frozen=True, slots=True, eq=False)
class Order:
    """A pose set's rows in the order in which they are worked out.

    *pose* ``(P,)`` is the pose of each row and *row* the other way round; *levels* are the rows of each level, the first
    of must-reach poses; *bounds* of each row are (higher row, threshold); *speed* ``(P, 1)`` by row.
    """

    pose: Ints
    row: Ints
    levels: tuple[slice, ...]
    bounds: tuple[tuple[tuple[int, float], ...], ...]
    speed: Floats

    @property
    def held(self) -> int:
        """How many rows, from the first, are must-reach poses."""
        return int(self.levels[0].stop)


@lru_cache(maxsize=64)
def order_of(pose_set: PoseSet) -> Order:
    """The rows of *pose_set*."""
    pose = np.array([i for level in pose_set.levels for i in level], dtype=np.int64)
    row = np.empty_like(pose)
    row[pose] = np.arange(len(pose))
    stops = np.cumsum([len(level) for level in pose_set.levels]).tolist()
    levels = tuple(slice(stop - len(level), stop) for stop, level in zip(stops, pose_set.levels, strict=True))
    bounds = tuple(tuple((int(row[j]), c) for j, c in pose_set.bounds(int(i))) for i in pose)
    return Order(pose, row, levels, bounds, pose_set.speed[pose][:, None])


def constrain(weights: Floats, done: Floats, order: Order, rows: slice, *, eroded: bool) -> None:
    """Lower *rows* of *weights* in place under what the finished rows *done* leave them."""
    for row in range(rows.start, rows.stop):
        if order.bounds[row]:
            bound = np.minimum.reduce([c - done[higher] for higher, c in order.bounds[row]])
            np.maximum(bound, 0, out=bound)
            np.minimum(weights[row], erode(bound) if eroded else bound, out=weights[row])


def finish(weights: Floats, order: Order, *, rate: float, watch: Watch | None = None) -> tuple[Floats, Floats]:
    """Control points and spline of smoothed *weights* ``(P, T)``, *rate* points a second. Changes *weights*."""
    most, done = order.speed / rate, np.empty_like(weights)
    for rows in order.levels:
        if rows.start == rows.stop:
            continue
        if rows.start == 0 and order.held:
            weights[rows] = hold(weights[rows])
        else:
            constrain(weights, done, order, rows, eroded=True)
        if watch:
            watch("constrained", rows, weights)
        (limit_above if rows.stop <= order.held else limit_below)(weights[rows], most[rows])
        if watch:
            watch("limited", rows, weights)
        done[rows] = spline(weights[rows])
    return weights, done


def enforce(frames: Floats, order: Order, *, fps: float) -> None:
    """Keep speed limits and constraints true at frames that are not control points, in place; closures are raised already."""
    most = order.speed / fps
    for rows in order.levels:
        if rows.start == rows.stop:
            continue
        if rows.stop <= order.held:
            limit_above(frames[rows], most[rows])
        else:
            constrain(frames, frames, order, rows, eroded=False)
            limit_below(frames[rows], most[rows])
