"""Fine patches over the coarse head, for the skin round the eyes.

The head's grid turns about the mouth, so it is coarse elsewhere and can't have a second hole. A patch is a grid of its
own on the same surface, with the same colours and the same movements, so that its border does not show.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lipdb.characters.mesh import Bools, Floats, Ints
from lipdb.characters.sculpt.fields import Distance, raycast, smoothstep


@dataclass(frozen=True, slots=True, eq=False)
class Window:
    """The part of *form*'s surface that a patch covers, as angles (radians) seen from *centre* inside of it.

    *middle* and *half* are sideways angles, *up* and *down* (negative) angles over and under the horizon. A ray leaves
    the body at the first way out more than *begin* away from the centre.
    """

    form: Distance
    centre: Floats
    begin: float
    middle: float
    half: float
    up: float
    down: float

    def surface(self, sideways: Floats, up: Floats) -> Floats:
        """The body's points in these directions."""
        rays = np.stack([np.sin(sideways) * np.cos(up), np.sin(up), np.cos(sideways) * np.cos(up)], axis=-1)
        return np.asarray(self.centre + raycast(self.form, self.centre, rays, begin=self.begin)[:, None] * rays)

    def angles(self, points: Floats) -> tuple[Floats, Floats]:
        """Sideways and upward angle of *points*."""
        q = points - self.centre
        return np.arctan2(q[:, 0], q[:, 2]), np.arctan2(q[:, 1], np.hypot(q[:, 0], q[:, 2]))

    def reach(self, points: Floats) -> Floats:
        """0 in the window's middle, 1 on its border, 9 for points that are not on the part of the surface it covers."""
        sideways, up = self.angles(points)
        reach = np.hypot((sideways - self.middle) / self.half, up / np.where(up >= 0, self.up, -self.down))
        q = points - self.centre
        distance = np.linalg.norm(q, axis=1)
        close = np.flatnonzero((reach < 1) & (distance < 0.5))
        away = np.abs(distance[close] - raycast(self.form, self.centre, q[close] / distance[close, None], begin=self.begin)) > 0.02
        reach[close[away]] = 9.0
        return np.where(distance < 0.5, reach, 9.0)


def sink(window: Window, positions: Floats, faces: Ints, *, behind: Bools) -> tuple[Floats, Ints]:
    """The mesh with nothing over the patch: covered faces go, points near the border lie just below it.

    *behind* marks points that must not be seen through a hole in the patch: they sink deep.
    """
    reach = window.reach(positions)
    hidden = behind & (reach < 1)
    depth = np.where(hidden, 0.75, 1 - 0.010 * smoothstep(0.95, 0.75, reach) - 0.06 * smoothstep(0.74, 0.58, reach))
    sunk = window.centre + (positions - window.centre) * depth[:, None]
    covered = (reach < 0.82) | hidden
    return sunk, faces[~covered[faces].all(axis=1)]


def carried(points: Floats, source: Floats, shapes: Mapping[str, Floats]) -> dict[str, Floats]:
    """Displacements of *points* taken from the nearest vertices of *source*, the nearer the more."""
    margin = 0.15
    near = np.flatnonzero(((source > points.min(0) - margin) & (source < points.max(0) + margin)).all(axis=1))
    distance = ((points[:, None] - source[near][None]) ** 2).sum(-1)
    closest = np.argsort(distance, axis=1, kind="stable")[:, :6]
    weight = 1 / (np.take_along_axis(distance, closest, axis=1) + 1e-5)
    weight /= weight.sum(axis=1, keepdims=True)
    return {name: np.einsum("nk,nkc->nc", weight, moved[near][closest]) for name, moved in shapes.items()}
