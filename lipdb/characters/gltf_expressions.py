"""VRM's expressions as shapes: each a mix of morph targets, under VRM 1's names."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from lipdb.characters.gltf_file import GltfFile
from lipdb.characters.gltf_scene import Placed
from lipdb.characters.mesh import Part

VOWELS = {"a": "aa", "i": "ih", "u": "ou", "e": "ee", "o": "oh"}
"""The vowels of VRM 0 under their names of VRM 1."""

LONGEST = 10_000


@dataclass(frozen=True, slots=True)
class _Bind:
    """Target *target* of node *node* (VRM 1) or mesh *mesh* (VRM 0), *weight* of it; -1 for what it does not say."""

    node: int
    mesh: int
    target: int
    weight: float


def with_expressions(file: GltfFile, parts: Sequence[Part], origins: Sequence[tuple[Placed, list[str]]]) -> list[Part]:
    """*parts* with a shape more for each expression; *origins* tells each part's node, mesh and target names.

    A target that already has the expression's name stays as it is.
    """
    taken = {name for _, names in origins for name in names}
    mixed = [dict(part.shapes) for part in parts]
    for name, binds in _expressions(file):
        if name in taken:
            continue
        for bind in binds:
            for shapes, part, (placed, names) in zip(mixed, parts, origins, strict=True):
                if bind.target >= len(names) or (placed.mesh if bind.mesh >= 0 else placed.node) != max(bind.mesh, bind.node):
                    continue
                target = names[bind.target]
                if target in part.shapes:
                    moved = bind.weight * part.shapes[target]
                    shapes[name] = shapes[name] + moved if name in shapes else moved
    return [replace(part, shapes=shapes) for part, shapes in zip(parts, mixed, strict=True)]


def _expressions(file: GltfFile) -> Iterator[tuple[str, list[_Bind]]]:
    """The name and the binds of every preset expression in the file."""
    extensions = file.content.get("extensions")
    if not isinstance(extensions, dict):
        return
    one = _inside(extensions, "VRMC_vrm", "expressions", "preset")
    for name, expression in one.items() if isinstance(one, dict) else ():
        binds = _binds(file, _inside(expression, "morphTargetBinds"), "node", 1.0)
        if binds and name.isidentifier():
            yield name, binds
    groups = _inside(extensions, "VRM", "blendShapeMaster", "blendShapeGroups")
    for group in file.items(groups if isinstance(groups, list) else None, "the expressions"):
        preset = _inside(group, "presetName")
        binds = _binds(file, _inside(group, "binds"), "mesh", 0.01)
        if binds and isinstance(preset, str) and preset.isidentifier() and preset != "unknown":
            yield VOWELS.get(preset.lower(), preset.lower()), binds


def _binds(file: GltfFile, entries: Any, holder: str, unit: float) -> list[_Bind]:
    binds = []
    for entry in file.items(entries if isinstance(entries, list) else None, "the binds of an expression")[:LONGEST]:
        bind = file.object(entry, "a bind of an expression")
        place = file.whole(bind.get(holder, -1), f"the {holder} of a bind", low=-1)
        target = file.whole(bind.get("index"), "the target of a bind")
        weight = unit * file.numbers([bind.get("weight", 1 / unit)], 1, "the weight of a bind")[0]
        binds.append(_Bind(place if holder == "node" else -1, place if holder == "mesh" else -1, target, weight))
    return binds


def _inside(value: Any, *keys: str) -> Any:
    """What stands under *keys* in nested objects, or None."""
    for key in keys:
        value = value.get(key) if isinstance(value, Mapping) else None
    return value
