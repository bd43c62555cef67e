"""The crab's eyes on stalks, with lids that close over the balls."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.crab_body import BELLY, SHELL
from lipdb.characters.sculpt.eyes import mirror
from lipdb.characters.sculpt.fields import mix, smoothstep, srgb, tint
from lipdb.characters.sculpt.grids import ball, grid_faces, outward, through, tube

BASE, TIP, RADIUS = np.array([0.30, 0.42, 0.40]), np.array([0.42, 0.98, 0.62]), 0.205
BALL = TIP + np.array([0.0, 0.06, 0.03])
SPREAD = np.pi / 2  # how far round the ball the lids reach, radians
IRIS = srgb("#3f9a63")


def _lift(share: Floats) -> Floats:
    """How the stalk rises with the brows, *share* 0 at its foot and 1 at the ball."""
    return np.stack([0.03 * share, 0.16 * share, -0.02 * share], axis=-1)


def _sink(share: Floats) -> Floats:
    return np.stack([-0.06 * share, -0.12 * share, 0.06 * share], axis=-1)


def crab_eyes() -> list[Part]:
    """Stalks, balls and lids of both sides."""
    left = [_stalk(), _ball(), _lid("eyelid_upper_left", 0.60, 3.16, -0.16, 1.085), _lid("eyelid_lower_left", -0.72, -3.16, -0.08, 1.065)]
    return left + [mirror(part, part.name.replace("left", "right")) for part in left]


def _stalk(rows: int = 13, columns: int = 16) -> Part:
    path = through([BASE, mix(BASE, TIP, 0.5) + np.array([-0.03, 0, 0.03]), TIP], rows)
    radius = np.interp(np.linspace(0, 1, rows), [0, 0.3, 1], [0.105, 0.065, 0.085])
    positions, faces, along = tube(path, radius, columns)
    shapes = {"brow_up": _lift(along), "brow_down": _sink(along)}
    return Part("stalk_left", positions, faces, tint(SHELL, BELLY, along * 0.5), 0.4, 0.6, shapes)


def _ball(columns: int = 28) -> Part:
    rings = (0.12, 0.24, 0.265, 0.38, 0.50, 0.54, 0.575, 0.72, 0.95, 1.25, 1.65, 2.3)
    unit, faces, polar = ball(rings, columns)
    around = np.arctan2(unit[:, 1], unit[:, 0])
    fibres = 0.85 + 0.25 * np.sin(around * 9 + 2 * np.sin(around * 4))
    iris = IRIS * (fibres * mix(1.1, 0.6, smoothstep(0.35, 0.55, polar)))[:, None]
    colours = np.where((polar < 0.56)[:, None], iris, srgb("#f8f3e2"))
    colours = np.where((polar < 0.25)[:, None], 0.02, colours) * mix(1, 0.75, smoothstep(0.2, 0.7, unit[:, 1]))[:, None]
    positions = BALL + unit * RADIUS
    whole = np.ones(len(unit))
    return Part("eye_left", positions, faces, np.clip(colours, 0, 1), 0.1, 0.9, {"brow_up": _lift(whole), "brow_down": _sink(whole)})


def _lid(name: str, edge: float, far: float, shut: float, thick: float, rows: int = 9, columns: int = 26) -> Part:
    """One lid: a shell of the ball's shape from *edge* to *far* (radians over the middle); *shut* is its edge in a blink."""
    open_lid = _lid_points(edge, far, thick, rows, columns)
    whole = np.ones(len(open_lid))
    raised, lowered = (_lid_points(edge + turn, far, thick, rows, columns) - open_lid for turn in (0.18, -0.20))
    shapes = {
        "blink": _lid_points(shut, far, thick, rows, columns) - open_lid,
        "brow_up": raised + _lift(whole),
        "brow_down": lowered + _sink(whole),
    }
    rim = np.repeat(np.concatenate([[0.0], np.linspace(0, 1, rows)]), columns)
    colours = tint(SHELL, BELLY, np.full(len(whole), 0.22)) * mix(0.5, 1, smoothstep(0.0, 0.14, rim))[:, None]
    return Part(name, open_lid, outward(open_lid, grid_faces(rows + 1, columns, closed=False), open_lid - BALL), colours, 0.4, 0.6, shapes)


def _lid_points(edge: float, far: float, thick: float, rows: int, columns: int) -> Floats:
    sideways, k = np.meshgrid(np.linspace(-SPREAD, SPREAD, columns), np.linspace(0, 1, rows))
    almond = np.clip(np.cos(sideways / SPREAD * np.pi / 2), 0, 1) ** 0.5
    up = edge * almond + (far - edge * almond) * k
    radius = RADIUS * (thick + 0.02 * np.exp(-((k / 0.1) ** 2)))
    shell = np.stack([np.sin(sideways), np.cos(sideways) * np.sin(up), np.cos(sideways) * np.cos(up)], axis=-1)
    outer = BALL + radius[..., None] * shell
    inner = BALL + RADIUS * 0.985 * shell[:1]
    return np.concatenate([inner, outer]).reshape(-1, 3)
