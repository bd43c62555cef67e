"""Read a face from a glTF file: binary (.glb), VRM 0 and 1 (.vrm), or text (.gltf).

What a part looks like comes from its material's base colour, its texture at each vertex, and its vertex colours.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lipdb.characters.gltf_accessor import accessor_count, read_floats, read_indices
from lipdb.characters.gltf_expressions import with_expressions
from lipdb.characters.gltf_file import GltfFile, open_gltf, parse_gltf
from lipdb.characters.gltf_look import surface_look
from lipdb.characters.gltf_scene import Placed, placed_meshes
from lipdb.characters.mesh import Floats, Ints, Mesh, Part

LARGEST_MOVES = 12_000_000
"""Vertices times shapes of a whole file, at most."""

LONGEST_NAME = 120


def read_glb(path: Path, *, name: str) -> Mesh:
    """The face in the file at *path*, called *name*. Raises `MeshError` with one line for anything that is wrong."""
    return _mesh(open_gltf(path), name)


def parse_glb(data: bytes, *, name: str) -> Mesh:
    """The face in the bytes of a file. Raises `MeshError`."""
    return _mesh(parse_gltf(data, where=name), name)


def _mesh(file: GltfFile, name: str) -> Mesh:
    parts: list[Part] = []
    origins: list[tuple[Placed, list[str]]] = []
    moves = 0
    for placed in placed_meshes(file):
        entry = file.entry("meshes", placed.mesh)
        for number, primitive in enumerate(file.items(entry.get("primitives"), f"the primitives of mesh {placed.mesh}")):
            where = f"mesh {placed.mesh} primitive {number}"
            found = file.object(primitive, where)
            targets = file.items(found.get("targets"), f"the targets of {where}")
            moves += _positions_count(file, found, where) * (1 + len(targets))
            moves += accessor_count(file, found["indices"]) if "indices" in found else 0
            if moves > LARGEST_MOVES:
                raise file.fault(f"has more than {LARGEST_MOVES} vertices times shapes; export the head alone")
            names = _target_names(file, entry, found, len(targets))
            part = _part(file, found, names, placed, f"{where}", f"{_text(entry.get('name')) or 'mesh'}_{len(parts)}")
            if part is not None:
                parts.append(part)
                origins.append((placed, names))
    if not any(part.shapes for part in parts):
        raise file.fault("has no morph targets; export the face with its shape keys (blend shapes)")
    return Mesh(name, tuple(with_expressions(file, parts, origins)))


def _positions_count(file: GltfFile, primitive: Mapping[str, Any], where: str) -> int:
    attributes = file.object(primitive.get("attributes"), f"the attributes of {where}")
    if "POSITION" not in attributes:
        raise file.fault(f"{where} has no positions; export the file again")
    return accessor_count(file, attributes["POSITION"])


def _part(file: GltfFile, primitive: Mapping[str, Any], names: list[str], placed: Placed, where: str, name: str) -> Part | None:
    """One primitive as a part, or None when it has no triangles (points and lines)."""
    attributes = file.object(primitive.get("attributes"), f"the attributes of {where}")
    own = read_floats(file, attributes["POSITION"], "VEC3")
    faces = _faces(file, primitive, len(own), where)
    if faces is None:
        return None
    turn = placed.place[:3, :3]
    if np.linalg.det(turn) < 0:
        faces = faces[:, ::-1]
    shapes: dict[str, Floats] = {}
    for shape, target in zip(names, file.items(primitive.get("targets"), f"the targets of {where}"), strict=True):
        entry = file.object(target, f"target {shape!r} of {where}")
        if "POSITION" in entry:
            moved = read_floats(file, entry["POSITION"], "VEC3", count=len(own)) @ turn.T
            shapes[shape] = shapes[shape] + moved if shape in shapes else moved
    positions = own @ turn.T + placed.place[:3, 3]
    colours, roughness = surface_look(file, primitive, attributes, len(own), where)
    return Part(name, positions, faces, colours, roughness, 0.3, {shape: moved for shape, moved in shapes.items() if moved.any()})


def _faces(file: GltfFile, primitive: Mapping[str, Any], count: int, where: str) -> Ints | None:
    """The primitive's triangles, from a list, a strip or a fan."""
    mode = primitive.get("mode", 4)
    if mode not in (4, 5, 6):
        return None
    order = read_indices(file, primitive["indices"]) if "indices" in primitive else np.arange(count)
    if order.max() >= count:
        raise file.fault(f"{where}: a triangle names vertex {int(order.max())}, but there are {count}; export the file again")
    if mode == 4:
        if len(order) % 3:
            raise file.fault(f"{where}: {len(order)} indices are not triangles; export the file again")
        return order.reshape(-1, 3)
    if len(order) < 3:
        raise file.fault(f"{where}: {len(order)} indices are no triangle; export the file again")
    if mode == 6:
        return np.stack([np.full(len(order) - 2, order[0]), order[1:-1], order[2:]], axis=1)
    strip = np.stack([order[:-2], order[1:-1], order[2:]], axis=1)
    strip[1::2] = strip[1::2, ::-1]
    return strip


def _target_names(file: GltfFile, mesh: Mapping[str, Any], primitive: Mapping[str, Any], count: int) -> list[str]:
    """What the targets are called: ``extras.targetNames`` of mesh or primitive, else the accessors' names, else numbers."""
    for holder in (mesh, primitive):
        extras = holder.get("extras")
        given = extras.get("targetNames") if isinstance(extras, dict) else None
        if isinstance(given, list) and len(given) == count:
            return [_text(name) or f"target_{i}" for i, name in enumerate(given)]
    names = []
    for index, target in enumerate(file.items(primitive.get("targets"), "targets")):
        accessor = target.get("POSITION") if isinstance(target, dict) else None
        name = _text(file.entry("accessors", accessor).get("name")) if accessor is not None else ""
        names.append(name or f"target_{index}")
    return names if len(set(names)) == count else [f"target_{index}" for index in range(count)]


def _text(value: Any) -> str:
    """A name from the file as one printable word, empty for anything else."""
    if not isinstance(value, str):
        return ""
    printable = "".join(c if c.isprintable() else " " for c in value)
    return "_".join(printable.split())[:LONGEST_NAME]
