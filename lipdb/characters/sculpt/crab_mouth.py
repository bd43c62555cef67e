"""The crab's two rows of pegs for teeth, and its tongue."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lipdb.characters.mesh import Floats, Ints, Part
from lipdb.characters.sculpt.fields import mix, smoothstep, srgb, tint
from lipdb.characters.sculpt.grids import ball, joined, outward, through, tube

PEG, TONGUE = srgb("#f7e9c6"), srgb("#cb5f70")
TONGUE_REST = [(-0.36, 0.20), (-0.31, 0.34), (-0.285, 0.46), (-0.290, 0.56), (-0.310, 0.64)]
TONGUE_SHAPES = {
    "tongue_up": [(-0.36, 0.20), (-0.32, 0.34), (-0.27, 0.46), (-0.16, 0.56), (-0.05, 0.62)],
    "tongue_teeth": [(-0.34, 0.26), (-0.26, 0.44), (-0.225, 0.58), (-0.215, 0.70), (-0.225, 0.83)],
    "tongue_back": [(-0.34, 0.10), (-0.16, 0.22), (-0.10, 0.32), (-0.24, 0.42), (-0.33, 0.48)],
}
HIDDEN_UPPER, HIDDEN_LOWER = np.array([0.0, 0.07, -0.06]), np.array([0.0, -0.07, -0.06])


def crab_teeth() -> list[Part]:
    """The upper row and the lower one, which drops when the mouth opens."""
    upper = _pegs("teeth_upper", -0.155, 1, np.linspace(-0.29, 0.29, 9))
    lower = _pegs("teeth_lower", -0.265, -1, np.linspace(-0.255, 0.255, 8))
    above, below = np.ones((len(upper.positions), 1)), np.ones((len(lower.positions), 1))
    moves = {"mouth_oo": below * HIDDEN_LOWER, "mouth_open": below * np.array([0, -0.255, -0.05])}
    return [replace(upper, shapes={"mouth_oo": above * HIDDEN_UPPER}), replace(lower, shapes=moves)]


def _pegs(name: str, height: float, side: int, places: Floats) -> Part:
    """A row of pointed pegs; *side* is 1 when the points look down."""
    unit, faces, _ = ball(np.linspace(0, np.pi, 8)[1:-1], 10)
    unit = unit[:, [0, 2, 1]]
    faces = outward(unit, faces, unit)
    slim = 1 - 0.65 * np.clip(-side * unit[:, 1], 0, 1)
    pieces = []
    for x in places:
        size = 1 - 0.25 * abs(x) / 0.3
        peg = np.stack([unit[:, 0] * 0.040 * slim, unit[:, 1] * 0.068 * size, unit[:, 2] * 0.032], axis=-1)
        pieces.append((peg + np.array([x, height, 0.665 - 0.50 * x * x]), faces))
    positions, all_faces = joined(pieces)
    shade = np.tile(mix(0.70, 1.0, smoothstep(0.6, -0.4, side * unit[:, 1])), len(places))
    return Part(name, positions, all_faces, PEG * shade[:, None], 0.3, 0.5)


def crab_tongue(rows: int = 20, columns: int = 16) -> Part:
    """The tongue, a tube along a line in the middle plane."""
    rest, faces, along = _tongue(TONGUE_REST, rows, columns)
    shapes = {name: _tongue(line, rows, columns)[0] - rest for name, line in TONGUE_SHAPES.items()}
    shapes["mouth_open"] = np.stack([0 * along, -0.14 - 0.09 * along, 0 * along], axis=-1)
    shapes["mouth_oo"] = np.ones((len(rest), 1)) * np.array([0.0, -0.06, -0.10])
    return Part("tongue", rest, faces, tint(srgb("#6e2433"), TONGUE, smoothstep(0.05, 0.7, along)), 0.3, 0.5, shapes)


def _tongue(line: list[tuple[float, float]], rows: int, columns: int) -> tuple[Floats, Ints, Floats]:
    """Positions, faces and place along it of a tongue whose middle is *line*, given as (y, z) from root to tip."""
    u = np.linspace(0, 1, rows)
    path = np.concatenate([np.zeros((rows, 1)), through([*line], rows)], axis=1)
    radius = 0.002 + 0.093 * np.sqrt(np.clip(1 - ((u - 0.45) / 0.55) ** 2, 0, 1))
    positions, faces, along = tube(path, radius, columns)
    wide = positions.copy()
    wide[:, 0] *= 1.6
    return wide, faces, along
