"""Robin, the human head that comes with lipdb."""

from __future__ import annotations

from functools import cache

import numpy as np

from lipdb.characters.mesh import Floats, Mesh, Part
from lipdb.characters.mouth import LEFT, LOWER, RIGHT, UPPER
from lipdb.characters.sculpt.body import brows, ears, neck, shirt
from lipdb.characters.sculpt.eyes import WINDOW as EYE_WINDOW
from lipdb.characters.sculpt.eyes import behind_eye, eyeballs, lids
from lipdb.characters.sculpt.fields import smoothstep
from lipdb.characters.sculpt.hair import hair
from lipdb.characters.sculpt.head import HeadSurface, head_surface
from lipdb.characters.sculpt.head_shapes import mouth_shapes, skin_shapes
from lipdb.characters.sculpt.teeth import teeth, tongue
from lipdb.characters.sculpt.window import sink


@cache
def robin() -> Mesh:
    """Build the head: the same numbers every time."""
    surface = head_surface()
    places = {UPPER: "upper", LOWER: "lower", RIGHT: "right", LEFT: "left"}
    landmarks = {name: (0, surface.mouth.lip_vertex(place)) for name, place in places.items()}
    head, shapes = surface.mouth.positions, _shapes(surface)
    parts = [_head(surface, shapes), *lids(head, shapes), *eyeballs(), *brows(), *ears(), *teeth(), tongue(), hair(), neck(), shirt()]
    return Mesh("robin", tuple(part.rounded() for part in parts), landmarks)


def _shapes(surface: HeadSurface) -> dict[str, Floats]:
    mouth = surface.mouth
    fade = 1 - 0.75 * smoothstep(0.1, 0.6, mouth.depth)
    return {**mouth_shapes(mouth), **skin_shapes(mouth.positions, fade)}


def _head(surface: HeadSurface, shapes: dict[str, Floats]) -> Part:
    """The head without what the patches round the eyes cover."""
    positions, faces = surface.mouth.positions, surface.mouth.faces
    over = np.array([-1.0, 1.0, 1.0])
    for side in (1, -1):
        positions = positions * over if side < 0 else positions
        positions, faces = sink(EYE_WINDOW, positions, faces, behind=behind_eye(positions))
        positions = positions * over if side < 0 else positions
    return Part("head", positions, faces, surface.colours, 0.55, 0.35, shapes)
