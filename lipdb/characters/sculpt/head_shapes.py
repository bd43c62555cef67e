"""How Robin's head moves: every shape as displacements of the vertices of `HeadSurface`."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats
from lipdb.characters.sculpt.fields import mix, near, smoothstep
from lipdb.characters.sculpt.head import HeadSurface
from lipdb.characters.sculpt.slit import MouthSurface

HINGE = np.array([0.0, -0.20, 0.05])
JAW_ANGLE = 0.36  # radians, at open = 1
FV_JAW = 0.05  # of the teeth and the tongue: it makes room for the lower lip


def vectors(x: Floats | float, y: Floats | float, z: Floats | float, count: int) -> Floats:
    """Displacements ``(count, 3)`` from their three components."""
    return np.stack([np.broadcast_to(np.asarray(part, float), (count,)) for part in (x, y, z)], axis=-1)


def jaw(points: Floats, weight: Floats | float, angle: float) -> Floats:
    """Displacements of a jaw that turns by *angle* (radians, down) about the hinge, *weight* of it at each point."""
    c, s = np.cos(angle), np.sin(angle)
    q = points - HINGE
    turned = np.stack([q[:, 0], c * q[:, 1] - s * q[:, 2], s * q[:, 1] + c * q[:, 2]], axis=-1)
    return np.asarray((turned - q) * np.broadcast_to(np.asarray(weight, float), (len(points),))[:, None])


def jaw_weight(mouth: MouthSurface) -> Floats:
    """How much of the jaw's turn each vertex makes: lower lip and chin all, corners some, upper lip none."""
    _, y, z = mouth.positions.T
    corner, sine = 0.40, np.abs(mouth.sine)
    lips = np.where(mouth.sine < 0, corner + (1 - corner) * sine**0.85, corner * (1 - sine**0.55))
    far = smoothstep(0.45, 1.55, mouth.mu)
    chin = smoothstep(-0.22, -0.56, y) * smoothstep(-0.25, 0.35, z)
    surface = mix(lips, chin, far)
    inside = np.where(mouth.sine < 0, 0.85 * sine**0.3, 0.0)
    return mix(surface, mix(inside, 0.4, smoothstep(0.7, 1, mouth.depth)), smoothstep(0.15, 0.5, mouth.depth)) * (
        1 - 0.999 * smoothstep(2.2, 2.7, mouth.mu)
    )


def pursed(head: HeadSurface, *, hole: tuple[float, float], rim: tuple[float, float], lift: float) -> Floats:
    """Displacements that lay the lips round a hole: half axes (x, y) of the hole and of the red's border.

    *lift* moves the hole's middle up. Beyond the lips the skin follows less and less.
    """
    mouth, points = head.mouth, head.mouth.positions
    middle = points[mouth.lip("upper"), 1] + lift
    ring = np.clip(head.lip, 0, 4)
    target_x = (hole[0] + (rim[0] - hole[0]) * ring) * mouth.cosine
    target_y = middle + (hole[1] + (rim[1] - hole[1]) * ring) * mouth.sine
    follow = 1 - smoothstep(1.0, 4.2, head.lip)
    behind = 1 - smoothstep(0.35, 0.8, mouth.depth)
    x, y, _ = points.T
    shrink = np.exp(-((mouth.mu / 1.0) ** 2)) * (1 - follow)
    in_bag = mouth.depth > 0
    # The bag keeps its own height behind the lips: it moves as much as the point of the lips in front of it.
    line = points[mouth.bag_size : mouth.bag_size + mouth.columns]
    rings = mouth.bag_size // mouth.columns
    from_y = np.concatenate([np.tile(line[:, 1], rings), y[mouth.bag_size :]])
    from_x = np.where(in_bag, np.concatenate([np.tile(line[:, 0], rings), x[mouth.bag_size :]]), x)
    move_x = (target_x - from_x) * follow * behind - 0.2 * x * shrink
    return vectors(move_x, (target_y - from_y) * follow * behind, 0, len(points))


