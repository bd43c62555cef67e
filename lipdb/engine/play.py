"""Play lines: from timed phones to tracks, a stretch of time that fits the processor's cache at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import overload

import numpy as np

from lipdb.engine.finish import Order, Watch, control, enforce, order_of
from lipdb.engine.gather import gather, stitch
from lipdb.engine.limits import peaks, spline
from lipdb.engine.lines import Line
from lipdb.engine.smooth import smooth
from lipdb.engine.table import Bools, CurveTable, Floats, Ints
from lipdb.engine.timeline import CONTROL_RATE, Timeline, lay
from lipdb.errors import CurveError
from lipdb.poses import PoseSet
from lipdb.track import Track

CHUNK = 8192
"""Frames worked out at a time: few enough for the processor's cache, many enough for numpy."""


def _keep_memory() -> None:
    """Have glibc keep freed memory for the next array.

    It hands larger blocks back to the system and gets them anew page by page, which takes longer than the arithmetic
    here. Freeing one large block, never touched, raises the size from which it does so (mallopt(3), M_MMAP_THRESHOLD).
    """
    np.empty(2**21)


_keep_memory()


@dataclass(frozen=True, eq=False)
class Tracks(Sequence[Track]):
    """The tracks of many lines; they share one array of weights *axis* ``(P, frames)``, so a track costs nothing."""

    axis: Floats
    origin: Ints
    frames: Ints
    poses: tuple[str, ...]
    fps: float

    def __len__(self) -> int:
        return len(self.frames)

    @overload
    def __getitem__(self, index: int) -> Track: ...
    @overload
    def __getitem__(self, index: slice) -> Tracks: ...
    def __getitem__(self, index: int | slice) -> Track | Tracks:
        if isinstance(index, slice):
            return Tracks(self.axis, self.origin[index], self.frames[index], self.poses, self.fps)
        start = int(self.origin[index])
        return Track(self.axis[:, start : start + int(self.frames[index])].T, self.poses, self.fps)


class Player:
    """One pose set's curves over one timeline; plays any stretch of its axis."""

    def __init__(self, table: CurveTable, pose_set: PoseSet, timeline: Timeline) -> None:
        self.table, self.line = table, timeline
        self.order: Order = order_of(pose_set)
        self.shuts: Bools = np.any(table.closing[pose_set.must_reach], axis=0)
        self.window = pose_set.window * CONTROL_RATE
        self.margin = _margin(self.order, CONTROL_RATE) + 2 * math.ceil(self.window) + 4
        again = any(self.order.outrun) or not timeline.rate.on_grid
        self.frame_margin = _margin(self.order, timeline.rate.fps) if again else 0

    def control(self, begin: int, end: int, watch: Watch | None = None) -> tuple[Floats, int]:
        """Control points ``(P, T)``, true from cell *begin* to *end* and more on both sides; the cell of the first."""
        low, high = begin - self.margin, end + self.margin
        pairs = self.line.pairs.between(low, high)
        if len(pairs.base):
            low, high = min(low, int(pairs.base[0])), max(high, int(pairs.stop[-1]) + 2)
        keys = gather(self.table, pairs.pair, pairs.base, pairs.rest, pairs.first, pairs.second, pairs.step)
        weights = stitch(self.table, keys, self.order.row, self.order.held, begin=low, width=high - low)
        if watch:
            watch("stitched", slice(0, len(weights)), weights, low)
        borders = (pairs.rest + pairs.first) / pairs.step + (pairs.base - low)
        smooth(weights, self.window, self.order.held, borders, self.shuts[pairs.pair % len(self.table.phones)])
        if watch:
            watch("smoothed", slice(0, len(weights)), weights, low)
        control(weights, self.order, rate=CONTROL_RATE, watch=watch, first=low)
        return weights, low

    def frames(self, begin: int, end: int, watch: Watch | None = None) -> Floats:
        """Weights by row ``(P, end - begin)`` at frames *begin* to *end* of the axis."""
        rate = self.line.rate
        low, high = max(begin - self.frame_margin, 0), min(end + self.frame_margin, self.line.axis)
        if rate.on_grid:
            points, zero = self.control(low, high, watch)
            frames = spline(points[:, low - zero - 1 : high - zero + 1])[:, 1:-1]
        else:
            frames = self.sampled(low, high, watch)
        if watch:
            watch("splined", slice(0, len(frames)), frames, low)
        enforce(frames, self.order, fps=rate.fps, raised=not rate.on_grid)
        return frames[:, begin - low : end - low]

    def sampled(self, begin: int, end: int, watch: Watch | None = None) -> Floats:
        """The spline at frames *begin* to *end*; the frames nearest to the peaks of must-reach poses reach them."""
        cell, part = self.line.cells(np.arange(begin, end))
        points, zero = self.control(int(cell[0]), int(cell[-1]) + 1, watch)
        basis = ((1 - part) ** 3, 3 * part**3 - 6 * part**2 + 4, -3 * part**3 + 3 * part**2 + 3 * part + 1, part**3)
        frames = np.zeros((len(points), end - begin))
        for k, weight in enumerate(basis, -1):
            frames += weight / 6 * points[:, cell - zero + k]
        np.minimum(frames, 1, out=frames)
        first, last = peaks(points[: self.order.held])
        for at in (np.minimum(first + 1, last), np.maximum(last - 1, first)):
            row, column = np.divmod(at, points.shape[1])
            frame = self.line.nearest_frames(column + zero) - begin
            inside = (frame >= 0) & (frame < end - begin)
            np.maximum.at(frames, (row[inside], frame[inside]), points.reshape(-1)[at[inside]])
        return frames


