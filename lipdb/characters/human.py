"""Robin, the human head that comes with lipdb."""

from __future__ import annotations

from functools import cache

from lipdb.characters.mesh import Mesh, Part
from lipdb.characters.mouth import LEFT, LOWER, RIGHT, UPPER
from lipdb.characters.sculpt.body import brows, ears, neck, shirt
from lipdb.characters.sculpt.eyes import eyeballs, lids, under_patches
from lipdb.characters.sculpt.fields import smoothstep
from lipdb.characters.sculpt.hair import hair
from lipdb.characters.sculpt.head import HeadSurface, head_surface
from lipdb.characters.sculpt.head_shapes import mouth_shapes, skin_shapes
from lipdb.characters.sculpt.teeth import teeth, tongue


@cache
def robin() -> Mesh:
    """Build the head: the same numbers every time."""
    surface = head_surface()
    places = {UPPER: "upper", LOWER: "lower", RIGHT: "right", LEFT: "left"}
    landmarks = {name: (0, surface.mouth.lip(place)) for name, place in places.items()}
    parts = [_head(surface), *lids(), *eyeballs(), *brows(), *ears(), *teeth(), tongue(), hair(), neck(), shirt()]
    return Mesh("robin", tuple(part.rounded() for part in parts), landmarks)


def _head(surface: HeadSurface) -> Part:
    mouth = surface.mouth
    fade = 1 - 0.75 * smoothstep(0.1, 0.6, mouth.depth)
    shapes = {**mouth_shapes(surface), **skin_shapes(mouth.positions, fade)}
    positions, faces = under_patches(mouth.positions, mouth.faces)
    return Part("head", positions, faces, surface.colours, 0.55, 0.35, shapes)
