"""Where the camera stands, where the light comes from and how a surface answers it: one account for every painter.

Vertices are lit here, in numpy, and painters spread that light over triangles: with meshes fine enough to speak, pixel by
pixel looks the same and costs twice as much.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError

Floats = NDArray[np.float32]

FIELD_OF_VIEW = 0.42
"""Vertical, in radians: a long lens, so that noses stay small."""

VIEWS = {"front": 0.0, "three-quarter": 0.6, "side": 1.35}
"""How far the camera walks round the character, in radians."""

ROOM = 1.2
"""The picture shows the part of a mesh that its shapes move, times this much."""
MARGIN = 1.06

LIGHTS: tuple[tuple[tuple[float, float, float], tuple[float, float, float]], ...] = (
    ((-0.55, 0.60, 0.80), (0.80, 0.75, 0.68)),
    ((0.85, 0.12, 0.50), (0.24, 0.27, 0.32)),
    ((0.35, 0.60, -0.90), (0.42, 0.44, 0.50)),
)
"""Key, fill and rim light: direction towards the light in the camera's frame, and linear colour."""

SKY, GROUND = (0.36, 0.37, 0.41), (0.19, 0.18, 0.19)
BACKGROUND_TOP, BACKGROUND_BOTTOM = (0.60, 0.65, 0.74), (0.26, 0.31, 0.38)
SCATTER = (0.34, 0.15, 0.08)
"""How far light bleeds round the edge of a rough surface such as skin, by colour."""


@dataclass(frozen=True, slots=True, eq=False)
class Camera:
    """*pose* (4, 4) puts the camera into the world (it looks along its own -z); *near* and *far* bound what it sees."""

    pose: NDArray[np.float64]
    near: float
    far: float

    @property
    def eye(self) -> NDArray[np.float64]:
        """Where the camera stands, shape ``(3,)``."""
        return self.pose[:3, 3]

    def projection(self, aspect: float) -> NDArray[np.float64]:
        """World to clip space, shape ``(4, 4)``, as OpenGL has it."""
        scale = 1 / np.tan(FIELD_OF_VIEW / 2)
        depth = self.near - self.far
        clip = np.zeros((4, 4))
        clip[0, 0], clip[1, 1] = scale / aspect, scale
        clip[2, 2:] = (self.near + self.far) / depth, 2 * self.near * self.far / depth
        clip[3, 2] = -1
        return clip @ np.linalg.inv(self.pose)


def camera_for(positions: Floats, moving: NDArray[np.intp], *, view: str, aspect: float) -> Camera:
    """A camera that shows the moving part of a mesh with some room round it, and never more than the whole mesh.

    *positions* are ``(n, 3)``, y up and the face towards +z; *moving* indexes the vertices that any shape moves. Raises
    `InputError` for a view that is none of `VIEWS`.
    """
    if view not in VIEWS:
        raise InputError(f"view {view!r}: there is no such view; choose one of {', '.join(VIEWS)}")
    low, high = positions.min(0).astype(float), positions.max(0).astype(float)
    subject = positions[moving] if len(moving) else positions
    centre = (subject.min(0) + subject.max(0)).astype(float) / 2
    half = np.minimum((subject.max(0) - subject.min(0)).astype(float) / 2 * ROOM, (high - low) / 2)
    centre = np.clip(centre, low + half, np.maximum(high - half, low + half))
    half *= MARGIN
    yaw = VIEWS[view]
    back = np.array([np.sin(yaw), 0.0, np.cos(yaw)])
    right = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])
    width = abs(right[0]) * half[0] + abs(right[2]) * half[2]
    distance = max(half[1], width / aspect) / np.tan(FIELD_OF_VIEW / 2) + abs(back[0]) * half[0] + abs(back[2]) * half[2]
    pose = np.eye(4)
    pose[:3, 0], pose[:3, 1], pose[:3, 2], pose[:3, 3] = right, (0, 1, 0), back, centre + distance * back
    reach = float(np.linalg.norm(high - low)) + 1e-6
    return Camera(pose, max(distance - reach, distance * 0.02), distance + reach)


def light_directions(camera: Camera) -> NDArray[np.float64]:
    """Unit vectors towards each of `LIGHTS` in the world, shape ``(lights, 3)``: the studio turns with the camera."""
    directions = np.array([direction for direction, _ in LIGHTS])
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return directions @ camera.pose[:3, :3].T


