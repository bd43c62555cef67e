"""A pair of phones played alone: how long its phones last, the schedule of a loop, and what the engine draws of its curves."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise
from statistics import median

import numpy as np

from lipdb.curves.keys import Keys
from lipdb.curves.lookup import CurveBook
from lipdb.engine import CurveTable, animate
from lipdb.poses import PoseSet
from lipdb.schedule import MICROSECONDS, SILENCE, Phone, Schedule
from lipdb.track import Track

USUAL = 0.08
"""Seconds that a phone lasts where nothing else is known: the median of vowels and of consonants in the voices' English."""
REACH = 0.25
"""Seconds of a pause that a pair with silence covers (docs/engine.md)."""
PAUSE = 0.4
"""Seconds of silence on both sides of the loop: the mouth comes to rest in it."""
STEP = 0.01
DRAWN_RATE = 240


@dataclass(frozen=True, slots=True)
class Rehearsal:
    """The pair *left* → *right* between silences, in seconds: the pair lasts from *start* over *border* to *end*."""

    left: str
    right: str
    schedule: Schedule
    start: float
    border: float
    end: float

    @classmethod
    def of(cls, left: str, right: str, lengths: tuple[float, float]) -> Rehearsal:
        """The loop in which the two phones last *lengths* seconds; the length of silence is not asked for."""
        parts = [(phone, max(length, STEP)) for phone, length in zip((left, right), lengths, strict=True) if phone != SILENCE]
        spans = [(SILENCE, PAUSE), *parts, (SILENCE, PAUSE)]
        edges = [0]
        for _, length in spans:
            edges.append(edges[-1] + round(length * MICROSECONDS))
        schedule = Schedule(tuple(edges), tuple(Phone(name, (name,), word=-1) for name, _ in spans))
        first = 0 if left == SILENCE else 1
        start, border, end = (edge / MICROSECONDS for edge in edges[first : first + 3])
        return cls(
            left,
            right,
            schedule,
            max(start, border - REACH) if first == 0 else start,
            border,
            min(end, border + REACH) if right == SILENCE else end,
        )

    @property
    def duration(self) -> float:
        """Seconds of the whole loop."""
        return self.schedule.duration

    def play(self, book: CurveBook, pose_set: PoseSet, *, fps: float = 60) -> Track:
        """The track of the loop, with the pairs around the pair."""
        edges, phones = self.schedule.common()
        return animate(book.table(phones), pose_set, edges, phones, fps=fps)

    def drawn(self, book: CurveBook, pose_set: PoseSet) -> dict[str, Keys]:
        """What the engine makes of the pair's own curves, without the pairs around it: by pose, normalised time and weight."""
        edges, phones = self.schedule.common()
        table = book.table(phones)
        curves = {(self.left, self.right, pose): book.find(self.left, self.right, pose).curve for pose in book.poses}
        # Which phones close which pose is a matter of all pairs.
        alone = replace(CurveTable.build(table.phones, table.poses, curves), mean_reach=table.mean_reach)
        track = animate(alone, pose_set, edges, phones, fps=DRAWN_RATE)
        inside = (track.times > self.start) & (track.times < self.end)
        times = np.concatenate([[self.start], track.times[inside], [self.end]])
        even = (times - self.start) / (self.end - self.start)
        bent = np.interp(times, (self.start, self.border, self.end), (0.0, 0.5, 1.0))
        drawn = {}
        for pose in track.poses:
            at = even if curves[self.left, self.right, pose].warp == "linear" else bent
            weights = np.interp(times, track.times, track.pose(pose))
            drawn[pose] = tuple((round(float(t), 4), round(float(w), 4)) for t, w in zip(at, weights, strict=True))
        return drawn


def occurrences(schedule: Schedule, left: str, right: str) -> list[tuple[float, float, float]]:
    """Where the pair stands in *schedule*: the start, the border and the end of each place, in seconds."""
    edges, names = schedule.common()
    whole = (edges[0] - round(REACH * MICROSECONDS), *edges, edges[-1] + round(REACH * MICROSECONDS))
    around = (SILENCE, *names, SILENCE)
    found = []
    for k, pair in enumerate(pairwise(around)):
        if pair == (left, right):
            start, border, end = (edge / MICROSECONDS for edge in whole[k : k + 3])
            start = max(start, border - REACH) if left == SILENCE else start
            found.append((start, border, min(end, border + REACH) if right == SILENCE else end))
    return found


def usual_lengths(schedules: Iterable[Schedule], left: str, right: str) -> tuple[float, float]:
    """The median lengths of the two phones where they stand as a pair in *schedules*, in whole hundredths of a second.

    `USUAL` when they never do; silence lasts `REACH`.
    """
    places = [place for schedule in schedules for place in occurrences(schedule, left, right)]
    first = [border - start for start, border, _ in places] or [USUAL]
    second = [end - border for _, border, end in places] or [USUAL]

    def length(phone: str, lengths: list[float]) -> float:
        return REACH if phone == SILENCE else max(round(median(lengths), 2), STEP)

    return length(left, first), length(right, second)
