"""A closed surface that has a mouth: rings of confocal ellipses around a slit, and a bag behind it.

Elliptic coordinates: ``u = c cosh(mu) cos(theta)``, ``v = c sinh(mu) sin(theta)``. The ring ``mu = 0`` is the line where
the lips meet, passed twice: its upper points (``sin theta > 0``) belong to the upper lip, its lower ones to the lower.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lipdb.characters.mesh import Floats, Ints
from lipdb.characters.sculpt.fields import Distance, Point, raycast
from lipdb.characters.sculpt.grids import fan_faces, grid_faces, outward


@dataclass(frozen=True, slots=True)
class Bag:
    """The inside of the mouth, one number a ring, from the lips to the throat.

    *depth* behind the lips, *height* of the roof over and the floor under the line of the lips, *width* as a share of
    the mouth's, all in units of the mesh.
    """

    depth: Sequence[float]
    height: Sequence[float]
    width: Sequence[float]


@dataclass(frozen=True, slots=True, eq=False)
class Slit:
    """Directions from *origin* that wrap a body, ring by ring, away from a slit of half width *half* (radians)."""

    origin: Floats
    axis: Floats
    half: float
    rows: int
    columns: int
    crowd: float = 0.45

    @property
    def mu(self) -> Floats:
        """Each surface point's ring, 0 at the lips, ``(rows * columns,)``."""
        x = np.linspace(0, 1, self.rows)
        last = np.arccosh(np.pi * 0.985 / self.half)
        return np.repeat(last * (self.crowd * x + (1 - self.crowd) * x**1.7), self.columns)

    @property
    def theta(self) -> Floats:
        """Each surface point's angle around the slit; 0 is the corner on +x, pi/2 the upper lip's middle."""
        return np.tile(np.linspace(0, 2 * np.pi, self.columns, endpoint=False), self.rows)

    def directions(self) -> Floats:
        """Unit directions of all surface points."""
        across = self.half * np.cosh(self.mu) * np.cos(self.theta)
        upwards = self.half * np.sinh(self.mu) * np.sin(self.theta)
        angle = np.hypot(across, upwards)
        scale = np.where(angle > 1e-9, np.sin(angle) / np.maximum(angle, 1e-9), 1)
        ahead = self.axis / np.linalg.norm(self.axis)
        right = np.array([1.0, 0.0, 0.0])
        up = np.cross(ahead, right)
        up /= np.linalg.norm(up)
        rays = np.cos(angle)[:, None] * ahead + (scale * across)[:, None] * right + (scale * upwards)[:, None] * up
        return np.asarray(rays / np.linalg.norm(rays, axis=1, keepdims=True))

    def wrap(self, distance: Distance) -> Floats:
        """Points of the body's surface. The body must be alike left and right: only one half is computed."""
        rays = self.directions().reshape(self.rows, self.columns, 3)
        half = np.arange(-(self.columns // 4), self.columns // 4 + 1)
        reach = np.empty((self.rows, self.columns))
        reach[:, half] = raycast(distance, self.origin, rays[:, half].reshape(-1, 3)).reshape(self.rows, -1)
        reach[:, (self.columns // 2 - half) % self.columns] = reach[:, half]
        return np.asarray((self.origin + reach[..., None] * rays).reshape(-1, 3))


@dataclass(frozen=True, slots=True, eq=False)
class MouthSurface:
    """Bag, surface and the two end points as one mesh, with each vertex's place in the grid.

    *sine* and *cosine* of theta, *mu*, *lip* (0 where the lips meet, 1 at the border of the red), and *depth*: 0 on the
    surface, rising to 1 at the throat.
    """

    positions: Floats
    faces: Ints
    mu: Floats
    sine: Floats
    cosine: Floats
    lip: Floats
    depth: Floats
    bag_size: int
    columns: int

    @property
    def surface(self) -> slice:
        """The vertices outside of the mouth."""
        return slice(self.bag_size, len(self.positions) - 2)

    @property
    def line(self) -> Floats:
        """The points where the lips meet, all round, ``(columns, 3)``."""
        return self.positions[self.bag_size : self.bag_size + self.columns]

    def lip_vertex(self, place: str) -> int:
        """The vertex on the line of the lips at *place*: upper, lower, right (+x) or left."""
        return self.bag_size + {"right": 0, "upper": 1, "left": 2, "lower": 3}[place] * self.columns // 4


def with_bag(slit: Slit, surface: Floats, lip: Floats, bag: Bag, middle: Point) -> MouthSurface:
    """Close *surface* (the points of *slit*) at the back, and put the bag behind its lips; *middle* is the bag's height."""
    n, rings = slit.columns, len(bag.depth)
    lips, sine = surface[:n], np.sin(slit.theta[:n])
    inner = []
    for behind, height, width in zip(bag.depth, bag.height, bag.width, strict=True):
        settle = min(1.0, 3 * height / max(bag.height))
        x = lips[:, 0] * width
        y = lips[:, 1] + (middle[1] - lips[:, 1]) * settle + height * np.sign(sine) * np.abs(sine) ** 0.8
        z = lips[:, 2] + (middle[2] - lips[:, 2]) * settle * 0.6 - behind
        inner.append(np.stack([x, y, z], axis=-1))
    positions = np.concatenate([*inner[::-1], surface, [inner[-1].mean(0)], [surface[-n:].mean(0)]])
    last = len(positions) - 2
    ring = np.arange(n)
    faces = np.concatenate([grid_faces(rings + slit.rows, n), fan_faces(last, ring)[:, ::-1], fan_faces(last + 1, ring + last - n)])
    ahead = np.zeros_like(positions)
    ahead[rings * n : last] = surface - slit.origin
    depth = np.concatenate([np.repeat(np.arange(rings, 0, -1) / rings, n), np.zeros(len(surface)), [1.0], [0.0]])
    fields = [_extend(values, n, rings) for values in (slit.mu, np.sin(slit.theta), np.cos(slit.theta), lip)]
    return MouthSurface(positions, outward(positions, faces, ahead), fields[0], fields[1], fields[2], fields[3], depth, rings * n, n)


def _extend(values: Floats, columns: int, rings: int) -> Floats:
    """Values of the surface carried into the bag of *rings*: each bag point takes those of its lip point."""
    first, last = values[:columns], values[-columns:]
    return np.concatenate([np.tile(first, rings), values, [first.mean()], [last.mean()]])
