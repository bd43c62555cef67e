"""Sprite cues: one shape at a time, each held long enough to be seen."""

from __future__ import annotations

import math
from collections.abc import Collection
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipdb.track import Track

REST_WEIGHT = 0.12
"""A frame in which no shape weighs more than this is at rest."""

REACHED = 0.5
"""A closure that weighs this much must be seen."""

_SWITCH = 1e-6

Cue = tuple[float, float, str]
"""Start and end in seconds, and the shape between them."""


def cues(track: Track, hold: float, *, keep: Collection[str] = (), rest: str = "X") -> list[Cue]:
    """The shapes of *track*, winner takes all, none held for less than *hold* seconds.

    Contiguous from 0 to the track's end. Of all ways to cut the line that respect *hold*, the one whose shown weights add
    up to most. *keep* names shapes that must not be lost (lips that close): wherever one reaches `REACHED`, its highest
    frame is shown, unless that of another such shape is nearer than *hold*. *rest* is the shape of a frame in which nothing weighs
    more than `REST_WEIGHT`. A line shorter than *hold* is one cue.
    """
    if not len(track.weights):
        return []
    names = track.poses if rest in track.poses else (*track.poses, rest)
    score = np.zeros((len(track.weights), len(names)))
    score[:, : len(track.poses)] = track.weights
    column = names.index(rest)
    score[:, column] = np.maximum(score[:, column], REST_WEIGHT)
    for name in set(keep) & set(track.poses):
        score[_peaks(track.pose(name)), names.index(name)] += 2 * len(score)
    frames = min(max(math.ceil(hold * track.fps - 1e-9), 1), len(score))
    return [(start / track.fps, end / track.fps, names[shape]) for start, end, shape in _best_cut(score, frames)]


def _peaks(weights: NDArray[np.float64]) -> NDArray[np.intp]:
    """The highest frame (the middle of a plateau) of every stretch at `REACHED` or above."""
    reached = np.concatenate([[False], weights >= REACHED, [False]])
    edges = np.flatnonzero(np.diff(reached)).reshape(-1, 2)
    tops = [start + np.flatnonzero(weights[start:end] == weights[start:end].max()) for start, end in edges]
    return np.array([top[len(top) // 2] for top in tops], np.intp)


def _best_cut(score: NDArray[np.float64], hold: int) -> list[tuple[int, int, int]]:
    """``(start, end, column)`` of the cut into pieces of *hold* frames or more whose scores add up to most.

    Dynamic programming over the end of the last piece. What ends inside one stretch of *hold* frames depends only on what
    ended before it, so a whole stretch is one step.
    """
    frames, columns = score.shape
    total = np.concatenate([np.zeros((1, columns)), np.cumsum(score, axis=0)])
    best = np.full(frames + 1, -np.inf)
    best[0] = 0.0
    shape, since = np.zeros(frames + 1, np.intp), np.zeros(frames + 1, np.intp)
    lead, lead_start = np.full(columns, -np.inf), np.zeros(columns, np.intp)
    for first in range(hold, frames + 1, hold):
        ends = np.arange(first, min(first + hold, frames + 1))
        starts = ends - hold
        gain = best[starts, None] - total[starts]
        running = np.maximum.accumulate(np.vstack([lead, gain]))
        renewed = np.where(gain > running[:-1], starts[:, None], -1)
        begun = np.maximum.accumulate(np.vstack([lead_start, renewed]))
        value = total[ends] + running[1:] - _SWITCH
        shape[ends] = value.argmax(axis=1)
        rows = np.arange(len(ends))
        best[ends], since[ends] = value[rows, shape[ends]], begun[1:][rows, shape[ends]]
        lead, lead_start = running[-1], begun[-1]
    return _walk_back(shape, since, frames)


def _walk_back(shape: NDArray[np.intp], since: NDArray[np.intp], end: int) -> list[tuple[int, int, int]]:
    cut = [end]
    shapes = []
    while cut[-1] > 0:
        shapes.append(int(shape[cut[-1]]))
        cut.append(int(since[cut[-1]]))
    pieces: list[tuple[int, int, int]] = []
    for (start, stop), column in zip(pairwise(reversed(cut)), reversed(shapes), strict=True):
        if pieces and pieces[-1][2] == column:
            pieces[-1] = (pieces[-1][0], stop, column)
        else:
            pieces.append((start, stop, column))
    return pieces
