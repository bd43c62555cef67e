"""The engine's result: pose weights, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Weights of shape ``(frames, poses)`` in 0..1; frame ``k`` stands at ``k / fps`` seconds."""

    weights: NDArray[np.float64]
    poses: tuple[str, ...]
    fps: float

    @property
    def times(self) -> NDArray[np.float64]:
        """Seconds of each frame, shape ``(frames,)``."""
        return np.arange(len(self.weights)) / self.fps

    def pose(self, name: str) -> NDArray[np.float64]:
        """One pose's weights, shape ``(frames,)``; raises `KeyError` for a pose that is not in the track."""
        if name not in self.poses:
            raise KeyError(name)
        return self.weights[:, self.poses.index(name)]
