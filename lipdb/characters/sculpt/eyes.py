"""Robin's eyes: the balls, and the skin around them with the lids.

The skin round an eye is a patch (see `window`): its rings run from the almond of the open eye outwards.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from lipdb.characters.mesh import Bools, Floats, Part
from lipdb.characters.sculpt.fields import bump, gradient, mix, smoothstep, srgb, tint
from lipdb.characters.sculpt.grids import ball, grid_faces, outward
from lipdb.characters.sculpt.head import EYE, EYE_RADIUS, form, skin_colour
from lipdb.characters.sculpt.head_shapes import skin_shapes
from lipdb.characters.sculpt.window import Window, carried

IRIS = srgb("#5f8a5a")
# Angles around the middle of the ball, in radians: sideways (outwards positive) and up.
ALMOND_MIDDLE, ALMOND_HALF = 0.04, 0.80
UPPER_LID, LOWER_LID, CLOSED, TILT = 0.47, -0.38, -0.20, 0.03
WINDOW = Window(form, EYE, EYE_RADIUS, middle=0.19, half=1.05, up=1.20, down=-1.00)
RINGS = (0.0, 0.05, 0.12, 0.21, 0.32, 0.45, 0.60, 0.78, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class _Rings:
    """Angles of the patch's points: *ring* 0 at the lids' edge and 1 at the border."""

    sideways: Floats
    up: Floats
    ring: Floats
    sine: Floats


def _rings(columns: int) -> _Rings:
    theta = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    ring, theta = (a.ravel() for a in np.meshgrid(RINGS, theta, indexing="ij"))
    cosine, sine = np.cos(theta), np.sin(theta)
    half = mix(ALMOND_HALF, WINDOW.half, ring)
    edge = np.where(sine >= 0, UPPER_LID, LOWER_LID) * np.abs(sine) ** 0.85
    border = np.where(sine >= 0, WINDOW.up, WINDOW.down) * np.abs(sine)
    up = mix(edge, border, ring) + TILT * cosine * (1 - 0.5 * ring)
    return _Rings(mix(ALMOND_MIDDLE, WINDOW.middle, ring) + half * cosine, up, ring, sine)


def behind_eye(points: Floats) -> Bools:
    """Which of the head's points lie behind the open eye on +x, or just beside it."""
    sideways, up = WINDOW.angles(points)
    return np.asarray(np.hypot((sideways - ALMOND_MIDDLE) / ALMOND_HALF, up / np.where(up >= 0, UPPER_LID, -LOWER_LID)) < 1.18)


def lids(head: Floats, head_shapes: Mapping[str, Floats], columns: int = 40) -> list[Part]:
    """The skin round both eyes, with the lids' edges turned in to the ball.

    The border moves as the *head* (positions, and displacements a shape) does, the lids' edges stay on the ball.
    """
    rings = _rings(columns)
    skin = WINDOW.surface(rings.sideways, rings.up)
    normals = gradient(form, skin)
    colours = skin_colour(skin, normals)
    crease = bump(rings.ring - 0.38, 0.055) * np.clip(rings.sine, 0, 1) ** 0.5
    skin += normals * (0.0025 + 0.004 * bump(rings.ring, 0.06) - 0.005 * crease)[:, None]
    blink = _blink(rings) + normals * 0.0025
    colours = _lid_colours(colours, rings, crease)
    edge = EYE + (skin[:columns] - EYE) * (0.985 / 1.09)
    positions = np.concatenate([edge, skin])
    loose = smoothstep(0.0, 0.6, np.concatenate([np.zeros(columns), rings.ring]))[:, None]
    shapes = {name: moved * loose for name, moved in carried(positions, head, head_shapes).items()}
    shapes.update(skin_shapes(positions, np.ones(len(positions))))
    shapes["blink"] = np.concatenate([EYE + (blink[:columns] - EYE) * (0.985 / 1.09), blink]) - positions
    colours = np.concatenate([tint(colours[:columns], srgb("#8d4a42"), np.full(columns, 0.45)), colours])
    faces = outward(positions, grid_faces(len(RINGS) + 1, columns), positions - EYE)
    right = Part("eyelids_left", positions, faces, colours, 0.55, 0.3, shapes)
    return [right, mirror(right, "eyelids_right")]


def _blink(rings: _Rings) -> Floats:
    """Where the patch's points lie when the lids are shut: the edge on one line, the border where it was."""
    line = CLOSED * np.abs(rings.sine) ** 0.85 + TILT * (rings.sideways - ALMOND_MIDDLE) / ALMOND_HALF
    shut = line + np.where(rings.sine >= 0, -0.012, 0.004) * np.abs(rings.sine)
    follow = (1 - rings.ring) ** 1.5
    return WINDOW.surface(rings.sideways, mix(rings.up, shut, follow))


def _lid_colours(colours: Floats, rings: _Rings, crease: Floats) -> Floats:
    """The skin's colours, with a shadow in the crease, lashes above and a moist rim below."""
    colours = colours * (1 - 0.20 * crease)[:, None]
    upper = smoothstep(-0.05, 0.15, rings.sine)
    colours = tint(colours, srgb("#35211c"), smoothstep(0.075, 0.03, rings.ring) * upper * 0.92)
    return tint(colours, srgb("#b5776a"), smoothstep(0.10, 0.0, rings.ring) * (1 - upper) * 0.6)


def eyeballs(columns: int = 28) -> list[Part]:
    """Both balls with iris and pupil; a row of points stands on each border between colours."""
    rings = (0.09, 0.185, 0.205, 0.30, 0.405, 0.445, 0.475, 0.58, 0.80, 1.10, 1.50, 2.2)
    positions, faces, polar = ball(rings, columns)
    around = np.arctan2(positions[:, 1], positions[:, 0])
    fibres = 0.5 + 0.5 * np.sin(around * 9 + 2 * np.sin(around * 4))
    iris = tint(IRIS * 0.75, np.clip(IRIS * 1.45, 0, 1), fibres * 0.5 + 0.5 * smoothstep(0.42, 0.22, polar))
    iris = tint(iris, IRIS * 0.35, smoothstep(0.38, 0.445, polar))
    white = tint(srgb("#f6f3ee"), srgb("#d9b0a4"), smoothstep(0.85, 1.4, polar) * 0.5)
    colours = np.where((polar < 0.46)[:, None], iris, white)
    colours = np.where((polar < 0.19)[:, None], 0.03, colours)
    colours = colours * mix(1, 0.70, smoothstep(0.12, 0.55, positions[:, 1]))[:, None]  # the upper lid's shadow
    places = EYE + positions * EYE_RADIUS * (1 + 0.03 * bump(polar, 0.30))[:, None]
    right = Part("eye_left", places, faces, colours, 0.12, 0.9)
    return [right, mirror(right, "eye_right")]


def mirror(part: Part, name: str) -> Part:
    """The same part on the other side of the face."""
    over = np.array([-1.0, 1.0, 1.0])
    shapes = {shape: moved * over for shape, moved in part.shapes.items()}
    return Part(name, part.positions * over, part.faces[:, ::-1], part.colours, part.roughness, part.specular, shapes)
