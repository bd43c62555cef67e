"""Robin's brows, ears, neck and shirt."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.eyes import mirror
from lipdb.characters.sculpt.fields import bump, gradient, mix, raycast, smoothstep, srgb, tint
from lipdb.characters.sculpt.grids import ball, grid_faces, outward, through
from lipdb.characters.sculpt.head import ORIGIN, SKIN, form
from lipdb.characters.sculpt.head_shapes import skin_shapes

HAIR = srgb("#5a3826")
# The shirt's outline, turned about the neck: distance and height, from inside of the collar to the shoulders.
COLLAR = (
    (0.37, -1.17), (0.405, -1.12), (0.455, -1.085), (0.50, -1.11), (0.51, -1.17), (0.55, -1.23),
    (0.72, -1.30), (0.95, -1.40), (1.15, -1.56), (1.24, -1.80), (1.27, -2.2),
)  # fmt: skip


def brows(rows: int = 18, columns: int = 8) -> list[Part]:
    """Two soft strips on the brow's skin; they move as the skin below them does."""
    line = through([(0.125, 0.395, 0.8), (0.22, 0.430, 0.8), (0.34, 0.428, 0.7), (0.455, 0.365, 0.55)], rows)
    rays = (line - ORIGIN) / np.linalg.norm(line - ORIGIN, axis=1, keepdims=True)
    middle = ORIGIN + raycast(form, ORIGIN, rays)[:, None] * rays
    normal = gradient(form, middle)
    along = np.gradient(middle, axis=0)
    across = np.cross(along / np.linalg.norm(along, axis=1, keepdims=True), normal)
    t = np.linspace(0, 1, rows)
    radius = 0.034 * np.sqrt(1 - (2 * t - 1) ** 6) * (1 - 0.55 * t) + 0.001
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    ring = across[:, None] * np.cos(around)[None, :, None] + 0.5 * normal[:, None] * np.sin(around)[None, :, None]
    positions = (middle[:, None] + normal[:, None] * 0.004 + radius[:, None, None] * ring).reshape(-1, 3)
    faces = outward(positions, grid_faces(rows, columns), ring.reshape(-1, 3))
    shapes = {name: moved for name, moved in skin_shapes(positions, np.ones(len(positions))).items() if name.startswith("brow")}
    right = Part("brow_left", positions, faces, np.tile(HAIR * 0.85, (len(positions), 1)), 0.85, 0.1, shapes)
    return [right, mirror(right, "brow_right")]


def ears() -> list[Part]:
    """Two ears: flat shells with a rim and a hollow."""
    unit, faces, _ = ball(np.linspace(0, np.pi, 18)[1:-1], 20)
    unit = unit[:, [2, 0, 1]]  # poles sideways
    faces = outward(unit, faces, unit)
    rim = np.hypot(unit[:, 1], unit[:, 2])
    outside = smoothstep(0, 0.5, unit[:, 0])
    hollow = outside * smoothstep(0.80, 0.55, rim)
    ridges = 0.026 * bump(rim - 0.84, 0.07) + 0.014 * bump(rim - 0.55, 0.06) * (unit[:, 2] < 0.35)
    x = unit[:, 0] * 0.050 - 0.050 * hollow + outside * ridges
    y = unit[:, 1] * 0.175 * (1 + 0.10 * unit[:, 1])
    z = unit[:, 2] * 0.110 * (1 + 0.25 * unit[:, 1])
    c, s = np.cos(0.45), np.sin(0.45)
    positions = np.stack([c * x - s * z, y, s * x + c * z], axis=-1) + np.array([0.735, 0.0, -0.06])
    colours = tint(tint(SKIN, srgb("#cf7566"), np.full(len(x), 0.30)), srgb("#9c5145"), hollow * 0.55)
    left = Part("ear_left", positions, faces, colours, 0.55, 0.3)
    return [left, mirror(left, "ear_right")]


def neck(rows: int = 9, columns: int = 30) -> Part:
    """A neck that begins well inside of the head, so that no view finds a gap."""
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    t, g = np.meshgrid(np.linspace(0, 1, rows), around, indexing="ij")
    top, bottom = mix(-0.30, -0.80, smoothstep(0.45, 0.95, np.sin(g))), -1.55
    radius = 0.385 + 0.05 * smoothstep(0.55, 1, t) + 0.03 * smoothstep(0.3, 0.0, t)
    y = mix(top, bottom, t)
    lean = -0.14 + 0.10 * smoothstep(-1.2, -0.5, y)
    positions = np.stack([radius * np.cos(g), y, 0.92 * radius * np.sin(g) + lean], axis=-1).reshape(-1, 3)
    faces = outward(positions, grid_faces(rows, columns), positions * np.array([1, 0, 1]))
    shade = mix(1, 0.66, smoothstep(-1.20, -0.80, positions[:, 1]) * smoothstep(-0.3, 0.25, positions[:, 2]))
    return Part("neck", positions, faces, SKIN * 0.95 * shade[:, None], 0.6, 0.25)


def shirt(rows: int = 19, columns: int = 32) -> Part:
    """Collar and shoulders."""
    outline = np.array(COLLAR)
    place = np.linspace(0, len(outline) - 1, rows)
    radius, height = (np.interp(place, np.arange(len(outline)), outline[:, k]) for k in (0, 1))
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    r, g = np.meshgrid(radius, around, indexing="ij")
    x = r * np.cos(g) * mix(1.0, 1.25, smoothstep(0.55, 1.0, r))
    z = r * np.sin(g) * mix(0.95, 0.58, smoothstep(0.52, 1.1, r)) - 0.12
    positions = np.stack([x, height[:, None] - 0.07 * np.sin(g), z], axis=-1).reshape(-1, 3)
    faces = grid_faces(rows, columns)
    faces = outward(positions, faces, np.tile([0.0, 1.0, 0.0], (len(positions), 1)))
    part = Part("shirt", positions, faces, np.tile(srgb("#3d6b7d"), (len(positions), 1)), 0.9, 0.05)
    return replace(part, colours=_folds(part))


def _folds(part: Part) -> Floats:
    """The shirt's colour, darker inside of the collar and under it."""
    radius = np.hypot(part.positions[:, 0], part.positions[:, 2] + 0.12)
    dark = np.maximum(smoothstep(0.42, 0.37, radius), 0.5 * bump(radius - 0.52, 0.03))
    return part.colours * mix(1, 0.55, dark)[:, None]
