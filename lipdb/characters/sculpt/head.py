"""Robin's head: its form as a distance field, its lips, its colours."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipdb.characters.mesh import Floats
from lipdb.characters.sculpt.fields import (
    bump,
    cut,
    ellipsoid,
    gradient,
    mirrored,
    mix,
    near,
    openness,
    smoothstep,
    sphere,
    srgb,
    tint,
    union,
)
from lipdb.characters.sculpt.slit import Bag, MouthSurface, Slit, with_bag

ORIGIN = np.array([0.0, -0.30, -0.02])
MOUTH = np.array([0.0, -0.432, 0.82])
EYE, EYE_RADIUS = np.array([0.312, 0.095, 0.655]), 0.205
LID_RADIUS = EYE_RADIUS * 1.09
HALF_WIDTH = 0.325
SKIN, LIP, INSIDE = srgb("#e9b89c"), srgb("#c4696a"), srgb("#7d3135")
LIP_UPPER, LIP_LOWER = 0.066, 0.086

BAG = Bag(
    depth=(0.008, 0.02, 0.036, 0.055, 0.08, 0.11, 0.15, 0.21, 0.29, 0.39, 0.50, 0.60),
    height=(0.0, 0.0, 0.003, 0.012, 0.045, 0.10, 0.15, 0.18, 0.19, 0.18, 0.14, 0.08),
    width=(1.0, 1.0, 1.0, 0.995, 0.99, 0.99, 1.0, 1.0, 0.98, 0.90, 0.75, 0.5),
)


def form(points: Floats) -> Floats:
    """Distance to the bare head, without lips, eyes, ears and hair."""
    both = mirrored(points)
    head = ellipsoid(points, (0, 0.30, -0.10), (0.76, 0.80, 0.90))
    head = union(head, ellipsoid(points, (0, -0.20, 0.20), (0.60, 0.64, 0.58)), 0.22)
    head = union(head, ellipsoid(points, (0, -0.60, 0.34), (0.40, 0.32, 0.42)), 0.20)  # jaw
    head = union(head, sphere(points, (0, -0.77, 0.62), 0.15), 0.18)  # chin
    head = union(head, ellipsoid(both, (0.38, -0.16, 0.50), (0.20, 0.20, 0.20)), 0.20)  # cheekbones
    head = union(head, ellipsoid(both, (0.30, -0.40, 0.48), (0.24, 0.22, 0.24)), 0.18)  # cheeks
    head = union(head, ellipsoid(points, (0, 0.36, 0.60), (0.46, 0.13, 0.18)), 0.18)  # brow
    head = union(head, ellipsoid(points, (0, -0.44, 0.66), (0.27, 0.20, 0.20)), 0.14)  # round of the teeth
    head = cut(head, sphere(both, (0.30, 0.165, 1.00), 0.19), 0.16)  # eye sockets
    head = union(head, sphere(both, EYE, LID_RADIUS), 0.12)  # lids
    return head - _nose(points)


def _nose(points: Floats) -> Floats:
    """How far the nose stands off the face: heights and no overhang, so that the grid of the head can follow it."""
    x, y = points[..., 0], points[..., 1]
    ridge = mix(0.020, 0.085, smoothstep(0.30, -0.08, y)) * smoothstep(0.44, 0.20, y) * smoothstep(-0.215, -0.130, y)
    ridge = ridge * bump(x, mix(0.038, 0.056, smoothstep(0.2, -0.1, y)))
    tip = 0.090 * bump(x, 0.060) * bump(y + 0.115, np.where(y > -0.115, 0.075, 0.046))
    wings = 0.050 * bump(np.abs(x) - 0.080, 0.030) * bump(y + 0.150, 0.036)
    philtrum = -0.012 * bump(x, 0.022) * bump(y + 0.285, 0.035)
    return np.asarray((ridge + tip + wings + philtrum) * smoothstep(0.3, 0.6, points[..., 2]))


@dataclass(frozen=True, slots=True, eq=False)
class HeadSurface:
    """The head's mesh and its colours."""

    mouth: MouthSurface
    colours: Floats


