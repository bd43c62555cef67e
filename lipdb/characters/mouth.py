"""How far a mesh's mouth is open and how wide it is, measured between its inner lips."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lipdb.characters.mesh import Floats, Mesh
from lipdb.errors import MeshError

UPPER, LOWER, RIGHT, LEFT = "inner_lip_upper", "inner_lip_lower", "inner_corner_right", "inner_corner_left"


def measure(mesh: Mesh, weights: Floats, shapes: Sequence[str]) -> tuple[Floats, Floats]:
    """Opening and width of the mouth in every frame.

    *weights* have shape ``(frames, shapes)``; the result is two arrays ``(frames,)`` in units of the mesh: the height
    between the middles of the inner lips (never below 0: lips that press on each other are closed) and the distance
    between the inner corners. Both are linear in the weights. Shapes that the mesh lacks count nothing.
    Raises `MeshError` for a mesh without the four landmarks.
    """
    opening = _difference(mesh, UPPER, LOWER, axis=1, shapes=shapes)
    width = _difference(mesh, RIGHT, LEFT, axis=0, shapes=shapes)
    weights = np.asarray(weights, float)
    return np.maximum(0, opening[0] + weights @ opening[1:]), np.maximum(0, width[0] + weights @ width[1:])


def _difference(mesh: Mesh, first: str, second: str, *, axis: int, shapes: Sequence[str]) -> Floats:
    """The distance of two landmarks along *axis*: at rest, then what each of *shapes* adds to it."""
    return _place(mesh, first, axis=axis, shapes=shapes) - _place(mesh, second, axis=axis, shapes=shapes)


def _place(mesh: Mesh, landmark: str, *, axis: int, shapes: Sequence[str]) -> Floats:
    if landmark not in mesh.landmarks:
        raise MeshError(f"mesh {mesh.name!r} has no landmark {landmark!r}; its mouth can't be measured")
    part, vertex = mesh.landmarks[landmark]
    piece = mesh.parts[part]
    moved = [piece.shapes[shape][vertex, axis] if shape in piece.shapes else 0.0 for shape in shapes]
    return np.array([piece.positions[vertex, axis], *moved])
