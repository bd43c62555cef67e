"""Play lines: from timed phones to tracks, a stretch of time that fits the processor's cache at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np

from lipdb.engine.finish import Order, Watch, enforce, finish, order_of
from lipdb.engine.gather import gather, raise_at, stitch
from lipdb.engine.smooth import smooth
from lipdb.engine.table import Bools, CurveTable, Floats, Ints
from lipdb.engine.timeline import CONTROL_RATE, Line, Timeline, lay
from lipdb.errors import CurveError
from lipdb.poses import PoseSet
from lipdb.track import Track

CHUNK = 8192
"""Frames worked out at a time."""


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
        self.table, self.pose_set, self.line = table, pose_set, timeline
        self.order: Order = order_of(pose_set)
        line, step = timeline, timeline.rate.control
        self.base = line.cell[line.run]
        self.begins = self.base + line.start // step
        self.ends = self.base + -(-(line.start + line.first_length + line.second_length) // step)
        self.shuts: Bools = np.any(table.closing[pose_set.must_reach], axis=0)
        self.window = pose_set.window * CONTROL_RATE

    def margin(self) -> int:
        """Control points on each side of a stretch that what happens in it can depend on."""
        reach = sum(4 + math.ceil(CONTROL_RATE / float(self.order.speed[rows].min(initial=CONTROL_RATE))) for rows in self.order.levels)
        return reach + 2 * math.ceil(self.window) + 4

    def stretch(self, begin: int, end: int, watch: Watch | None = None) -> tuple[Floats, Floats, int]:
        """Control points and spline ``(P, T)`` around control points *begin* to *end*, and where the first column lies."""
        low, high = begin - self.margin(), end + self.margin()
        pairs = slice(int(np.searchsorted(self.ends, low)), int(np.searchsorted(self.begins, high, side="right")))
        line, step = self.line, self.line.rate.control
        if pairs.start < pairs.stop:
            low, high = min(low, int(self.begins[pairs.start])), max(high, int(self.ends[pairs.stop - 1]) + 2)
        first, second, start = line.first_length[pairs], line.second_length[pairs], line.start[pairs]
        keys = gather(self.table, line.pair[pairs], start, first, second, step=step, base=self.base[pairs])
        held = np.arange(self.order.held)
        weights = np.ascontiguousarray(stitch(self.table, keys, self.order.row, held, begin=low, width=high - low))
        if watch:
            watch("stitched", slice(0, len(weights)), weights)
        borders = (start + first) / step + (self.base[pairs] - low)
        smooth(weights, self.window, self.order.held, borders, self.shuts[line.pair[pairs] % len(self.table.phones)])
        if watch:
            watch("smoothed", slice(0, len(weights)), weights)
        return *finish(weights, self.order, rate=CONTROL_RATE, watch=watch), low

    def frames(self, begin: int, end: int) -> Floats:
        """Weights by row ``(P, end - begin)`` at frames *begin* to *end* of the axis."""
        if self.line.rate.on_grid:
            _, done, low = self.stretch(begin, end)
            return done[:, begin - low : end - low]
        fps = self.line.rate.fps
        margin = sum(1 + math.ceil(fps / float(self.order.speed[rows].min(initial=fps))) for rows in self.order.levels)
        low, high = max(begin - margin, 0), min(end + margin, self.line.axis)
        frames = self._sampled(low, high)
        enforce(frames, self.order, fps=fps)
        return frames[:, begin - low : end - low]

    def _sampled(self, begin: int, end: int) -> Floats:
        """The spline at frames *begin* to *end*, must-reach poses raised to every key nearest to a frame."""
        line, rate = self.line, self.line.rate
        if not len(line.cell):
            return np.zeros((len(self.order.row), end - begin))
        at = np.arange(begin, end)
        run = np.maximum(np.searchsorted(line.first_frame, at, side="right") - 1, 0)
        cell, rest = np.divmod((at - line.frame[run]) * rate.frame, rate.control)
        cell += line.cell[run]
        cell = np.clip(cell, line.low[run] + 1, line.high[run] - 3)
        control, _, zero = self.stretch(int(cell[0]), int(cell[-1]) + 1)
        t = rest / rate.control
        parts = ((1 - t) ** 3, 3 * t**3 - 6 * t**2 + 4, -3 * t**3 + 3 * t**2 + 3 * t + 1, t**3)
        frames = np.zeros((len(control), len(at)))
        for k, part in enumerate(parts):
            frames += (part / 6) * control[:, cell - zero + k - 1]
        np.minimum(frames, 1, out=frames)
        self._reach(frames, begin)
        return frames

    def _reach(self, frames: Floats, begin: int) -> None:
        """Raise must-reach poses at the frame nearest to each of their keys to that key's weight."""
        line, step = self.line, self.line.rate.frame
        base = line.frame[line.run]
        low, high = begin - 2, begin + frames.shape[1] + 2
        first_frame, last_frame = base + line.start // step, base + (line.start + line.first_length + line.second_length) // step
        pairs = slice(int(np.searchsorted(last_frame, low)), int(np.searchsorted(first_frame, high, side="right")))
        keys = gather(
            self.table,
            line.pair[pairs],
            line.start[pairs],
            line.first_length[pairs],
            line.second_length[pairs],
            step=step,
            base=base[pairs],
        )
        row = self.order.row[self.table.pose[keys.index]]
        held = row < self.order.held
        column = keys.base[held] - begin + np.floor(keys.place[held] + 0.5).astype(np.int64)
        raise_at(frames, row[held], column, self.table.weight[keys.index[held]])


def animate_lines(
    table: CurveTable, pose_set: PoseSet, lines: Sequence[Line], *, fps: float = 60, frames: Sequence[int] | None = None
) -> Tracks:
    """Play many lines in one go; the same as `animate` of each.

    *lines* are ``(edges, phones)``: whole microseconds, one more than there are phones, and common phones of *table*.
    *frames* asked for of each line; by default every frame up to the first at or after the end, where a line that does
    not end in silence gets 0.25 s of it. Raises `InputError`, `ScheduleError` and `CurveError` for what can't be played.
    """
    if table.poses != pose_set.poses:
        raise CurveError(f"the table of curves is for poses {', '.join(table.poses)}, not for those of pose set {pose_set.name!r}")
    slowest = float(pose_set.speed.min())
    timeline = lay(table, lines, fps=fps, frames=frames, window=pose_set.window, slowest=slowest)
    player = Player(table, pose_set, timeline)
    axis = np.empty((len(pose_set.poses), timeline.axis))
    for begin in range(0, timeline.axis, CHUNK):
        end = min(begin + CHUNK, timeline.axis)
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
