"""The crab's shell with its mouth, and the shapes of both."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.fields import bump, ellipsoid, gradient, mirrored, mix, near, openness, smoothstep, sphere, srgb, tint, union
from lipdb.characters.sculpt.lips import LipMasks, pursed, vectors
from lipdb.characters.sculpt.slit import Bag, MouthSurface, Slit, with_bag

SHELL, BELLY, DARK, LIP, INSIDE = srgb("#dc512c"), srgb("#f4bd74"), srgb("#7c2417"), srgb("#b8403f"), srgb("#5a1420")
ORIGIN, MOUTH, HALF_WIDTH = np.array([0.0, -0.02, 0.0]), np.array([0.0, -0.20, 0.80]), 0.42
LIP_HEIGHT = 0.085
BUMPS = ((0.0, 0.50), (0.35, 0.45), (0.65, 0.30), (0.2, 0.60), (0.5, 0.47))
SPOTS = (
    (0.12, 0.50, 0.45, 0.07),
    (0.42, 0.40, 0.52, 0.09),
    (0.68, 0.30, 0.40, 0.06),
    (0.30, 0.58, 0.25, 0.06),
    (0.62, 0.48, 0.10, 0.08),
    (0.86, 0.20, 0.30, 0.05),
)
BAG = Bag(
    depth=(0.01, 0.03, 0.055, 0.085, 0.12, 0.17, 0.24, 0.33, 0.43, 0.52),
    height=(0.0, 0.0, 0.004, 0.03, 0.08, 0.125, 0.15, 0.15, 0.11, 0.06),
    width=(1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.97, 0.9, 0.75, 0.5),
)


def form(points: Floats) -> Floats:
    """Distance to the shell."""
    both = mirrored(points)
    body = ellipsoid(points, (0, 0, 0), (1.12, 0.62, 0.78))
    body = union(body, ellipsoid(points, (0, 0.22, -0.1), (0.80, 0.46, 0.60)), 0.25)
    body = union(body, ellipsoid(points, (0, -0.16, 0.50), (0.62, 0.34, 0.30)), 0.20)
    body = union(body, ellipsoid(both, (0.92, 0.02, 0.18), (0.20, 0.16, 0.24)), 0.12)
    for x, y in BUMPS:
        body = union(body, sphere(both, (x, y, 0.36 - 0.25 * x), 0.075), 0.07)
    return body


def shell(rows: int = 60, columns: int = 92) -> tuple[Part, MouthSurface]:
    """The body with all its shapes, and its mouth's grid."""
    slit = Slit(ORIGIN, MOUTH - ORIGIN, HALF_WIDTH, rows, columns)
    bare = slit.wrap(form)
    normals = gradient(form, bare)
    lip = slit.mu / np.arcsinh(LIP_HEIGHT / HALF_WIDTH)
    taper = np.abs(np.sin(slit.theta)) ** 0.5
    roll = np.where(lip < 1, np.sin(np.pi * np.clip(lip, 0, 1) ** 0.7), 0)
    surface = bare + (taper * roll * 0.038)[:, None] * normals
    surface[:, 2] -= 0.024 * np.exp(-((lip / 0.3) ** 2))
    mouth = with_bag(slit, surface, lip, BAG, (0, -0.20, 0.74))
    inside = tint(INSIDE, srgb("#16040a"), smoothstep(0.1, 0.7, mouth.depth[: mouth.bag_size]))
    colours = np.concatenate([inside, _colours(bare, normals, lip, taper), [srgb("#16040a"), SHELL]])
    return Part("body", mouth.positions, mouth.faces, colours, 0.38, 0.7, _shapes(mouth)), mouth


def _colours(bare: Floats, normals: Floats, lip: Floats, taper: Floats) -> Floats:
    colours = tint(SHELL, BELLY, smoothstep(0.02, -0.30, bare[:, 1]))
    spots = np.max([near(bare, (x, y, z), (size, size, size)) for x, y, z, size in SPOTS], axis=0)
    colours = tint(colours, srgb("#f39a55"), smoothstep(0.35, 0.75, spots) * 0.8)
    colours = tint(colours, DARK, bump(lip - 1.15, 0.25) * taper * 0.30)
    colours = tint(colours, LIP, smoothstep(1.12, 0.88, lip) * mix(0.75, 0.85, taper))
    colours = tint(colours, INSIDE, np.exp(-((lip / 0.50) ** 2)) * 0.30)
    colours = tint(colours, INSIDE, np.exp(-((lip / 0.22) ** 2)) * 0.6)
    return np.asarray(colours * mix(0.50, 1, openness(form, bare, normals))[:, None])


def _shapes(mouth: MouthSurface) -> dict[str, Floats]:
    """The crab's own shapes: it has no jaw, its lips do everything."""
    n, m = len(mouth.positions), LipMasks.of(mouth)
    x, _, z = mouth.positions.T
    sine = np.abs(mouth.sine)
    outside = np.where(mouth.depth > 0, 1 - 0.5 * smoothstep(0.3, 1.0, mouth.depth), 1)
    drop = np.where(mouth.sine < 0, 0.3 + 0.7 * sine**0.8, 0.3 * (1 - sine**0.6)) * np.exp(-((mouth.mu / 1.1) ** 2)) * outside
    corners = near(mouth.positions, (0.40, -0.18, 0.72), (0.15, 0.15, 0.4)) * (z > 0.2) * (1 - 0.7 * smoothstep(0.05, 0.6, mouth.depth))
    side = np.tanh(x / 0.08)
    forward, rolled = vectors(0, 0, m.lips, n), -0.080 * m.seam - 0.010 * m.edge
    return {
        "mouth_open": vectors(-0.08 * x * m.lips, -0.30 * drop + 0.08 * m.upper * m.lips, -0.04 * drop, n),
        "mouth_oo": pursed(mouth, hole=(0.085, 0.048), rim=(0.175, 0.155), lift=0.0) + 0.13 * forward,
        "bare_teeth": vectors(0.03 * x * m.lips, (0.060 * m.upper - 0.075 * m.lower) * m.lips, 0.03 * m.lips * (1 - m.corner), n),
        "lips_press": vectors(0, (-0.043 * m.upper + 0.056 * m.lower) * m.edge, rolled * (1 - 0.4 * m.corner), n),
        "smile": vectors(0.06 * side * corners, 0.14 * corners - 0.03 * m.lips * (1 - m.corner), -0.03 * corners, n),
        "frown": vectors(-0.01 * side * corners, -0.13 * corners + 0.03 * m.lips * (1 - m.corner), 0, n),
    }
