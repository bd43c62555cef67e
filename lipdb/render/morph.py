"""A mesh bent by the weights of its shapes: positions and normals, in numpy alone.

pyrender carries morph targets but never draws them, so both painters get their vertices from here. What no shape moves
is worked out once.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lipdb.render.scene import Floats

if TYPE_CHECKING:
    from lipdb.characters.mesh import Mesh

Ints = NDArray[np.intp]
STILL = 1e-3
"""A vertex that a shape moves by less than this part of its largest movement stays: it would move by less than a tenth of a pixel."""

_TOWARDS_FRONT = np.array([0, 0, 1], np.float32)


class Morph:
    """All parts of a mesh laid end to end: *positions* (n, 3), *faces* (m, 3), linear *colours* (n, 3), *finish* (n, 2).

    *moving* vertices are those that any shape moves; *changing* ones may also turn their normal.
    """

    def __init__(self, mesh: Mesh) -> None:
        parts = mesh.parts
        sizes = [len(part.positions) for part in parts]
        starts = np.cumsum([0, *sizes])
        self.positions: Floats = np.concatenate([part.positions for part in parts]).astype(np.float32)
        self.faces: Ints = np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=False)]).astype(np.intp)
        self.colours: Floats = np.concatenate([_linear(part.colours, size) for part, size in zip(parts, sizes, strict=True)])
        self.finish: Floats = np.repeat(np.array([(part.roughness, part.specular) for part in parts], np.float32), sizes, axis=0)
        self.shapes = _shapes(parts, starts)
        self.moving: Ints = np.unique(np.concatenate([rows for rows, _ in self.shapes.values()] or [np.empty(0, np.intp)]))
        self._prepare_normals(np.repeat(np.arange(len(parts)), sizes))

    def _prepare_normals(self, part_of: Ints) -> None:
        """Vertices of one part at one place share a normal; only faces near moving vertices are worked out again."""
        from scipy.sparse import csr_array

        place = np.column_stack([part_of.astype(np.float32), self.positions])
        _, shared = np.unique(place, axis=0, return_inverse=True)
        corners = shared.reshape(-1)[self.faces]
        moves = np.zeros(len(self.positions), bool)
        moves[self.moving] = True
        bent = moves[self.faces].any(axis=1)
        touched = np.zeros(corners.max(initial=-1) + 1, bool)
        touched[corners[bent]] = True
        near = touched[corners].any(axis=1)
        rows = corners[near].reshape(-1)
        columns = np.repeat(np.arange(near.sum()), 3)
        self._gather = csr_array((np.ones(len(rows), np.float32), (rows, columns)), shape=(len(touched), int(near.sum())))
        self._bent_faces = self.faces[near]
        self._turning = np.flatnonzero(np.isin(shared.reshape(-1), np.flatnonzero(touched)))
        self.changing: Ints = np.union1d(self.moving, self._turning)
        self._turning_place = shared.reshape(-1)[self._turning]
        every = csr_array(
            (np.ones(corners.size, np.float32), (corners.reshape(-1), np.repeat(np.arange(len(corners)), 3))),
            shape=(int(shared.max(initial=-1)) + 1, len(corners)),
        )
        self.normals: Floats = _unit(every @ _cross(self.positions, self.faces))[shared.reshape(-1)]

    def at(self, weights: Mapping[str, float]) -> tuple[Floats, Floats]:
        """Positions and unit normals, each ``(n, 3)``, with each shape added by its weight; unknown shapes move nothing."""
        positions, normals = self.positions.copy(), self.normals.copy()
        for name, weight in weights.items():
            if weight and name in self.shapes:
                rows, deltas = self.shapes[name]
                positions[rows] += np.float32(weight) * deltas
        sums = self._gather @ _cross(positions, self._bent_faces)
        normals[self._turning] = _unit(sums[self._turning_place])
        return positions, normals


def _linear(colours: Any, size: int) -> Floats:
    """Colours in sRGB 0..1, one or one a vertex, as linear light ``(size, 3)``."""
    srgb = np.clip(np.broadcast_to(np.asarray(colours, np.float32)[..., :3], (size, 3)), 0, 1)
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).astype(np.float32)


def _shapes(parts: Any, starts: NDArray[np.int_]) -> dict[str, tuple[Ints, Floats]]:
    """Shape name to the rows it moves and by how much, over all parts."""
    largest: dict[str, float] = {}
    for part in parts:
        for name, delta in part.shapes.items():
            largest[name] = max(largest.get(name, 0.0), float(np.abs(delta).max(initial=0)))
    rows: dict[str, list[Ints]] = {}
    deltas: dict[str, list[Floats]] = {}
    for part, start in zip(parts, starts, strict=False):
        for name, delta in part.shapes.items():
            far = np.abs(delta).max(axis=1)
            moved = np.flatnonzero(far > STILL * largest[name])
            rows.setdefault(name, []).append(moved + start)
            deltas.setdefault(name, []).append(np.asarray(delta, np.float32)[moved])
    return {name: (np.concatenate(rows[name]), np.concatenate(deltas[name])) for name in rows}


def _cross(positions: Floats, faces: Ints) -> Floats:
    """Normals of *faces*, as long as twice their area."""
    corner = positions[faces[:, 0]]
    a, b = positions[faces[:, 1]] - corner, positions[faces[:, 2]] - corner
    return np.stack(
        [a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1], a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2], a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]], axis=1
    )


def _unit(vectors: Floats) -> Floats:
    """*vectors* of length one; those of no length point at the camera's side (+z)."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(length > 1e-12, vectors / np.maximum(length, 1e-12), _TOWARDS_FRONT).astype(np.float32)
