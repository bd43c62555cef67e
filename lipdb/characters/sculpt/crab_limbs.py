"""The crab's claws, which rise and sink with its brows, and its legs, which stand still."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.crab_body import BELLY, DARK, SHELL
from lipdb.characters.sculpt.eyes import mirror
from lipdb.characters.sculpt.fields import smoothstep, tint
from lipdb.characters.sculpt.grids import ball, outward, through, tube


def crab_limbs() -> list[Part]:
    """Arms, claws and six legs."""
    claw = _finger("claw_left", (0.40, 0.20, 0.32), 0.16, 0.30, 1.40)
    thumb = _finger("thumb_left", (0.34, 0.10, 0.22), -0.16, -0.55, 1.66)
    left = [_arm(), claw, thumb, *(_leg(i) for i in range(3))]
    return left + [mirror(part, part.name.replace("left", "right")) for part in left]


def _arm(rows: int = 13, columns: int = 14) -> Part:
    path = through([(0.95, -0.05, 0.2), (1.35, -0.20, 0.45), (1.50, 0.15, 0.62)], rows)
    radius = np.interp(np.linspace(0, 1, rows), [0, 0.5, 1], [0.13, 0.10, 0.12])
    positions, faces, along = tube(path, radius, columns)
    return Part("arm_left", positions, faces, tint(SHELL, DARK, np.full(len(along), 0.15)), 0.4, 0.6, _gesture(along))


def _gesture(share: Floats) -> dict[str, Floats]:
    """How far a claw goes along with the brows, *share* of it at each point."""
    up = np.stack([0.03 * share, 0.09 * share, 0 * share], axis=-1)
    return {"brow_up": up, "brow_down": -0.8 * up}


def _finger(name: str, size: tuple[float, float, float], bend: float, turn: float, x: float) -> Part:
    """One half of a claw: *size* is (height of its middle, width, length), *turn* its lean in radians."""
    height, width, length = size
    unit, faces, _ = ball(np.linspace(0, np.pi, 14)[1:-1], 16)
    unit = unit[:, [0, 2, 1]]
    slim = 1 - 0.6 * np.clip(unit[:, 1], 0, 1) ** 1.2
    across = unit[:, 0] * width * slim - bend * np.clip(unit[:, 1], 0, 1) ** 2
    upwards = unit[:, 1] * length
    c, s = np.cos(turn), np.sin(turn)
    sideways, upright, deep = c * across + s * upwards, c * upwards - s * across, unit[:, 2] * 0.15 * slim
    positions = np.stack([x - sideways, height + upright, 0.64 + deep], axis=-1)
    faces = outward(positions, faces, positions - positions.mean(0))
    return Part(name, positions, faces, tint(SHELL, BELLY, smoothstep(0.3, 1, unit[:, 1]) * 0.8), 0.35, 0.7, _gesture(np.ones(len(unit))))


def _leg(number: int, rows: int = 13, columns: int = 9) -> Part:
    start = (0.9, -0.18, -0.05 - 0.22 * number)
    knee = (1.38 - 0.08 * number, 0.05 - 0.06 * number, -0.15 - 0.25 * number)
    foot = (1.62 - 0.10 * number, -0.85, -0.05 - 0.25 * number)
    radius = np.interp(np.linspace(0, 1, rows), [0, 0.5, 1], [0.085, 0.07, 0.014])
    positions, faces, along = tube(through([start, knee, foot], rows), radius, columns)
    return Part(f"leg{number}_left", positions, faces, tint(SHELL, DARK, along * 0.7), 0.4, 0.6)
