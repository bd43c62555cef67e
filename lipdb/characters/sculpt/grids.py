"""Grids of points and the triangles between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lipdb.characters.mesh import Floats, Ints, vertex_normals
from lipdb.characters.sculpt.fields import Point


def grid_faces(rows: int, columns: int, *, closed: bool = True) -> Ints:
    """Triangles of a grid of ``rows x columns`` points, row after row; *closed* joins the last column to the first."""
    i = np.arange(rows - 1)[:, None]
    j = np.arange(columns if closed else columns - 1)[None]
    a, b = i * columns + j, i * columns + (j + 1) % columns
    c, d = a + columns, b + columns
    return np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([b, d, c], -1).reshape(-1, 3)])


def fan_faces(pole: int, ring: Ints) -> Ints:
    """Triangles from one point to a closed ring of others."""
    return np.stack([np.full(len(ring), pole), ring, np.roll(ring, -1)], axis=-1)


def outward(positions: Floats, faces: Ints, directions: Floats) -> Ints:
    """*faces*, turned round together if most normals point against *directions*."""
    facing = np.einsum("ij,ij->i", vertex_normals(positions, faces), directions).mean()
    return faces if facing > 0 else faces[:, ::-1]


def ball(rings: Sequence[float] | Floats, columns: int) -> tuple[Floats, Ints, Floats]:
    """A unit sphere with its poles on the z axis: positions, faces, and each point's angle from +z.

    *rings* are the angles between the poles at which points stand.
    """
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    t, p = np.meshgrid(np.asarray(rings, float), around, indexing="ij")
    sides = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1).reshape(-1, 3)
    positions = np.concatenate([sides, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    n = len(sides)
    last = np.arange(columns) + n - columns
    faces = np.concatenate([grid_faces(len(rings), columns), fan_faces(n, np.arange(columns)), fan_faces(n + 1, last)[:, ::-1]])
    faces[: -2 * columns] = faces[: -2 * columns, ::-1]
    return positions, outward(positions, faces, positions), np.concatenate([t.ravel(), [0.0, np.pi]])


def tube(path: Floats, radii: Floats, columns: int) -> tuple[Floats, Ints, Floats]:
    """A round tube along *path* ``(n, 3)``: positions, faces, and each point's place along it, 0..1."""
    tangent = np.gradient(path, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    side = np.cross(tangent, [0.21, 0.13, 0.97])
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    other = np.cross(tangent, side)
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    ring = side[:, None] * np.cos(around)[None, :, None] + other[:, None] * np.sin(around)[None, :, None]
    positions = (path[:, None] + radii[:, None, None] * ring).reshape(-1, 3)
    faces = outward(positions, grid_faces(len(path), columns), ring.reshape(-1, 3))
    return positions, faces, np.repeat(np.linspace(0, 1, len(path)), columns)


def through(points: list[Point], count: int) -> Floats:
    """*count* points of a smooth curve through the given ones (a polynomial of degree 4 at most)."""
    given = np.array([list(point) for point in points], dtype=float)
    k, t = np.arange(len(given)), np.linspace(0, len(given) - 1, count)
    degree = min(4, len(given) - 1)
    return np.stack([np.polyval(np.polyfit(k, given[:, i], degree), t) for i in range(given.shape[1])], axis=-1)


def joined(pieces: list[tuple[Floats, Ints]]) -> tuple[Floats, Ints]:
    """Several meshes as one."""
    starts = np.cumsum([0] + [len(positions) for positions, _ in pieces])
    return np.concatenate([p for p, _ in pieces]), np.concatenate([f + start for (_, f), start in zip(pieces, starts, strict=False)])
