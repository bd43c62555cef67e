"""Robin, the human head that comes with lipdb."""

from __future__ import annotations

from functools import cache

from lipdb.characters.mesh import Mesh, Part
from lipdb.characters.mouth import LEFT, LOWER, RIGHT, UPPER
from lipdb.characters.sculpt.head import head_surface
from lipdb.characters.sculpt.head_shapes import mouth_shapes
from lipdb.characters.sculpt.teeth import teeth, tongue


@cache
def robin() -> Mesh:
    """Build the head: the same numbers every time."""
    head = head_surface()
    mouth = head.mouth
    shapes = mouth_shapes(head)
    parts = [Part("head", mouth.positions, mouth.faces, head.colours, 0.55, 0.35, shapes), *teeth(), tongue()]
    landmarks = {
        UPPER: (0, mouth.lip("upper")),
        LOWER: (0, mouth.lip("lower")),
        RIGHT: (0, mouth.lip("right")),
        LEFT: (0, mouth.lip("left")),
    }
    return Mesh("robin", tuple(part.rounded() for part in parts), landmarks)
