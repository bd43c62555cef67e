"""Curves compiled into flat arrays: what the engine reads, and nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import CurveError
from lipdb.schedule import SILENCE

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

GRAIN = 2.0**19
"""Adding and taking away this rounds a weight to a multiple of 2 ** -33, about 1e-10.

Weights on that grain are equal when they are equal by definition, however they were worked out: plateaus stay plateaus.
"""
REACH = 0.5
"""A phone closes a pose when its pairs bring it, on average, to this part of the pose's largest weight in the table."""


class Drawn(Protocol):
    """What the engine needs of a curve."""

    @property
    def keys(self) -> tuple[tuple[float, float], ...]:
        """Normalised time and weight, both in 0..1, by time."""

    @property
    def warp(self) -> str:
        """``border``: time 0.5 stays on the border of the two phones; ``linear``: one straight time over both."""


@dataclass(frozen=True, eq=False)
class CurveTable:
    """The curves of every pair of *phones* (silence first) for every one of *poses*.

    Curves are cut into strips of *K* keys, so that numpy can take them side by side: the last key of a strip is the
    first of the one that continues it, and the last key of a curve is repeated to fill its strip. Pair ``(a, b)`` has
    the number ``a * N + b``; its strips are ``first[pair] : first[pair + 1]``, by pose and then by time. Each key, ``(K,
    strips)``, stands at *left* times the length of the first phone plus *right* times that of the second after the
    pair's start, and has *weight*; *pose* and *continues* ``(strips,)`` tell the pose, and whether the strip goes on with
    the curve before it. Outside its keys a curve is 0.
    """

    phones: tuple[str, ...]
    poses: tuple[str, ...]
    first: Ints
    left: Floats
    right: Floats
    weight: Floats
    pose: Ints
    continues: Bools
    mean_reach: Floats

    @classmethod
    def build(cls, phones: Sequence[str], poses: Sequence[str], curves: Mapping[tuple[str, str, str], Drawn]) -> Self:
        """Compile *curves*, (left, right, pose) to curve; a pair without an entry, or with an empty one, is 0.

        Silence is added in front if *phones* lacks it. Raises `CurveError` for a warp or keys that can't be played;
        entries for other phones or poses are not looked at.
        """
        names = (SILENCE, *(p for p in dict.fromkeys(phones) if p != SILENCE))
        count, pairs = len(names), len(names) ** 2
        parts: list[tuple[Floats, int, int]] = []
        reach = np.zeros((len(poses), count))
        for number, p in product(range(1, pairs), range(len(poses))):  # between silence and silence there is rest
            a, b = divmod(number, count)
            curve = curves.get((names[a], names[b], poses[p]))
            if curve is not None and curve.keys:
                parts.append((_placed(curve, f"curve {names[a]} {names[b]} {poses[p]}"), number, p))
                reach[p, [a, b]] += _own_parts(curve) if a != b else max(_own_parts(curve))
        keys, owner = _strips([part[0] for part in parts])
        numbers = np.array([part[1] for part in parts], dtype=np.int64)[owner]
        return cls(
            names,
            tuple(poses),
            np.searchsorted(numbers, np.arange(pairs + 1)),
            keys[0],
            keys[1],
            keys[2] + GRAIN - GRAIN,
            np.array([part[2] for part in parts], dtype=np.int64)[owner],
            np.append(False, owner[1:] == owner[:-1])[: len(owner)],
            reach / max(2 * count - 2, 1),
        )

    @cached_property
    def number(self) -> dict[str, int]:
        """The index of each phone."""
        return {phone: i for i, phone in enumerate(self.phones)}

    @cached_property
    def closing(self) -> Bools:
        """Which phones close which pose, shape ``(P, N)``.

        Derived from the curves, so a pose set of any name and a phone of any name have it: a phone closes a pose when
        the largest weight in its own part of a pair, averaged over all its pairs, is at least half of the pose's
        largest weight anywhere. The quarter of the phone next to the border is left out: there the neighbour shows.
        With the shipped curves bmp closes PBM and f closes FV, and no other phone closes either.
        """
        largest = np.zeros(len(self.poses))
        np.maximum.at(largest, self.pose, self.weight.max(axis=0))
        closes: Bools = (self.mean_reach >= REACH * largest[:, None]) & (largest[:, None] > 0)
        closes[:, 0] = False
        return closes


def _strips(parts: list[Floats]) -> tuple[Floats, Ints]:
    """Curves as strips of equal length, ``(3, K, strips)``, and which curve each strip is of; *K* makes the fewest lines."""
    lines = np.array([part.shape[1] - 1 for part in parts], dtype=np.int64)
    size = min(range(1, 9), key=lambda k: int((-(-lines // k) * (k + 1)).sum()))
    owner = np.repeat(np.arange(len(parts)), -(-lines // size))
    keys = np.zeros((3, size + 1, len(owner)))
    strip = 0
    for part in parts:
        for start in range(0, part.shape[1] - 1, size):
            keys[:, :, strip] = part[:, np.minimum(np.arange(start, start + size + 1), part.shape[1] - 1)]
            strip += 1
    return keys, owner


def _placed(curve: Drawn, where: str) -> Floats:
    """Where the keys of *curve* stand in units of the first and of the second phone, and their weights, ``(3, keys)``."""
    time, weight = np.array(curve.keys, dtype=np.float64).T
    bad = not (np.isfinite(time).all() and np.isfinite(weight).all()) or (np.diff(time) < 0).any()
    if bad or time[0] < 0 or time[-1] > 1 or weight.min() < 0 or weight.max() > 1:
        raise CurveError(f"{where}: keys must run forward in time and lie in 0..1, not {curve.keys}")
    tied = int(np.searchsorted(time, time[-1]))
    if tied < len(time) - 1:  # a step at the very end: the frame on it takes the largest weight
        time, weight = time[: tied + 1], np.append(weight[:tied], weight[tied:].max())
    if len(time) == 1:
        time, weight = np.repeat(time, 2), np.repeat(weight, 2)
    if curve.warp == "border":
        return np.array((np.minimum(2 * time, 1), np.maximum(2 * time - 1, 0), weight))
    if curve.warp == "linear":
        return np.array((time, time, weight))
    raise CurveError(f"{where}: warp {curve.warp!r} is neither border nor linear")


def _own_parts(curve: Drawn) -> tuple[float, float]:
    """The largest weight in each phone's own part of a curve: its half without the quarter of the phone at the border."""
    time, weight = zip(*curve.keys, strict=True)
    edges = np.interp((0.375, 0.625), time, weight, 0, 0)
    first = max((w for t, w in curve.keys if t <= 0.375), default=0.0)
    second = max((w for t, w in curve.keys if t >= 0.625), default=0.0)
    return max(first, float(edges[0])), max(second, float(edges[1]))
