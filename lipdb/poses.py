"""A pose set: the static face shapes that curves weigh, and the rules that the engine keeps among them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import PhonesetError

SHARED = "facefx"
"""The pose set that the shared curves are for: every other set is reached from it through links."""
FREE = 2.0
"""The threshold that never binds: two weights in 0..1 add up to no more."""


@dataclass(frozen=True, eq=False)
class PoseSet:
    """Poses in order, with what the engine must know about each of ``P`` and about each pair of them.

    *priority* decides who yields to whom (None yields to every pose that has one); *speed* ``(P,)`` is the largest
    change of weight a second; *must_reach* ``(P,)`` marks poses whose peaks hold whatever happens, such as closed
    lips; *threshold* ``(P, P)``, symmetric, is the most that two weights may add up to; valleys between two peaks
    closer than *window* seconds are filled. Raises `PhonesetError` for anything that the engine could not keep.
    """

    name: str
    poses: tuple[str, ...]
    priority: tuple[int | None, ...]
    speed: NDArray[np.float64]
    must_reach: NDArray[np.bool_]
    threshold: NDArray[np.float64]
    window: float

    def __post_init__(self) -> None:
        count = len(self.poses)
        where = f"pose set {self.name!r}"
        if not count or len(set(self.poses)) != count:
            raise PhonesetError(f"{where}: poses must be there and differ, not {', '.join(self.poses) or 'none'}")
        if not (len(self.priority) == len(self.speed) == len(self.must_reach) == count) or self.threshold.shape != (count, count):
            raise PhonesetError(f"{where}: every one of its {count} poses needs a priority, a speed, must_reach and thresholds")
        if not (np.isfinite(self.speed).all() and (self.speed > 0).all()):
            raise PhonesetError(f"{where}: speeds must be above 0 a second, not {self.speed.tolist()}")
        if not (self.threshold == self.threshold.T).all() or not (self.threshold >= 0).all():
            raise PhonesetError(f"{where}: thresholds must be 0 or more and the same both ways")
        if not (np.isfinite(self.window) and self.window >= 0):
            raise PhonesetError(f"{where}: the window must be 0 seconds or more, not {self.window:g}")

    @classmethod
    def from_records(cls, records: Mapping[str, Mapping[tuple[str, ...], Mapping[str, str]]], name: str) -> Self:
        """The pose set *name* of the curated tables ``poses/`` and ``constraints/``.

        Raises `PhonesetError` when there is no such set, or a constraint names a pose that it lacks.
        """
        path = f"poses/{name}.tsv"
        row = records.get("poses/sets.tsv", {}).get((name,))
        rows = sorted(records.get(path, {}).values(), key=lambda r: (int(r["position"]), r["pose"]))
        if row is None or not rows:
            known = ", ".join(key[0] for key in sorted(records.get("poses/sets.tsv", {}))) or "none"
            raise PhonesetError(f"pose set {name!r} is not in poses/sets.tsv and {path}; there are: {known}")
        poses = tuple(r["pose"] for r in rows)
        threshold = np.full((len(poses), len(poses)), float(row["threshold"]))
        constraints = f"constraints/{name}.tsv"
        for pose, other in records.get(constraints, {}):
            if pose not in poses or other not in poses:
                raise PhonesetError(f"{constraints}: {pose} {other}: {path} has no such pose; it has {', '.join(poses)}")
            a, b = poses.index(pose), poses.index(other)
            threshold[a, b] = threshold[b, a] = float(records[constraints][pose, other]["threshold"])
        return cls(
            name,
            poses,
            tuple(int(r["priority"]) if r["priority"] else None for r in rows),
            np.array([float(r["speed"]) for r in rows]),
            np.array([r["must_reach"] == "yes" for r in rows]),
            threshold,
            float(row["window"]),
        )

    @cached_property
    def descending(self) -> tuple[int, ...]:
        """Poses by rank, highest first: must-reach poses, then by priority, then those without one in order of the set.

        Must-reach poses come first whatever their number, because nothing may lower them: where one of them meets a
        threshold with another pose, the other one yields.
        """

        def rank(i: int) -> tuple[bool, bool, int, int]:
            priority = self.priority[i]
            return not self.must_reach[i], priority is None, -(priority or 0), i

        return tuple(sorted(range(len(self.poses)), key=rank))

    @cached_property
    def opening(self) -> str:
        """The pose that yields to every other one that has a priority: in all sets that ship, that of the open mouth."""
        ranked = [i for i in self.descending if self.priority[i] is not None]
        return self.poses[ranked[-1] if ranked else 0]

    def bounds(self, pose: int) -> tuple[tuple[int, float], ...]:
        """The higher poses that can hold *pose* down, each with its threshold; none for a must-reach pose."""
        if self.must_reach[pose]:
            return ()
        higher = self.descending[: self.descending.index(pose)]
        return tuple((j, float(self.threshold[pose, j])) for j in higher if self.threshold[pose, j] < FREE)

    @cached_property
    def levels(self) -> tuple[tuple[int, ...], ...]:
        """Poses that can be worked out together, in order: a pose stands one level below the lowest that bounds it.

        Level 0 holds the must-reach poses and may be empty; every other level holds poses that are not.
        """
        level: dict[int, int] = {}
        for i in self.descending:
            level[i] = 0 if self.must_reach[i] else 1 + max((level[j] for j, _ in self.bounds(i)), default=0)
        return tuple(tuple(i for i in self.descending if level[i] == n) for n in range(max(level.values()) + 1))
