"""Fit the numbers of articulation to measured lips: least squares through the real engine and Robin's mesh.

For one sentence, 2 (1 - r) is the squared distance of predicted and measured lips, each with mean 0 and length 1. So
the sum of squares below is what the scorer averages. Steps are damped Gauss-Newton with finite differences; *shrink*
pulls every number back to its articulatory start.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from articulation_space import CLOSING, MEASURED, Space
from grid_lips import FPS, FRAMES, Recording
from numpy.typing import NDArray

from lipdb import engine
from lipdb.characters.human import robin
from lipdb.characters.mouth import measure
from lipdb.curves.generate import NEGLIGIBLE, Targets, shapes
from lipdb.curves.keys import DECIMALS
from lipdb.poses import PoseSet
from lipdb.schedule import SILENCE

Floats = NDArray[np.float64]

OPENING = 1.5
"""How much more opening counts than width: it is what people see first."""
STEPS = ((0.3, 8), (0.15, 8), (0.08, 6))
"""Width of the finite differences, in units of how far a number may stray, and the most steps with it."""


def lips_only(pose_set: PoseSet) -> PoseSet:
    """*pose_set* without the poses that leave opening and width of the mouth as they are."""
    moved = [n for n, pose in enumerate(pose_set.poses) if pose in (*MEASURED, *CLOSING)]
    return replace(
        pose_set,
        poses=tuple(pose_set.poses[n] for n in moved),
        priority=tuple(pose_set.priority[n] for n in moved),
        speed=pose_set.speed[moved],
        must_reach=pose_set.must_reach[moved],
        threshold=pose_set.threshold[np.ix_(moved, moved)],
    )


class Lips:
    """The speech frames of a recording: *truth* ``(F, 2)`` measured, `predicted` from targets."""

    def __init__(self, recording: Recording, pose_set: PoseSet) -> None:
        self.pose_set = pose_set
        self.lines = [schedule.common() for schedule in recording.schedules]
        self.phones = sorted({phone for _, phones in self.lines for phone in phones} | {SILENCE})
        frames = [
            (g, k) for g, (edges, _) in enumerate(self.lines) for k in range(-(-edges[0] * FPS // 10**6), edges[-1] * FPS // 10**6 + 1)
        ]
        kept = [(g, k) for g, k in frames if k < FRAMES and np.isfinite(recording.lips[g][k]).all()]
        self.sentence, self.frame = np.array(kept).T
        self.truth = np.array([recording.lips[g][k] for g, k in kept])
        self.word = np.array([_word(recording, g, k) for g, k in kept])

    def predicted(self, targets: Targets) -> Floats:
        """Opening and width at every frame, shape ``(F, 2)``."""
        tracks = engine.animate_lines(
            compiled(targets, self.phones, self.pose_set.poses), self.pose_set, self.lines, fps=FPS, frames=[FRAMES] * len(self.lines)
        )
        weights = tracks.axis[:, tracks.origin[self.sentence] + self.frame].T
        return np.stack(measure(robin(), weights, tracks.poses), axis=-1)

    def residuals(self, lips: Floats, mask: Floats) -> Floats:
        """Predicted minus measured, both standardised by sentence over the frames of *mask*; opening, then width."""
        parts = [self._standard(lips[:, k], mask) - self._standard(self.truth[:, k], mask) for k in (0, 1)]
        return np.concatenate([np.sqrt(OPENING) * parts[0], parts[1]])

    def scores(self, lips: Floats) -> tuple[float, float]:
        """The mean over sentences of Pearson's r for opening and for width, as the scorer gives them."""
        everywhere = np.ones(len(lips))
        count = len(self.lines)
        r = [(self._standard(lips[:, k], everywhere) * self._standard(self.truth[:, k], everywhere)).sum() / count for k in (0, 1)]
        return float(r[0]), float(r[1])

    def _standard(self, values: Floats, mask: Floats) -> Floats:
        size = np.maximum(np.bincount(self.sentence, mask), 1)
        centred = (values - (np.bincount(self.sentence, values * mask) / size)[self.sentence]) * mask
        length = np.sqrt(np.bincount(self.sentence, centred**2))
        standard: Floats = centred / np.maximum(length, 1e-9)[self.sentence]
        return standard


