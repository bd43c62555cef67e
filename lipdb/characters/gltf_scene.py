"""Where a glTF file's meshes stand: its nodes, their transforms and skins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lipdb.characters.gltf_accessor import read_floats
from lipdb.characters.gltf_file import GltfFile
from lipdb.characters.mesh import Floats


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """Mesh number *mesh* of node number *node*, moved by the 4 x 4 matrix *place*."""

    node: int
    mesh: int
    place: Floats


def placed_meshes(file: GltfFile) -> list[Placed]:
    """Every mesh of the scene, in the order of the nodes. A file without nodes has each of its meshes once, unmoved."""
    if not file.table("nodes"):
        return [Placed(-1, index, np.eye(4)) for index in range(len(file.table("meshes")))]
    places = _places(file)
    found = []
    for node, place in sorted(places.items()):
        entry = file.entry("nodes", node)
        if "mesh" not in entry:
            continue
        mesh = file.whole(entry["mesh"], f"the mesh of node {node}", high=max(len(file.table("meshes")) - 1, 0))
        found.append(Placed(node, mesh, _skinned(file, entry["skin"], places) if "skin" in entry else place))
    return found


def _places(file: GltfFile) -> dict[int, Floats]:
    """The matrix of every node that the scene holds."""
    scenes = file.table("scenes")
    if scenes:
        scene = file.entry("scenes", file.content.get("scene", 0))
        roots = file.items(scene.get("nodes"), "the nodes of the scene")
    else:
        nodes = [entry for entry in file.table("nodes") if isinstance(entry, dict)]
        children = {child for entry in nodes for child in file.items(entry.get("children"), "children") if isinstance(child, int)}
        roots = [index for index in range(len(file.table("nodes"))) if index not in children]
    places: dict[int, Floats] = {}
    waiting = [(root, np.eye(4)) for root in roots]
    while waiting:
        node, parent = waiting.pop()
        entry = file.entry("nodes", node)
        if node in places:
            raise file.fault(f"node {node} hangs in two places; export the file again")
        places[node] = parent @ _own_place(file, entry, node)
        if not np.abs(places[node]).max() < 1e9:
            raise file.fault(f"node {node} is scaled beyond reason; export the file again")
        waiting += [(child, places[node]) for child in file.items(entry.get("children"), f"the children of node {node}")]
    return places


def _own_place(file: GltfFile, entry: Mapping[str, Any], node: int) -> Floats:
    """A node's own matrix, from ``matrix`` or from translation, rotation and scale."""
    if "matrix" in entry:
        return np.array(file.numbers(entry["matrix"], 16, f"the matrix of node {node}")).reshape(4, 4).T
    x, y, z, w = file.numbers(entry.get("rotation", [0, 0, 0, 1]), 4, f"the rotation of node {node}")
    length = x * x + y * y + z * z + w * w
    turn = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]) if abs(length - 1) < 0.01 else np.eye(3)  # fmt: skip
    place = np.eye(4)
    place[:3, :3] = turn * np.array(file.numbers(entry.get("scale", [1, 1, 1]), 3, f"the scale of node {node}"))
    place[:3, 3] = file.numbers(entry.get("translation", [0, 0, 0]), 3, f"the translation of node {node}")
    return place


def _skinned(file: GltfFile, skin: Any, places: Mapping[int, Floats]) -> Floats:
    """The matrix of a mesh that hangs on bones: that of its first bone.

    In the pose in which it was bound, which is the one that files hold, it is the same for all of its bones.
    """
    entry = file.entry("skins", skin)
    joints = file.items(entry.get("joints"), f"the joints of skin {skin}")
    if not joints:
        raise file.fault(f"skin {skin} has no joints; export the file again")
    file.entry("nodes", joints[0])
    bound = np.eye(4)
    if "inverseBindMatrices" in entry:
        bound = read_floats(file, entry["inverseBindMatrices"], "MAT4")[0].reshape(4, 4).T
    return np.asarray(places.get(joints[0], np.eye(4)) @ bound)
