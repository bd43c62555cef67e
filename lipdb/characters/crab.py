"""The crab that comes with lipdb: a face with shapes of its own and no jaw."""

from __future__ import annotations

from functools import cache

from lipdb.characters.mesh import Mesh
from lipdb.characters.mouth import LEFT, LOWER, RIGHT, UPPER
from lipdb.characters.sculpt.crab_body import shell
from lipdb.characters.sculpt.crab_eyes import crab_eyes
from lipdb.characters.sculpt.crab_limbs import crab_limbs
from lipdb.characters.sculpt.crab_mouth import crab_teeth, crab_tongue


@cache
def crab() -> Mesh:
    """Build the crab: the same numbers every time."""
    body, mouth = shell()
    places = {UPPER: "upper", LOWER: "lower", RIGHT: "right", LEFT: "left"}
    landmarks = {name: (0, mouth.lip_vertex(place)) for name, place in places.items()}
    parts = [body, *crab_eyes(), *crab_teeth(), crab_tongue(), *crab_limbs()]
    return Mesh("crab", tuple(part.rounded() for part in parts), landmarks)