def _word(recording: Recording, g: int, k: int) -> str:
    """The word that is said at frame *k* of sentence *g*: of the last phone that begins at or before it."""
    schedule = recording.schedules[g]
    at = int(np.searchsorted(schedule.edges, k * 10**6 // FPS, side="right")) - 1
    index = schedule.phones[min(max(at, 0), len(schedule.phones) - 1)].word
    return schedule.words[index] if index >= 0 else ""


@dataclass(frozen=True, slots=True)
class Drawn:
    """As much of a curve as the engine reads."""

    keys: tuple[tuple[float, float], ...]
    warp: str = "border"


def compiled(targets: Targets, phones: Sequence[str], poses: Sequence[str]) -> engine.CurveTable:
    """The curves of *targets* for *phones* and *poses*, as the engine plays them."""
    some = np.array([targets.phones.index(phone) for phone in phones])
    left, right = (side.ravel() for side in np.meshgrid(some, some, indexing="ij"))
    # Rounded as text rounds them: a valley that is just filled or not moves with the last decimal.
    times, weights = (np.round(numbers, DECIMALS) for numbers in shapes(targets, left, right))
    curves = {}
    for m, p in np.argwhere(weights.max(axis=-1) >= NEGLIGIBLE).tolist():
        pair = targets.phones[left[m]], targets.phones[right[m]]
        curves[*pair, targets.poses[p]] = Drawn(tuple(zip(times[m, p].tolist(), weights[m, p].tolist(), strict=True)))
    return engine.CurveTable.build(phones, poses, curves)


def fit(lips: Lips, space: Space, *, shrink: float, mask: Floats | None = None, steps: Sequence[tuple[float, int]] = STEPS) -> Floats:
    """The numbers that follow the measured lips best over the frames of *mask*, held to their starts by *shrink*."""
    mask = np.ones(len(lips.truth)) if mask is None else mask
    x, damping = space.x0.copy(), 0.3

    def residuals(x: Floats) -> Floats:
        return lips.residuals(lips.predicted(space.targets(x)), mask)

    def cost(x: Floats, r: Floats) -> float:
        return float(r @ r + shrink * np.sum(((x - space.x0) / space.sd) ** 2))

    r = residuals(x)
    for width, most in steps:
        for _ in range(most):
            before = cost(x, r)
            slopes = _slopes(residuals, x, r, space, width)
            damping = max(damping, 1e-3)
            for _ in range(6):
                step = np.clip(x + _step(slopes, r, x, space, shrink, damping), space.low, space.high)
                there = residuals(step)
                if cost(step, there) < before:
                    x, r, damping = step, there, damping / 3
                    break
                damping *= 5
            if before - cost(x, r) < 1e-4 * before:
                break
    return x


def _slopes(residuals: Callable[[Floats], Floats], x: Floats, r: Floats, space: Space, width: float) -> Floats:
    """How every residual changes with every number, by finite differences that stay within the limits."""
    slopes = np.empty((len(r), len(x)), np.float32)
    for j, sd in enumerate(space.sd):
        there = x.copy()
        there[j] += width * sd if x[j] + width * sd <= space.high[j] else -width * sd
        slopes[:, j] = (residuals(there) - r) / (there[j] - x[j])
    return slopes


def _step(slopes: Floats, r: Floats, x: Floats, space: Space, shrink: float, damping: float) -> Floats:
    """The damped Gauss-Newton step, without the numbers that would leave their limits."""
    square, slope = (slopes.T @ slopes).astype(float), (slopes.T @ r.astype(np.float32)) + shrink * (x - space.x0) / space.sd**2
    free, step = np.ones(len(x), bool), np.zeros(len(x))
    for _ in range(5):
        step[:] = 0
        step[free] = -np.linalg.solve(square[np.ix_(free, free)] + np.diag((shrink + damping) / space.sd[free] ** 2), slope[free])
        stuck = free & (((x <= space.low + 1e-9) & (step < 0)) | ((x >= space.high - 1e-9) & (step > 0)))
        if not stuck.any():
            break
        free &= ~stuck
    return step
