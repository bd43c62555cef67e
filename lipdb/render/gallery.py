"""Every pose of a character at full weight, as pictures."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.characters.exercise import held
from lipdb.progress import steps

if TYPE_CHECKING:
    from lipdb.characters.character import Character

SIDE = 240


def pose_gallery(character: Character, poses: Sequence[str], *, side: int = SIDE) -> dict[str, bytes]:
    """PNG of each of *poses* at weight 1, with the others at rest, seen from three quarters; of pictures the one that shows.

    Raises `MeshError` when there is nothing to draw.
    """
    from PIL import Image

    drawn = {}
    for pose, picture in zip(poses, _pictures(character, poses, side), strict=True):
        file = io.BytesIO()
        Image.fromarray(picture).save(file, "PNG")
        drawn[pose] = file.getvalue()
    return drawn


def _pictures(character: Character, poses: Sequence[str], side: int) -> list[NDArray[np.uint8]]:
    tracks = [character.shapes(held(poses, {pose: 1.0}, seconds=0)) for pose in poses]
    weights = [dict(zip(track.poses, map(float, track.weights[0]), strict=True)) for track in tracks]
    if character.mesh is None:
        from lipdb.render.flat import Pictures

        pictures = Pictures(character.pictures, size=(side, side))
        return [pictures.draw(max(shapes, key=shapes.__getitem__, default="")) for shapes in weights]
    from lipdb.render.renderer import Renderer

    with Renderer(character.mesh, size=(side, side), view="three-quarter") as renderer:
        return [renderer.draw(shapes) for shapes in steps(weights, total=len(weights), what="Drawing poses")]