def head_surface(rows: int = 72, columns: int = 100) -> HeadSurface:
    """Robin's head, mouth closed."""
    slit = Slit(ORIGIN, MOUTH - ORIGIN, HALF_WIDTH, rows, columns)
    bare = slit.wrap(form)
    normals = gradient(form, bare)
    sine, mu = np.sin(slit.theta), slit.mu
    x = bare[:, 0]
    bow = 0.009 * bump(np.abs(x) - 0.075, 0.048) - 0.010 * bump(x, 0.048)
    border = np.arcsinh(mix(LIP_LOWER, LIP_UPPER + bow, smoothstep(-0.4, 0.4, sine)) / HALF_WIDTH)
    lip = mu / border
    surface = _lips(bare, normals, lip, np.abs(sine) ** 0.55, sine, mu)
    mouth = with_bag(slit, surface, lip, BAG, (0, -0.43, 0.80))
    colours = np.concatenate([np.tile(SKIN, (mouth.bag_size, 1)), _skin(bare, normals, lip, np.abs(sine) ** 0.55), [SKIN, SKIN]])
    inner = slice(0, mouth.bag_size)
    colours[inner] = tint(INSIDE, srgb("#2a0c0e"), smoothstep(0.15, 0.75, mouth.depth[inner]))
    colours[-2] = srgb("#1a0506")
    return HeadSurface(mouth, colours)


def _lips(bare: Floats, normals: Floats, lip: Floats, taper: Floats, sine: Floats, mu: Floats) -> Floats:
    """Raise the lips from the bare skin: a full roll each, an edge round the red, a groove where they meet."""
    roll = np.where(lip < 1, np.sin(np.pi * np.clip(lip, 0, 1) ** 0.75), 0)
    out = normals * 0.55 + np.array([0, 0, 0.45])
    height = taper * roll * np.where(sine >= 0, 0.040, 0.050)
    surface = bare + height[:, None] * out
    surface += (0.007 * bump(lip - 1.04, 0.09) * taper)[:, None] * normals
    surface -= (0.022 * near(bare, (0, -0.615, 0.75), (0.16, 0.045, 0.3)))[:, None] * normals  # fold above the chin
    corner = np.exp(-(((np.abs(bare[:, 0]) - 0.265) / 0.05) ** 2 + ((bare[:, 1] + 0.425) / 0.05) ** 2)) * (bare[:, 2] > 0)
    surface -= (0.020 * corner)[:, None] * normals
    groove = np.exp(-((lip / 0.30) ** 2))
    surface[:, 2] -= groove * (0.018 * taper + 0.012)
    surface[:, 1] += np.exp(-((mu / 0.55) ** 2)) * (0.008 - 0.010 * np.cos(np.pi * np.clip(bare[:, 0] / 0.28, -1, 1)))
    return np.asarray(surface)


def skin_colour(points: Floats, normals: Floats) -> Floats:
    """The colour of bare skin at *points*: redder on cheeks, nose and chin, darker where little light gets in."""
    red = 0.50 * near(points, (0.38, -0.20, 0.60), (0.15, 0.13, 0.2)) + 0.40 * near(points, (0, -0.13, 1.0), (0.1, 0.09, 0.1))
    red += 0.15 * near(points, (0, -0.80, 0.7), (0.13, 0.1, 0.2))
    colours = tint(SKIN, srgb("#dd7f6c"), np.clip(red, 0, 1) * 0.75)
    colours = tint(colours, srgb("#c48b78"), near(points, (0.30, 0.09, 0.80), (0.17, 0.13, 0.2)) * 0.20)
    light = openness(form, points, normals)[:, None]
    return np.asarray(colours * mix(1, light, 0.4) * mix(np.array([0.93, 0.80, 0.76]), np.ones(3), light))


def _skin(bare: Floats, normals: Floats, lip: Floats, taper: Floats) -> Floats:
    colours = skin_colour(bare, normals)
    colours = tint(colours, LIP, smoothstep(1.14, 0.90, lip) * smoothstep(-0.2, 0.15, taper) * 0.9)
    colours = tint(colours, INSIDE, np.exp(-((lip / 0.50) ** 2)) * taper * 0.32)
    colours = tint(colours, srgb("#7a3a33"), near(bare, (0.044, -0.180, 0.90), (0.018, 0.010, 0.05)) * 0.5)  # nostrils
    return tint(colours, INSIDE, np.exp(-((lip / 0.20) ** 2)) * taper * 0.7)
