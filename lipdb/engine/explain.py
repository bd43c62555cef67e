"""Every stage of one line to look at, and what made each weight at one instant."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lipdb.engine.gather import gather
from lipdb.engine.play import Player, prepared
from lipdb.engine.table import CurveTable, Floats
from lipdb.errors import InputError
from lipdb.poses import PoseSet
from lipdb.track import Track

STAGES = ("stitched", "smoothed", "constrained", "limited", "splined", "final")
SAME = 1e-6
"""A stage that changes a weight by less has not changed it."""


@dataclass(frozen=True, slots=True, eq=False)
class Laid:
    """One pair's curve laid on the time line: *times* in seconds and *weights* of its keys, joined by straight lines."""

    left: str
    right: str
    pose: str
    times: Floats
    weights: Floats

    def covers(self, time: float) -> bool:
        """Whether *time* seconds lies between the first and the last key."""
        return bool(self.times[0] - 1e-9 <= time <= self.times[-1] + 1e-9)

    def at(self, time: float) -> float:
        """The curve's weight at *time* seconds, between its keys."""
        return float(np.interp(time, self.times, self.weights))


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """One line stage by stage.

    *curves* of all pairs, by time; then, at *times* seconds of the control points, shape ``(points,)``, the weights of
    each pose after every stage up to the speed limit, ``(points, poses)``; *splined* and the *track* have frames.
    For must-reach poses "constrained" means that narrow peaks are held.
    """

    poses: tuple[str, ...]
    curves: tuple[Laid, ...]
    times: Floats
    stitched: Floats
    smoothed: Floats
    constrained: Floats
    limited: Floats
    splined: Floats
    track: Track


@dataclass(frozen=True, slots=True)
class Story:
    """How one pose got its weight at one instant.

    *curves* are (left phone, right phone, weight) of the pairs that lie there and have a curve for the pose; *weights* by
    stage; *stage* is the one that changed the weight most, "" when it is as drawn; *yields_to* the poses whose
    constraints cut into what the curves ask for.
    """

    pose: str
    curves: tuple[tuple[str, str, float], ...]
    weights: dict[str, float]
    stage: str
    yields_to: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Explanation:
    """What made the weights of frame *frame*, at *time* seconds: the *pairs* of phones that lie there, and each pose's story."""

    frame: int
    time: float
    pairs: tuple[tuple[str, str], ...]
    poses: tuple[Story, ...]


def stages(
    table: CurveTable, pose_set: PoseSet, edges: Sequence[int], phones: Sequence[str], *, fps: float = 60, frames: int | None = None
) -> Stages:
    """Play one line and keep what every stage made of it; arguments and errors as for `animate`."""
    player = prepared(table, pose_set, [(edges, phones)], fps=fps, frames=None if frames is None else [frames])
    line, row = player.line, player.order.row
    seen: dict[str, Floats] = {}
    zero: dict[str, int] = {}

    def watch(stage: str, rows: slice, weights: Floats, first: int) -> None:
        seen.setdefault(stage, np.zeros_like(weights))[rows] = weights[rows]
        zero[stage] = first

    final = player.frames(0, line.axis, watch)
    cells = np.arange(int(line.low[0]), int(line.high[-1]))
    stitched, smoothed, constrained, limited = (seen[stage][row].T[cells - zero[stage]] for stage in STAGES[:4])
    asked = slice(int(line.origin[0]), int(line.origin[0] + line.frames[0]))
    track = Track(final[row].T[asked], pose_set.poses, fps)
    splined = seen["splined"][row].T[asked]
    return Stages(pose_set.poses, _laid(player), line.seconds(cells), stitched, smoothed, constrained, limited, splined, track)


def _laid(player: Player) -> tuple[Laid, ...]:
    """The curves of every pair of a single line, where they lie on its time line."""
    table, pairs, rate = player.table, player.line.pairs, player.line.rate
    keys = gather(table, pairs.pair, pairs.base, pairs.rest, pairs.first, pairs.second, pairs.step)
    times = player.line.seconds(keys.base) + keys.place * rate.control / rate.second
    pair = table.first.searchsorted(keys.strip, side="right") - 1
    curves: list[Laid] = []
    for i, strip in enumerate(keys.strip.tolist()):
        here, weights = times[:, i], table.weight[:, strip]
        if table.continues[strip]:
            before = curves.pop()
            here, weights = np.append(before.times, here[1:]), np.append(before.weights, weights[1:])
        moves = np.append(True, (np.diff(here) > 0) | (np.diff(weights) != 0))  # without the repeated last key
        left, right = divmod(int(pair[i]), len(table.phones))
        pose = table.poses[int(table.pose[strip])]
        curves.append(Laid(table.phones[left], table.phones[right], pose, here[moves], weights[moves]))
    return tuple(curves)


def explain(
    table: CurveTable, pose_set: PoseSet, edges: Sequence[int], phones: Sequence[str], *, at: float, fps: float = 60
) -> Explanation:
    """What made each pose's weight at the frame nearest to *at* seconds. Raises `InputError` for a time outside the track."""
    made = stages(table, pose_set, edges, phones, fps=fps)
    last = len(made.track.weights) - 1
    frame = round(at * fps) if math.isfinite(at * fps) else -1
    if not 0 <= frame <= last:
        raise InputError(f"there is nothing to explain at {at:g} s; the track lasts from 0 to {max(last, 0) / fps:g} s")
    there = [curve for curve in made.curves if curve.covers(frame / fps)]
    pairs = tuple(dict.fromkeys((curve.left, curve.right) for curve in there))
    return Explanation(frame, frame / fps, pairs, tuple(_story(made, pose_set, i, frame, there) for i in range(len(made.poses))))


def _story(made: Stages, pose_set: PoseSet, pose: int, frame: int, there: Sequence[Laid]) -> Story:
    """How *pose* got its weight at *frame*, where the curves *there* lie."""
    time, name = frame / made.track.fps, made.poses[pose]

    def then(points: Floats, i: int) -> float:
        return float(np.interp(time, made.times, points[:, i]))

    curves = tuple((curve.left, curve.right, curve.at(time)) for curve in there if curve.pose == name)
    values = [max((value for _, _, value in curves), default=0.0)]
    values += [then(points, pose) for points in (made.stitched, made.smoothed, made.constrained, made.limited)]
    values += [float(frames[frame, pose]) for frames in (made.splined, made.track.weights)]
    changes = np.abs(np.diff(values))
    stage = STAGES[int(changes.argmax())] if changes.max() > SAME else ""
    smoothed = values[2]
    yields = tuple(made.poses[j] for j, limit in pose_set.bounds(pose) if smoothed > max(0.0, limit - then(made.limited, j)) + SAME)
    return Story(name, curves, dict(zip(("curve", *STAGES), values, strict=True)), stage, yields)
