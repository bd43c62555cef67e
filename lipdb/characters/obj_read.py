"""Read a face from OBJ files, one a shape: the neutral face first, the others with the same vertices."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from lipdb.characters.mesh import Floats, Ints, Mesh, Part
from lipdb.errors import MeshError

NEUTRAL = ("neutral", "base", "rest", "basis")
LARGEST_FILE, MOST_FILES = 64 * 1024 * 1024, 500
GREY = 0.75


def object_files(folder: Path) -> list[Path]:
    """The OBJ files of *folder*, the neutral one first: it is called neutral, base, basis or rest, else it is the first by name."""
    files = sorted(file for file in folder.glob("*") if file.suffix.lower() == ".obj" and file.is_file()) if folder.is_dir() else []
    if len(files) < 2:
        raise MeshError(f"{folder}: {len(files)} OBJ files in it; it needs neutral.obj and one for each shape")
    if len(files) > MOST_FILES:
        raise MeshError(f"{folder}: more than {MOST_FILES} OBJ files in it; keep one for each shape")
    return sorted(files, key=lambda file: (file.stem.lower() not in NEUTRAL, file.name))


def read_objects(folder: Path, *, name: str) -> Mesh:
    """The face in *folder*, each other file a shape of its name. Raises `MeshError` when the files don't fit together."""
    neutral, *others = object_files(folder)
    positions, faces = read_obj(neutral)
    if not len(faces):
        raise MeshError(f"{neutral}: no faces in it; export the mesh with its faces")
    shapes = {}
    for file in others:
        moved, _ = read_obj(file)
        if len(moved) != len(positions):
            raise MeshError(f"{file}: {len(moved)} vertices, but {neutral.name} has {len(positions)}; export all shapes from one mesh")
        shapes["_".join(file.stem.split())] = moved - positions
    colours = np.full_like(positions, GREY)
    return Mesh(name, (Part(name, positions, faces, colours, shapes=shapes),))


def read_obj(file: Path) -> tuple[Floats, Ints]:
    """Positions ``(n, 3)`` and triangles ``(m, 3)`` of one OBJ file; larger faces are cut into fans. Raises `MeshError`."""
    try:
        if file.stat().st_size > LARGEST_FILE:
            raise MeshError(f"{file}: larger than {LARGEST_FILE >> 20} MiB; export the head alone")
        text = file.read_text("utf-8", errors="replace")
    except OSError as error:
        raise MeshError(f"{file}: can't be read ({error.strerror}); give an OBJ file") from error
    points: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    for number, line in enumerate(text.splitlines(), 1):
        kind, *words = line.split() or [""]
        try:
            if kind == "v":
                points.append([float(word) for word in words[:3]])
            elif kind == "f":
                corners = [_corner(word, len(points)) for word in words]
                faces += [(corners[0], b, c) for b, c in pairwise(corners[1:])]
        except ValueError as error:
            raise MeshError(f"{file}:{number}: {line.strip()[:40]!r} is not a vertex or face ({error}); export it again") from error
    return _checked(file, points, faces)


def _corner(word: str, count: int) -> int:
    """The vertex that a corner such as ``7/2/5`` or ``-1`` names, from 0."""
    index = int(word.split("/")[0])
    return index - 1 if index > 0 else count + index


def _checked(file: Path, points: list[list[float]], faces: list[tuple[int, int, int]]) -> tuple[Floats, Ints]:
    if not points or any(len(point) != 3 for point in points):
        raise MeshError(f"{file}: no vertices of three numbers in it; give an OBJ file")
    positions, triangles = np.array(points), np.array(faces, dtype=np.int64).reshape(-1, 3)
    if not np.isfinite(positions).all():
        raise MeshError(f"{file}: a vertex is not a number; export it again")
    if triangles.size and (triangles.min() < 0 or triangles.max() >= len(positions)):
        raise MeshError(f"{file}: a face names vertex {int(triangles.max()) + 1}, but there are {len(positions)}; export it again")
    return positions, triangles
