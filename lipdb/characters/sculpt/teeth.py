"""Two rows of teeth in their gums, and the tongue."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lipdb.characters.mesh import Floats, Part
from lipdb.characters.sculpt.fields import mix, smoothstep, srgb, tint
from lipdb.characters.sculpt.grids import grid_faces, outward, through
from lipdb.characters.sculpt.head_shapes import FV_JAW, JAW_ANGLE, jaw

TOOTH, ROOT, GUM, TONGUE = srgb("#f6f1e4"), srgb("#e3cdb4"), srgb("#b5625f"), srgb("#cc6a6a")
UPPER_EDGE, LOWER_EDGE = -0.447, -0.440
UPPER_WIDTHS = (0.92, 0.74, 0.80, 0.75, 0.85, 1.0)
# Round lips hide the teeth; the rows give way a little, so that they do so at every angle.
HIDDEN_UPPER, HIDDEN_LOWER = np.array([0, 0.040, -0.05]), np.array([0, -0.035, -0.06])
LOWER_WIDTHS = (0.58, 0.62, 0.72, 0.76, 0.85, 1.0)
TONGUE_REST = [(-0.66, 0.16), (-0.53, 0.32), (-0.500, 0.46), (-0.505, 0.58), (-0.525, 0.68)]
TONGUE_SHAPES = {
    "tRoof": [(-0.64, 0.16), (-0.53, 0.30), (-0.50, 0.43), (-0.40, 0.56), (-0.275, 0.640)],
    "tTeeth": [(-0.62, 0.20), (-0.49, 0.38), (-0.455, 0.54), (-0.455, 0.68), (-0.462, 0.850)],
    "tBack": [(-0.62, 0.06), (-0.37, 0.18), (-0.325, 0.30), (-0.46, 0.42), (-0.565, 0.47)],
}


def teeth() -> list[Part]:
    """The upper row, and the lower one, which turns with the jaw."""
    upper = _row("teeth_upper", UPPER_WIDTHS, UPPER_EDGE, 1, (0.232, 0.262), 0.500)
    lower = _row("teeth_lower", LOWER_WIDTHS, LOWER_EDGE, -1, (0.215, 0.240), 0.500)
    away = np.ones((len(upper.positions), 1))
    raised = {"W": away * HIDDEN_UPPER}
    lowered = {"open": jaw(lower.positions, 1.0, JAW_ANGLE), "FV": jaw(lower.positions, 1.0, FV_JAW), "W": away * HIDDEN_LOWER}
    return [replace(upper, shapes=raised), replace(lower, shapes=lowered)]


def _row(name: str, half_widths: tuple[float, ...], edge: float, side: int, radii: tuple[float, float], back: float) -> Part:
    """One row along an elliptic arch; *side* is 1 when its roots point up. A profile of points runs round each tooth."""
    angle, across = _along(half_widths, spread=1.12)
    between = np.abs(across) > 0.99
    # How far out of the arch, how far from the biting edge, whether gum: from the gum inside over the edge to the gum outside.
    profile = np.array(
        [
            (-0.05, 0.16, 1),
            (-0.03, 0.10, 1),
            (-0.024, 0.02, 0),
            (-0.008, 0.0, 0),
            (0.012, 0.0, 0),
            (0.024, 0.022, 0),
            (0.028, 0.06, 0),
            (0.022, 0.098, 0),
            (0.030, 0.112, 1),
            (0.030, 0.150, 1),
            (0.0, 0.20, 1),
        ]
    )
    out, rise, gum = (profile[:, k][:, None] for k in range(3))
    corner = np.where(np.abs(across) > 0.7, 0.006, 0.0) + 0.010 * between
    rise = rise + np.where(rise < 0.03, corner, 0) - np.where((rise > 0.09) & (rise < 0.12), 0.018 * (np.abs(across) > 0.7), 0)
    out = out - np.where(gum == 0, 0.012 * between + 0.003 * (np.abs(across) > 0.7), 0)
    x, z = np.sin(angle), np.cos(angle)
    outwards = np.stack([x / radii[0], z / radii[1]])
    outwards /= np.linalg.norm(outwards, axis=0)
    place = np.stack([radii[0] * x + out * outwards[0], edge + side * rise, back + radii[1] * z + out * outwards[1]], axis=-1)
    positions = place.reshape(-1, 3)
    shade = mix(1.0, 0.45, smoothstep(0.25, 1.1, np.abs(angle)))
    ivory = tint(TOOTH, ROOT, smoothstep(0.05, 0.10, rise)) * np.where(between, 0.72, 1.0)[None, :, None]
    colours = np.where(gum[..., None] > 0, GUM, ivory) * shade[None, :, None] * np.where(out < 0, 0.6, 1.0)[..., None]
    faces = grid_faces(len(profile), len(angle), closed=False)
    centre = np.stack([radii[0] * x, np.full_like(x, edge + side * 0.1), back + radii[1] * z], axis=-1)
    return Part(
        name, positions, outward(positions, faces, positions - np.tile(centre, (len(profile), 1))), colours.reshape(-1, 3), 0.2, 0.5
    )


def _along(half_widths: tuple[float, ...], *, spread: float) -> tuple[Floats, Floats]:
    """Angles of the sample points along the arch, and where each stands on its tooth, -1 to 1."""
    widths = np.array([*half_widths[::-1], *half_widths])
    edges = -spread + 2 * spread * np.concatenate([[0], np.cumsum(widths / widths.sum())])
    local = np.array([-1.0, -0.75, -0.2, 0.2, 0.75])
    angle = (edges[:-1, None] + (edges[1:] - edges[:-1])[:, None] * (local + 1) / 2).ravel()
    return np.append(angle, spread), np.append(np.tile(local, len(widths)), 1.0)


def tongue(rows: int = 22, columns: int = 18) -> Part:
    """The tongue: a flat tube along a line in the middle plane, one line a shape."""
    rest = _tongue(TONGUE_REST, rows, columns)
    faces = outward(rest, grid_faces(rows, columns), rest - np.repeat(rest.reshape(rows, columns, 3).mean(1), columns, 0))
    along = np.repeat(np.linspace(0, 1, rows), columns)
    shapes = {name: _tongue(line, rows, columns) - rest for name, line in TONGUE_SHAPES.items()}
    shapes["open"], shapes["FV"] = (jaw(rest, 0.6 + 0.4 * along, angle) for angle in (JAW_ANGLE, FV_JAW))
    shapes["W"] = np.ones((len(rest), 1)) * HIDDEN_LOWER
    under = mix(1.0, 0.72, np.tile(np.linspace(0, 2 * np.pi, columns, endpoint=False) > np.pi, rows).astype(float))
    colours = tint(srgb("#5e2426"), TONGUE, smoothstep(0.05, 0.75, along)) * under[:, None]
    return Part("tongue", rest, faces, colours, 0.35, 0.4, shapes)


def _tongue(line: list[tuple[float, float]], rows: int, columns: int) -> Floats:
    """Points of a tongue along *line*, given as (y, z) from root to tip."""
    middle = through([*line], rows)
    u = np.linspace(0, 1, rows)
    tangent = np.gradient(middle, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    above = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
    swell = np.sqrt(np.clip(1 - ((u - 0.4) / 0.605) ** 2, 0.0004, 1))
    width, height = 0.155 * swell * (1 - 0.12 * u), 0.055 * swell * (1 - 0.35 * u)
    around = np.linspace(0, 2 * np.pi, columns, endpoint=False)
    up = height[:, None] * (np.sin(around) - 0.35 * np.exp(-((np.cos(around) / 0.25) ** 2)) * (np.sin(around) > 0))
    x = width[:, None] * np.cos(around)
    return np.stack([x, middle[:, :1] + above[:, :1] * up, middle[:, 1:] + above[:, 1:] * up], axis=-1).reshape(-1, 3)