@lru_cache(maxsize=64)
def _margin(order: Order, rate: float) -> int:
    """Points, *rate* a second, that constraints and speed limits can reach across."""
    groups = (slice(0, order.held), *order.levels)
    return sum(4 + math.ceil(rate / float(order.speed[rows].min(initial=rate))) for rows in groups)


def prepared(table: CurveTable, pose_set: PoseSet, lines: Sequence[Line], *, fps: float, frames: Sequence[int] | None) -> Player:
    """A player for *lines*; see `animate_lines`."""
    if table.poses != pose_set.poses:
        raise CurveError(f"the table of curves is for poses {', '.join(table.poses)}, not for those of pose set {pose_set.name!r}")
    slowest = order_of(pose_set).slowest
    return Player(table, pose_set, lay(table, lines, fps=fps, frames=frames, window=pose_set.window, slowest=slowest))


def animate_lines(
    table: CurveTable, pose_set: PoseSet, lines: Sequence[Line], *, fps: float = 60, frames: Sequence[int] | None = None
) -> Tracks:
    """Play many lines in one go; the same as `animate` of each.

    *lines* are ``(edges, phones)``: whole microseconds, one more than there are phones, and common phones of *table*.
    *frames* asked for of each line; by default every frame up to the first at or after the end, where a line that does
    not end in silence gets 0.25 s of it. Raises `InputError`, `ScheduleError` and `CurveError` for what can't be played.
    """
    if not len(lines):
        return Tracks(np.zeros((len(pose_set.poses), 0)), np.zeros(0, np.int64), np.zeros(0, np.int64), pose_set.poses, fps)
    player = prepared(table, pose_set, lines, fps=fps, frames=frames)
    timeline = player.line
    axis = np.empty((len(pose_set.poses), timeline.axis))
    parts = max(1, round(timeline.axis / CHUNK))
    for begin, end in pairwise(timeline.axis * part // parts for part in range(parts + 1)):
        axis[player.order.pose, begin:end] = player.frames(begin, end)
    return Tracks(axis, timeline.origin, timeline.frames, pose_set.poses, fps)


def animate(
    table: CurveTable, pose_set: PoseSet, edges: Sequence[int], phones: Sequence[str], *, fps: float = 60, frames: int | None = None
) -> Track:
    """Pose weights of one line: gather, stitch, smooth, then constrain, limit and spline by priority.

    *edges* are whole microseconds, ``len(phones) + 1`` of them; *phones* are common phones of *table*. Frame ``k`` is at
    ``k / fps`` seconds. See `animate_lines` for the rest.
    """
    return animate_lines(table, pose_set, [(edges, phones)], fps=fps, frames=None if frames is None else [frames])[0]
