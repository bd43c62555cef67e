"""Signed distances and soft masks: the clay that heads and shells are made of.

Distances are negative inside. Points have shape ``(..., 3)``. The smooth union is Quilez's polynomial minimum
(https://iquilezles.org/articles/smin/).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from lipdb.characters.mesh import Floats

Distance = Callable[[Floats], Floats]
Point = Sequence[float] | Floats


def smoothstep(start: float, end: float, x: Floats | float) -> Floats:
    """0 before *start*, 1 after *end*, smooth between; *end* may be smaller than *start*."""
    t = np.clip((np.asarray(x, float) - start) / (end - start), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


def bump(distance: Floats | float, width: Floats | float) -> Floats:
    """A bell of height 1 at distance 0."""
    return np.asarray(np.exp(-0.5 * (np.asarray(distance) / width) ** 2))


def near(points: Floats, centre: Point, spread: Point) -> Floats:
    """A bell of height 1 at *centre*, *spread* wide along each axis; both sides of x at once when *centre* is off it."""
    sides = [np.asarray(centre)] if centre[0] == 0 else [np.asarray(centre), np.asarray(centre) * np.array([-1, 1, 1])]
    return np.asarray(sum(np.exp(-0.5 * (((points - side) / np.asarray(spread)) ** 2).sum(-1)) for side in sides))


def mix(a: Floats | float, b: Floats | float, t: Floats | float) -> Floats:
    """*a* where *t* is 0, *b* where it is 1."""
    a = np.asarray(a, float)
    return np.asarray(a + (b - a) * t)


def tint(colours: Floats, colour: Floats, amount: Floats) -> Floats:
    """*colours* ``(n, 3)`` or one colour, painted over with *colour*, *amount* ``(n,)`` of it at each point."""
    return mix(colours, colour, np.asarray(amount)[..., None])


def srgb(code: str) -> Floats:
    """A colour written ``#rrggbb`` as three numbers 0..1."""
    return np.array([int(code[i : i + 2], 16) for i in (1, 3, 5)]) / 255


def mirrored(points: Floats) -> Floats:
    """*points* with x made positive, so that one primitive stands on both sides."""
    return np.concatenate([np.abs(points[..., :1]), points[..., 1:]], axis=-1)


def union(a: Floats, b: Floats, softness: float) -> Floats:
    """Both bodies, melted together over *softness*."""
    h = np.clip(0.5 + 0.5 * (b - a) / softness, 0, 1)
    return np.asarray(b + (a - b) * h - softness * h * (1 - h))


def cut(a: Floats, b: Floats, softness: float) -> Floats:
    """Body *a* with *b* taken out of it."""
    return -union(-a, b, softness)


def sphere(points: Floats, centre: Point, radius: float) -> Floats:
    """Distance to a sphere."""
    return np.asarray(np.linalg.norm(points - np.asarray(centre), axis=-1) - radius)


def ellipsoid(points: Floats, centre: Point, radii: Point) -> Floats:
    """Distance to an ellipsoid, to first order (exact on its surface)."""
    scaled = (points - np.asarray(centre)) / np.asarray(radii)
    k0 = np.linalg.norm(scaled, axis=-1)
    k1 = np.linalg.norm(scaled / np.asarray(radii), axis=-1)
    return np.asarray(k0 * (k0 - 1) / np.maximum(k1, 1e-9))


def raycast(distance: Distance, origin: Point, directions: Floats, *, begin: float = 1.8, steps: int = 26) -> Floats:
    """How far along unit *directions* from *origin* the body's surface lies.

    The march starts *begin* away: outside of the body it finds the outermost surface, inside of it the nearest way out.
    """
    start = np.asarray(origin, float)
    t = np.full(len(directions), begin)
    for _ in range(steps):
        t = np.maximum(t - 0.85 * distance(start + t[:, None] * directions), 0.02)
    return t


def gradient(distance: Distance, points: Floats, step: float = 2e-3) -> Floats:
    """Unit normals of the body at *points*."""
    slopes = [distance(points + offset) - distance(points - offset) for offset in step * np.eye(3)]
    slope = np.stack(slopes, axis=-1)
    return np.asarray(slope / np.maximum(np.linalg.norm(slope, axis=-1, keepdims=True), 1e-9))


def openness(distance: Distance, points: Floats, normals: Floats) -> Floats:
    """How much open air there is over each point, 0..1: a cheap ambient occlusion (Evans 2006)."""
    hidden, total = np.zeros(len(points)), 0.0
    for height, weight in ((0.03, 1.0), (0.07, 0.75), (0.13, 0.56), (0.22, 0.42)):
        hidden += weight * np.clip(height - distance(points + normals * height), 0, None) / height
        total += weight
    return np.clip(1 - hidden / total, 0, 1)