def dot(vectors: Floats, others: Floats) -> Floats:
    """Dot products of *vectors* ``(n, 3)`` with *others*, ``(n, 3)`` or ``(3,)``.

    Not ``@``: numpy hands that to a threaded BLAS whose idle threads spin, which makes pictures four times slower on a
    busy machine.
    """
    product: Floats = vectors[:, 0] * others[..., 0] + vectors[:, 1] * others[..., 1] + vectors[:, 2] * others[..., 2]
    return product


def to_screen(points: Floats, matrix: Floats) -> Floats:
    """*points* ``(n, 3)`` through the camera's *matrix* ``(4, 4)``: x, y and depth, -1..1 inside the picture."""
    clip = np.stack([dot(points, row[:3]) + row[3] for row in matrix], axis=1)
    unit: Floats = clip[:, :3] / clip[:, 3:]
    return unit


def _colour(triple: tuple[float, float, float]) -> Floats:
    return np.array(triple, np.float32)


def shade(colours: Floats, normals: Floats, points: Floats, finish: Floats, camera: Camera) -> Floats:
    """The light that surface *points* send to the camera: linear, shape ``(n, 3)``.

    *colours* are linear ``(n, 3)``, *normals* ``(n, 3)`` of length one, *points* ``(n, 3)``; *finish* ``(n, 2)`` is how rough and
    how specular.
    Light bleeds round rough surfaces (wrapped diffuse); the highlight is a Blinn-Phong lobe (as a spherical
    Gaussian) with Schlick's Fresnel term; sky and ground light the rest.
    """
    roughness, specular = finish[:, 0], finish[:, 1]
    to_eye = camera.eye.astype(np.float32) - points
    to_eye /= np.linalg.norm(to_eye, axis=1, keepdims=True)
    facing = np.maximum(dot(normals, to_eye), 0)
    wrap = _colour(SCATTER) * np.clip(roughness * 2 - 0.5, 0, 1)[:, None]
    sky = (normals[:, 1:2] + 1) / 2
    light = _colour(GROUND) + (_colour(SKY) - _colour(GROUND)) * sky
    shine = (0.14 * specular * (1 - facing) ** 4)[:, None] * np.ones(3, np.float32)
    exponent = 2 / (roughness**4 + 2e-3)
    strength = (exponent + 8) / 25.13 * 1.7 * specular
    for direction, (_, colour) in zip(light_directions(camera).astype(np.float32), LIGHTS, strict=True):
        incidence = dot(normals, direction)
        light += _colour(colour) * np.maximum((incidence[:, None] + wrap) / (1 + wrap) ** 2, 0)
        half = direction + to_eye
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        fresnel = 0.04 + 0.96 * (1 - dot(half, direction)).clip(0) ** 5
        lobe = np.exp2(exponent * 1.442695 * (np.maximum(dot(normals, half), 0) - 1))
        shine += _colour(colour) * (fresnel * strength * lobe * np.clip(incidence * 4, 0, 1))[:, None]
    seen: Floats = colours * light + shine
    return seen


def encode(linear: Floats) -> NDArray[np.uint8]:
    """Linear light, any shape, to sRGB bytes, with highlights rolled off softly above one.

    The sRGB curve by square roots (Ian Taylor's fit, within a quarter of a shade of it).
    """
    a = np.sqrt(np.clip(linear * 1.10 / (1 + 0.18 * linear), 0, 1))
    b = np.sqrt(a)
    srgb = 0.662002687 * a + 0.684122060 * b - 0.323583601 * np.sqrt(b) - 0.0225411470 * a * a
    shades: NDArray[np.uint8] = (np.clip(srgb, 0, 1) * 255 + 0.5).astype(np.uint8)
    return shades


def background(width: int, height: int) -> Floats:
    """The wall behind the character: linear light, shape ``(height, width, 3)``, lighter towards the top."""
    down = ((np.arange(height, dtype=np.float32) + 0.5) / height)[:, None, None]
    column = _colour(BACKGROUND_TOP) * (1 - down) + _colour(BACKGROUND_BOTTOM) * down
    return np.broadcast_to(column, (height, width, 3)).astype(np.float32)
