"""A face that does one thing over and over: to look at a pose while its links are edited."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lipdb.errors import InputError
from lipdb.track import Track

SECONDS = 2.0


def raised(poses: Sequence[str], pose: str, *, seconds: float = SECONDS, fps: float = 60.0) -> Track:
    """A track in which *pose* goes from 0 to 1 and back in *seconds*, while all other *poses* rest.

    Raises `InputError` for a pose that is not one of them.
    """
    if pose not in poses:
        raise InputError(f"there is no pose {pose!r}; there are {', '.join(poses)}")
    times = np.arange(round(seconds * fps) + 1) / fps
    weights = np.zeros((len(times), len(poses)))
    weights[:, list(poses).index(pose)] = (1 - np.cos(2 * np.pi * times / seconds)) / 2
    return Track(weights, tuple(poses), fps)


def held(poses: Sequence[str], weights: Mapping[str, float], *, seconds: float = SECONDS, fps: float = 60.0) -> Track:
    """A track in which each of *poses* stays at its weight, 0 for those that *weights* does not name."""
    row = np.array([float(weights.get(pose, 0.0)) for pose in poses])
    return Track(np.tile(row, (round(seconds * fps) + 1, 1)), tuple(poses), fps)
