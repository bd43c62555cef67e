"""How Robin's head moves: every shape as displacements of the vertices of a `MouthSurface`."""

from __future__ import annotations

import numpy as np

from lipdb.characters.mesh import Floats
from lipdb.characters.sculpt.fields import mix, near, smoothstep
from lipdb.characters.sculpt.lips import LipMasks, pursed, tucked, vectors
from lipdb.characters.sculpt.slit import MouthSurface

HINGE = np.array([0.0, -0.20, 0.05])
JAW_ANGLE = 0.36  # radians, at open = 1
FV_JAW = 0.05  # of the teeth and the tongue: it makes room for the lower lip


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
    bag = mix(inside, 0.4, smoothstep(0.7, 1, mouth.depth))
    return mix(surface, bag, smoothstep(0.15, 0.5, mouth.depth)) * smoothstep(2.7, 2.2, mouth.mu)


def mouth_shapes(mouth: MouthSurface) -> dict[str, Floats]:
    """Displacements of the shapes that speech needs."""
    n, points, m = len(mouth.positions), mouth.positions, LipMasks.of(mouth)
    x = points[:, 0]
    forward = vectors(0, 0, m.lips, n)
    pressed_y, pressed_z = (-0.037 * m.upper + 0.043 * m.lower) * m.rim, -0.085 * m.seam - 0.010 * m.edge
    stretched_x = 0.22 * x * m.lips + 0.07 * x * (m.around - m.lips)
    stretched_y = 0.014 * (m.upper - m.lower) * m.lips * (1 - m.corner)
    return {
        "open": jaw(points, jaw_weight(mouth), JAW_ANGLE) + vectors(-0.10 * x * m.lips, 0.018 * m.lips * m.upper, 0, n),
        "W": pursed(mouth, hole=(0.055, 0.020), rim=(0.125, 0.098), lift=0.004) + 0.150 * forward + vectors(0, 0, 0.03 * m.around, n),
        "ShCh": pursed(mouth, hole=(0.135, 0.042), rim=(0.190, 0.120), lift=0.006) + 0.085 * forward,
        "PBM": vectors(0.02 * x * m.lips, pressed_y, pressed_z * (1 - 0.4 * m.corner), n),
        "FV": vectors(0.02 * x * m.lips, 0.028 * m.upper * m.lips, -0.030 * m.upper * m.lips, n)
        + tucked(mouth, edge=-0.436, front=(0.262, 0.292, 0.508)),
        "wide": vectors(stretched_x, stretched_y, -0.055 * m.lips * m.corner - 0.020 * m.lips, n),
    }


def skin_shapes(points: Floats, fade: Floats) -> dict[str, Floats]:
    """Displacements of the shapes of the whole face, for skin and for what sits on it; *fade* of them at each point.

    They depend on the place alone, so that head, lids and brows move together.
    """
    n, side, front = len(points), np.tanh(points[:, 0] / 0.08), (points[:, 2] > 0.2) * fade
    corner = near(points, (0.29, -0.42, 0.72), (0.15, 0.15, 0.3)) * front
    cheek = near(points, (0.40, -0.17, 0.66), (0.13, 0.13, 0.3)) * front
    brow = near(points, (0.30, 0.43, 0.70), (0.21, 0.12, 0.4)) * front
    middle = np.exp(-0.5 * (points[:, 0] / 0.2) ** 2)
    squint = near(points, (0.31, -0.06, 0.80), (0.15, 0.07, 0.3)) * front
    lip = near(points, (0, -0.43, 0.86), (0.14, 0.12, 0.2)) * front
    raised = 0.070 * corner + 0.045 * cheek - 0.006 * lip + 0.012 * squint
    return {
        "smile": vectors(side * 0.060 * corner, raised, 0.035 * (cheek - corner), n),
        "frown": vectors(-side * 0.010 * corner, -0.075 * corner + 0.020 * lip, -0.005 * corner, n),
        "brow_up": vectors(0, 0.085 * brow, 0.005 * brow, n),
        "brow_down": vectors(-side * 0.025 * brow * middle, -0.055 * brow * (0.5 + 0.5 * middle) - 0.01 * brow, 0.020 * brow * middle, n),
        "blink": vectors(0, 0.010 * squint, 0.004 * squint, n),
    }
