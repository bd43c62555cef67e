"""The mesh with its shapes and the performance as an animation of their weights: glTF in one binary file."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.errors import InputError

if TYPE_CHECKING:
    from lipdb.performance import Performance


def write_glb(performance: Performance, path: Path) -> None:
    """Write GLB. Raises `InputError` for a character that has pictures instead of a mesh."""
    from lipdb.characters.gltf_write import write_glb as write

    mesh = performance.character.mesh
    if mesh is None:
        raise InputError(f"character {performance.character.name!r} has pictures and no mesh; write .tsv or .mp4 instead of .glb")
    write(path, mesh, animation=performance.shapes)
