"""Movements of lips that both heads and shells use, as displacements of the vertices of a `MouthSurface`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.characters.mesh import Floats
from lipdb.characters.sculpt.fields import smoothstep
from lipdb.characters.sculpt.slit import MouthSurface


@dataclass(frozen=True, slots=True, eq=False)
class LipMasks:
    """How much of a movement each vertex makes, 0 to 1.

    *lips* the lips and what is next to them, *around* a wider ring, *edge* where the lips meet and the red of them,
    *rim* and *seam* closer and closer to where they meet; *upper*, *lower* and *corner* tell the parts of the mouth.
    """

    lips: Floats
    around: Floats
    edge: Floats
    rim: Floats
    seam: Floats
    upper: Floats
    lower: Floats
    corner: Floats

    @classmethod
    def of(cls, mouth: MouthSurface) -> LipMasks:
        """The masks of one mouth; inside of it movements fade towards the throat."""
        fade = 1 - 0.8 * smoothstep(0.1, 0.6, mouth.depth)
        soon = 1 - smoothstep(0.2, 0.7, mouth.depth)
        lips, around, edge, rim, seam = (np.exp(-((mouth.mu / width) ** 2)) for width in (0.62, 1.0, 0.30, 0.22, 0.14))
        upper, lower = np.clip(mouth.sine, 0, 1) ** 0.7, np.clip(-mouth.sine, 0, 1) ** 0.7
        return cls(lips * fade, around * fade, edge * soon, rim * soon, seam * soon, upper, lower, np.abs(mouth.cosine) ** 3)


def vectors(x: Floats | float, y: Floats | float, z: Floats | float, count: int) -> Floats:
    """Displacements ``(count, 3)`` from their three components."""
    return np.stack([np.broadcast_to(np.asarray(part, float), (count,)) for part in (x, y, z)], axis=-1)


def pursed(mouth: MouthSurface, *, hole: tuple[float, float], rim: tuple[float, float], lift: float) -> Floats:
    """Displacements that lay the lips round a hole: half axes (x, y) of the hole and of the red's border.

    *lift* moves the hole's middle up. Beyond the lips the skin follows less and less. The bag keeps its own height
    behind the lips: each of its points moves as much as the point of the lips in front of it.
    """
    x = mouth.positions[:, 0]
    ring = np.clip(mouth.lip, 0, 4)
    target_x = (hole[0] + (rim[0] - hole[0]) * ring) * mouth.cosine
    target_y = mouth.positions[mouth.lip_vertex("upper"), 1] + lift + (hole[1] + (rim[1] - hole[1]) * ring) * mouth.sine
    follow = 1 - smoothstep(1.0, 4.2, mouth.lip)
    behind = 1 - smoothstep(0.35, 0.8, mouth.depth)
    line = mouth.line
    rings = mouth.bag_size // mouth.columns
    from_x, from_y = (np.concatenate([np.tile(line[:, k], rings), mouth.positions[mouth.bag_size :, k]]) for k in (0, 1))
    shrink = 0.2 * x * np.exp(-(mouth.mu**2)) * (1 - follow)
    return vectors((target_x - from_x) * follow * behind - shrink, (target_y - from_y) * follow * behind, 0, len(x))


def tucked(mouth: MouthSurface, *, edge: float, front: tuple[float, float, float]) -> Floats:
    """Displacements that lay the lower lip's rim on the upper teeth: height *edge*, and *front* = (x and z radius, z) of their arch."""
    points = mouth.positions
    line = mouth.line
    along = np.clip(line[:, 0] / front[0], -0.98, 0.98)
    inner = 1 - smoothstep(0.55, 0.95, np.abs(along))
    move_y = (edge - line[:, 1]) * inner
    move_z = np.minimum(front[2] + front[1] * np.sqrt(1 - along**2) - line[:, 2], 0) * inner
    turns = (len(points) - 2) // mouth.columns
    falloff = np.exp(-((mouth.mu / 0.36) ** 2)) * np.clip(-mouth.sine, 0, 1) ** 0.35 * (1 - smoothstep(0.25, 0.7, mouth.depth))
    column_y, column_z = (np.append(np.tile(move, turns), [0.0, 0.0]) for move in (move_y, move_z))
    return vectors(0, column_y * falloff, column_z * falloff, len(points))
