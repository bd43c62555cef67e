"""Write a mesh with its shapes, and how they move, as one binary glTF file (glTF 2.0, Khronos 2021).

Vertices that a shape does not move are left out of it (sparse accessors). The same mesh and track give the same bytes.
"""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipdb.characters.mesh import Floats, Mesh, Part, vertex_normals
from lipdb.track import Track

VERTICES, INDICES = 34962, 34963
FLOAT, SHORT, INT = 5126, 5123, 5125
STILL, STEADY = 1e-5, 1e-2
"""Smaller movements of a vertex, and smaller turns of a normal, are not written."""


class _Buffer:
    """The binary part of the file, and the accessors into it."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def _view(self, array: NDArray[Any], target: int | None = None) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        raw = np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<")).tobytes()
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)}
        self.views.append(view if target is None else {**view, "target": target})
        self.data += raw
        return len(self.views) - 1

    def add(self, array: NDArray[Any], component: int, kind: str, *, target: int | None = None, bounds: bool = False, **more: Any) -> int:
        """An accessor that holds all of *array*."""
        accessor = {"bufferView": self._view(array, target), "componentType": component, "count": len(array), "type": kind, **more}
        self.accessors.append({**accessor, **(_bounds(array) if bounds else {})})
        return len(self.accessors) - 1

    def add_moved(self, moved: Floats, least: float) -> int:
        """An accessor of displacements that holds only the rows longer than *least*, or all when that is smaller."""
        moves = np.abs(moved).max(axis=1) > least
        whole = np.where(moves[:, None], moved, 0).astype(np.float32)
        rows = np.flatnonzero(moves) if moves.any() else np.array([0])  # a sparse accessor must hold something
        index, component = (rows.astype(np.uint16), SHORT) if len(moved) < 65536 else (rows.astype(np.uint32), INT)
        if len(rows) * (index.itemsize + 12) >= len(moved) * 12:
            return self.add(whole, FLOAT, "VEC3", target=VERTICES, bounds=True)
        sparse = {
            "count": len(rows),
            "indices": {"bufferView": self._view(index), "componentType": component},
            "values": {"bufferView": self._view(whole[rows])},
        }
        self.accessors.append({"componentType": FLOAT, "count": len(moved), "type": "VEC3", **_bounds(whole), "sparse": sparse})
        return len(self.accessors) - 1


def _bounds(array: NDArray[Any]) -> dict[str, list[float]]:
    low, high = np.atleast_1d(array.min(axis=0)), np.atleast_1d(array.max(axis=0))
    return {"min": [float(x) for x in low], "max": [float(x) for x in high]}


def glb_bytes(mesh: Mesh, *, animation: Track | None = None) -> bytes:
    """*mesh* as a GLB file; *animation* moves its shapes by the weights of poses of the same names.

    One primitive a part, all with the same targets, as the format asks for; their names stand in ``extras.targetNames``.
    Poses of the track that the mesh lacks are left out. Normals are written for the shapes too.
    """
    buffer, names = _Buffer(), mesh.shape_names
    primitives = [_primitive(buffer, part, index, names) for index, part in enumerate(mesh.parts)]
    face: dict[str, Any] = {"name": mesh.name, "primitives": primitives}
    if names:
        face |= {"weights": [0.0] * len(names), "extras": {"targetNames": list(names)}}
    content: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "lipdb"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": mesh.name, "mesh": 0}],
        "meshes": [face],
        "materials": [_material(part) for part in mesh.parts],
    }
    if animation is not None and names and len(animation.weights):
        content["animations"] = [_animation(buffer, animation, names)]
    buffer.data += b"\0" * (-len(buffer.data) % 4)
    content |= {"accessors": buffer.accessors, "bufferViews": buffer.views, "buffers": [{"byteLength": len(buffer.data)}]}
    return _container(json.dumps(content, separators=(",", ":"), allow_nan=False).encode(), bytes(buffer.data))


def write_glb(path: Path, mesh: Mesh, *, animation: Track | None = None) -> None:
    """Write `glb_bytes` to *path*."""
    path.write_bytes(glb_bytes(mesh, animation=animation))


def _container(text: bytes, data: bytes) -> bytes:
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(data))
    return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def _material(part: Part) -> dict[str, Any]:
    # Specular strength travels in the metal-rough model only as roughness; 1 is the format's own base colour.
    surface = {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 0.0, "roughnessFactor": round(part.roughness, 4)}
    return {"name": part.name, "pbrMetallicRoughness": surface}


def _primitive(buffer: _Buffer, part: Part, material: int, names: tuple[str, ...]) -> dict[str, Any]:
    normals = vertex_normals(part.positions, part.faces)
    colours = np.round(_linear(part.colours) * 65535).astype(np.uint16)
    opaque = np.concatenate([colours, np.full((len(colours), 1), 65535, dtype=np.uint16)], axis=1)
    attributes = {
        "POSITION": buffer.add(part.positions.astype(np.float32), FLOAT, "VEC3", target=VERTICES, bounds=True),
        "NORMAL": buffer.add(_float_units(normals), FLOAT, "VEC3", target=VERTICES),
        "COLOR_0": buffer.add(opaque, SHORT, "VEC4", target=VERTICES, normalized=True),
    }
    small = len(part.positions) < 65535
    indices = part.faces.ravel().astype(np.uint16 if small else np.uint32)
    primitive = {
        "attributes": attributes,
        "indices": buffer.add(indices, SHORT if small else INT, "SCALAR", target=INDICES),
        "material": material,
        "mode": 4,
    }
    if names:
        primitive["targets"] = [_target(buffer, part, normals, name) for name in names]
    return primitive


def _target(buffer: _Buffer, part: Part, normals: Floats, name: str) -> dict[str, int]:
    moved = part.shapes.get(name)
    if moved is None:
        still = np.zeros_like(part.positions)
        return {"POSITION": buffer.add_moved(still, STILL), "NORMAL": buffer.add_moved(still, STEADY)}
    turned = vertex_normals(part.positions + moved, part.faces) - normals
    return {"POSITION": buffer.add_moved(moved, STILL), "NORMAL": buffer.add_moved(turned, STEADY)}


def _animation(buffer: _Buffer, track: Track, names: tuple[str, ...]) -> dict[str, Any]:
    weights = np.zeros((len(track.weights), len(names)), dtype=np.float32)
    for pose in set(track.poses) & set(names):
        weights[:, names.index(pose)] = track.pose(pose)
    times = buffer.add(track.times.astype(np.float32), FLOAT, "SCALAR", bounds=True)
    sampler = {"input": times, "output": buffer.add(weights.ravel(), FLOAT, "SCALAR"), "interpolation": "LINEAR"}
    return {"name": "speech", "samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}


def _linear(colours: Floats) -> Floats:
    """Colours in sRGB as linear light, which the format wants for vertex colours."""
    colours = np.clip(colours, 0, 1)
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def _float_units(normals: Floats) -> NDArray[np.float32]:
    single = normals.astype(np.float32)
    return np.asarray(single / np.linalg.norm(single, axis=1, keepdims=True), dtype=np.float32)
