"""Poses of a character at full weight, as pictures."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.characters.exercise import held
from lipdb.progress import steps

if TYPE_CHECKING:
    from lipdb.characters.character import Character

SIDE = 240
SEEN = 32
"""Pixels that must differ from the face at rest, each by as many steps of 256, for a pose to be seen."""

Mixtures = Mapping[str, Mapping[str, float]]
"""What is drawn: weights of poses, by a name for each picture."""


def pose_gallery(character: Character, mixtures: Mixtures, *, side: int = SIDE) -> dict[str, bytes]:
    """PNG of each of *mixtures*, poses that it does not name at rest, seen from three quarters; of pictures the one that shows.

    Raises `MeshError` when there is nothing to draw.
    """
    from PIL import Image

    drawn = {}
    for name, picture in zip(mixtures, _pictures(character, mixtures, side), strict=True):
        file = io.BytesIO()
        Image.fromarray(picture).save(file, "PNG")
        drawn[name] = file.getvalue()
    return drawn


def is_hidden(picture: bytes, rest: bytes) -> bool:
    """Whether the PNG *picture* can't be told from that of the face at *rest*, as a tongue's behind closed lips."""
    from PIL import Image

    if picture == rest:
        return True
    one, other = (np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16) for png in (picture, rest))
    return bool(np.count_nonzero(np.abs(one - other).max(axis=2) >= SEEN) < SEEN)


def _pictures(character: Character, mixtures: Mixtures, side: int) -> list[NDArray[np.uint8]]:
    poses = list(dict.fromkeys(pose for mixture in mixtures.values() for pose in mixture))
    tracks = [character.shapes(held(poses, mixture, seconds=0)) for mixture in mixtures.values()]
    weights = [dict(zip(track.poses, map(float, track.weights[0]), strict=True)) for track in tracks]
    if character.mesh is None:
        from lipdb.render.flat import Pictures

        pictures = Pictures(character.pictures, size=(side, side))
        return [pictures.draw(max(shapes, key=shapes.__getitem__, default="")) for shapes in weights]
    from lipdb.render.renderer import Renderer

    with Renderer(character.mesh, size=(side, side), view="three-quarter") as renderer:
        return [renderer.draw(shapes) for shapes in steps(weights, total=len(weights), what="Drawing poses")]
