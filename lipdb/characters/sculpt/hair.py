"""Robin's hair: a cap from the crown to a clean hairline, combed to one side."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.body import HAIR
from lipdb.characters.sculpt.fields import bump, mix, raycast, smoothstep
from lipdb.characters.sculpt.grids import fan_faces, grid_faces, outward
from lipdb.characters.sculpt.head import form

CROWN = np.array([0.0, 0.25, -0.10])
# The hairline: degrees around the head from the front, and radians down from the crown.
LINE = (
    (0, 1.02), (18, 1.03), (34, 1.07), (48, 1.17), (58, 1.40), (66, 1.70), (74, 1.84), (80, 1.66), (88, 1.46), (100, 1.46),
    (112, 1.80), (126, 2.22), (150, 2.44), (180, 2.48),
)  # fmt: skip


def hair(rows: int = 18, columns: int = 84) -> Part:
    """The cap, thick on top and with a swept lock over the forehead."""
    around = np.linspace(-np.pi, np.pi, columns, endpoint=False)
    degrees, line = np.array(LINE).T
    edge = np.interp(np.abs(np.degrees(around)), degrees, line)
    edge += 0.07 * np.exp(-(((around + 0.42) / 0.30) ** 2)) - 0.04 * np.exp(-(((around - 0.45) / 0.2) ** 2))
    edge = 0.25 * np.roll(edge, 1) + 0.5 * edge + 0.25 * np.roll(edge, -1)
    down, a = np.meshgrid(np.append(np.linspace(0.04, 0.96, rows - 2) ** 0.9, [1.0, 0.985]), around, indexing="ij")
    polar = down * edge
    rays = np.stack([np.sin(polar) * np.sin(a), np.cos(polar), np.sin(polar) * np.cos(a)], axis=-1).reshape(-1, 3)
    strand = _strands(down, a)
    thick = _thickness(down, a) + 0.017 * strand * smoothstep(0.02, 0.25, down) * smoothstep(1.0, 0.9, down)
    thick[-1] = -0.03  # the last ring turns in, so that the edge is a wall and not a crossing of surfaces
    positions = CROWN + (raycast(form, CROWN, rays) + thick.ravel())[:, None] * rays
    top = CROWN + np.array([0, raycast(form, CROWN, np.array([[0.0, 1.0, 0.0]]))[0] + float(thick[0].mean()), 0])
    positions = np.concatenate([positions, [top]])
    faces = np.concatenate([grid_faces(rows, columns), fan_faces(len(positions) - 1, np.arange(columns))[:, ::-1]])
    shade = (1 + 0.28 * strand) * mix(1, 0.75, smoothstep(0.55, 1.0, down)) * mix(1, 0.6, (down > 0.97) & (thick < 0))
    colours = HAIR * np.append(shade.ravel(), 1.0)[:, None]
    return Part("hair", positions, outward(positions, faces, positions - CROWN), np.clip(colours, 0, 1), 0.5, 0.35)


def _strands(down: Floats, around: Floats) -> Floats:
    """Waves -1 to 1 across the locks, which fall to one side."""
    swept = around + 0.55 * down * np.exp(-((around / 1.2) ** 2))
    return 0.6 * np.sin(swept * 15 + 1.2 * np.sin(down * 5)) + 0.4 * np.sin(swept * 26 + 4 * down + 1)


def _thickness(down: Floats, around: Floats) -> Floats:
    """How far the hair stands off the head."""
    full = mix(0.10, 0.055, smoothstep(0.6, 1.0, down)) - 0.025 * smoothstep(1.9, 2.6, np.abs(around)) * smoothstep(0.6, 1, down)
    lock = 0.10 * bump(down - 0.76, 0.19) * np.exp(-(((around + 0.25) / 0.65) ** 2))
    return full + lock - 0.03 * smoothstep(0.94, 1.0, down)
