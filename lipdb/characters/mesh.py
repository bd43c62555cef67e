"""A face as triangles: parts with colours, and for every shape how far each vertex moves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import MeshError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

DECIMALS = 5
"""Built coordinates are rounded to this, so that the last bits of another processor do not change a file."""

UNSEEN = 3e-4
"""A built vertex that a shape moves by less than this, of a head two units high, stays where it is."""


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One piece of a mesh with one material.

    *positions* have shape ``(n, 3)`` (y up, the face looks along +z), *faces* ``(m, 3)`` (counter-clockwise seen from
    outside), *colours* ``(n, 3)`` in sRGB 0..1. *shapes* gives each shape's displacements, ``(n, 3)``; a shape that is
    not in it leaves the part where it is. *roughness* and *specular* are 0..1.
    """

    name: str
    positions: Floats
    faces: Ints
    colours: Floats
    roughness: float = 0.6
    specular: float = 0.35
    shapes: Mapping[str, Floats] = field(default_factory=dict)

    def __post_init__(self) -> None:
        n = len(self.positions)
        if self.positions.shape != (n, 3) or self.colours.shape != (n, 3):
            raise MeshError(f"mesh part {self.name!r}: positions and colours must be {n} rows of 3 numbers")
        if self.faces.ndim != 2 or self.faces.shape[1] != 3:
            raise MeshError(f"mesh part {self.name!r}: faces must be triangles")
        if self.faces.size and (self.faces.min() < 0 or self.faces.max() >= n):
            raise MeshError(
                f"mesh part {self.name!r}: a face names vertex {int(self.faces.max())}, but there are {n}; export the mesh again"
            )
        for shape, moved in self.shapes.items():
            if moved.shape != (n, 3):
                raise MeshError(
                    f"mesh part {self.name!r}: shape {shape!r} has {len(moved)} vertices, the mesh {n}; export all shapes from one mesh"
                )

    def rounded(self) -> Part:
        """The same part with coordinates of `DECIMALS` decimals, and without movements that nobody can see."""
        seen = {name: np.abs(moved).max(axis=1, keepdims=True) > UNSEEN for name, moved in self.shapes.items()}
        shapes = {name: np.asarray(np.round(np.where(seen[name], moved, 0.0), DECIMALS) + 0.0) for name, moved in self.shapes.items()}
        shapes = {name: moved for name, moved in shapes.items() if moved.any()}
        positions = np.asarray(np.round(self.positions, DECIMALS) + 0.0)
        colours = np.asarray(np.round(np.clip(self.colours, 0, 1), DECIMALS) + 0.0)
        return Part(self.name, positions, self.faces, colours, self.roughness, self.specular, shapes)


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """A face: parts, and *landmarks* that name single vertices as ``(part, vertex)``."""

    name: str
    parts: tuple[Part, ...]
    landmarks: Mapping[str, tuple[int, int]] = field(default_factory=dict)

    @property
    def shape_names(self) -> tuple[str, ...]:
        """Every shape's name once, in the order in which the parts first have them."""
        return tuple(dict.fromkeys(shape for part in self.parts for shape in part.shapes))

    @property
    def vertices(self) -> int:
        """How many vertices all parts have together."""
        return sum(len(part.positions) for part in self.parts)

    def morphed(self, weights: Mapping[str, float]) -> list[Floats]:
        """Each part's positions with the shapes added at *weights*; shapes that the mesh lacks move nothing."""
        moved = []
        for part in self.parts:
            positions = part.positions
            for shape, weight in weights.items():
                if weight and shape in part.shapes:
                    positions = positions + weight * part.shapes[shape]
            moved.append(positions)
        return moved


def vertex_normals(positions: Floats, faces: Ints) -> Floats:
    """Unit normals ``(n, 3)``, each the mean of the faces around the vertex weighted by area.

    A vertex without a face, or between faces that cancel out, gets +z.
    """
    a, b, c = positions[faces[:, 0]], positions[faces[:, 1]], positions[faces[:, 2]]
    across = np.cross(b - a, c - a)
    corners = faces.ravel()
    sums = np.stack([np.bincount(corners, np.repeat(across[:, k], 3), minlength=len(positions)) for k in range(3)], axis=1)
    length = np.linalg.norm(sums, axis=1, keepdims=True)
    return np.where(length > 1e-12, sums / np.maximum(length, 1e-12), np.array([0.0, 0.0, 1.0]))