def tucked(head: HeadSurface, *, edge: float, front: tuple[float, float, float]) -> Floats:
    """Displacements that lay the lower lip's rim on the upper teeth: height *edge*, and *front* = (x and z radius, z) of their arch."""
    mouth, points = head.mouth, head.mouth.positions
    line = points[mouth.bag_size : mouth.bag_size + mouth.columns]
    along = np.clip(line[:, 0] / front[0], -0.98, 0.98)
    inner = 1 - smoothstep(0.55, 0.95, np.abs(along))
    move_y = (edge - line[:, 1]) * inner
    move_z = np.minimum(front[2] + front[1] * np.sqrt(1 - along**2) - line[:, 2], 0) * inner
    turns = (len(points) - 2) // mouth.columns
    falloff = np.exp(-((mouth.mu / 0.36) ** 2)) * np.clip(-mouth.sine, 0, 1) ** 0.35 * (1 - smoothstep(0.25, 0.7, mouth.depth))
    column_y, column_z = (np.append(np.tile(move, turns), [0.0, 0.0]) for move in (move_y, move_z))
    return vectors(0, column_y * falloff, column_z * falloff, len(points))


def mouth_shapes(head: HeadSurface) -> dict[str, Floats]:
    """Displacements of the shapes that speech needs."""
    mouth = head.mouth
    n, points, depth = len(mouth.positions), mouth.positions, mouth.depth
    x = points[:, 0]
    fade = 1 - 0.8 * smoothstep(0.1, 0.6, depth)
    lips, around = np.exp(-((mouth.mu / 0.62) ** 2)) * fade, np.exp(-((mouth.mu / 1.0) ** 2)) * fade
    edge = np.exp(-((mouth.mu / 0.30) ** 2)) * (1 - smoothstep(0.2, 0.7, depth))
    rim = np.exp(-((mouth.mu / 0.20) ** 2)) * (1 - smoothstep(0.2, 0.7, depth))
    upper, lower = np.clip(mouth.sine, 0, 1) ** 0.7, np.clip(-mouth.sine, 0, 1) ** 0.7
    corner = np.abs(mouth.cosine) ** 3
    forward = vectors(0, 0, lips, n)
    pressed_y, pressed_z = (-0.034 * upper + 0.046 * lower) * edge, -0.050 * rim - 0.012 * edge
    stretched_y = (0.014 * upper - 0.014 * lower) * lips * (1 - corner)
    return {
        "open": jaw(points, jaw_weight(mouth), JAW_ANGLE) + vectors(-0.10 * x * lips, 0.018 * lips * upper, 0, n),
        "W": pursed(head, hole=(0.055, 0.020), rim=(0.125, 0.098), lift=0.004) + 0.150 * forward + vectors(0, 0, 0.03 * around, n),
        "ShCh": pursed(head, hole=(0.135, 0.042), rim=(0.190, 0.120), lift=0.006) + 0.085 * forward,
        "PBM": vectors(0.02 * x * lips, pressed_y, pressed_z * (1 - 0.4 * corner), n),
        "FV": vectors(0.02 * x * lips, 0.040 * upper * lips, 0, n) + tucked(head, edge=-0.436, front=(0.262, 0.292, 0.508)),
        "wide": vectors(0.22 * x * lips + 0.07 * x * (around - lips), stretched_y, -0.055 * lips * corner - 0.020 * lips, n),
    }


def skin_shapes(points: Floats, fade: Floats) -> dict[str, Floats]:
    """Displacements of the shapes of the whole face, for skin and for what sits on it; *fade* of them at each point.

    They depend on the place alone, so that head, lids and brows move together.
    """
    n, side, front = len(points), np.sign(points[:, 0]), (points[:, 2] > 0.2) * fade
    corner = near(points, (0.29, -0.42, 0.72), (0.15, 0.15, 0.3)) * front
    cheek = near(points, (0.40, -0.17, 0.66), (0.13, 0.13, 0.3)) * front
    brow = near(points, (0.30, 0.43, 0.70), (0.21, 0.12, 0.4)) * front
    middle = np.exp(-0.5 * (points[:, 0] / 0.2) ** 2)
    squint = near(points, (0.31, -0.06, 0.80), (0.15, 0.07, 0.3)) * front
    lip = near(points, (0, -0.43, 0.86), (0.14, 0.12, 0.2)) * front
    return {
        "smile": vectors(
            side * 0.060 * corner, 0.070 * corner + 0.045 * cheek - 0.006 * lip + 0.012 * squint, 0.035 * cheek - 0.035 * corner, n
        ),
        "frown": vectors(-side * 0.010 * corner, -0.075 * corner + 0.020 * lip, -0.005 * corner, n),
        "brow_up": vectors(0, 0.085 * brow, 0.005 * brow, n),
        "brow_down": vectors(-side * 0.025 * brow * middle, -0.055 * brow * (0.5 + 0.5 * middle) - 0.01 * brow, 0.020 * brow * middle, n),
        "blink": vectors(0, 0.010 * squint, 0.004 * squint, n),
    }
