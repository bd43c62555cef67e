"""Pictures of a bent mesh with numpy alone: the fall-back where there is no OpenGL, and the yardstick for it where there is.

A visibility buffer: every pixel keeps the nearest triangle (depth and fragment number in one 64-bit word, taken by an
unordered minimum), and only what is seen is shaded. What no shape moves is drawn once. The same input gives the same bytes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipdb.render.morph import Ints, Morph
from lipdb.render.scene import Camera, Floats, background, encode, to_screen

_NOTHING = np.uint64(0xFFFFFFFFFFFFFFFF)
_DEPTHS = np.float64(0xFFFFFF00)


class NumpyPainter:
    """Draws a mesh of *morph*; *samples* squared points a pixel are averaged."""

    def __init__(self, morph: Morph, light: Floats, camera: Camera, width: int, height: int, samples: int = 2) -> None:
        self._samples = samples
        self._width, self._height = width * samples, height * samples
        self._matrix = camera.projection(width / height).astype(np.float32)
        changes = np.zeros(len(morph.positions), bool)
        changes[morph.changing] = True
        moves = changes[morph.faces].any(axis=1)
        self._faces = morph.faces[moves]
        self._depth = np.full(self._width * self._height, _NOTHING)
        self._still = encode(background(self._width, self._height)).reshape(-1, 3)
        pixels, colours, self._depth = self._draw(morph.faces[~moves], morph.positions, light)
        self._still[pixels] = colours

    def paint(self, positions: Floats, light: Floats) -> NDArray[np.uint8]:
        """The picture of vertices that send this light, ``(height, width, 3)`` sRGB."""
        picture = self._still.copy()
        pixels, colours, _ = self._draw(self._faces, positions, light)
        picture[pixels] = colours
        return self._averaged(picture.reshape(self._height, self._width, 3))

    def _averaged(self, picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """One pixel for every square of samples."""
        n = self._samples
        total = np.zeros((self._height // n, self._width // n, 3), np.uint16)
        for row in range(n):
            for column in range(n):
                total += picture[row::n, column::n]
        return (total // (n * n)).astype(np.uint8)

    def close(self) -> None:
        """Nothing to give back; every painter has it."""

    def _draw(self, faces: Ints, positions: Floats, light: Floats) -> tuple[Ints, NDArray[np.uint8], NDArray[np.uint64]]:
        """Pixels where *faces* are nearer than what is there, their colours, and the depths with them drawn."""
        pixels, face, weights, depth = self._fragments(faces, self._project(positions))
        words = (depth << np.uint64(32)) | np.arange(len(pixels), dtype=np.uint64)
        nearest = self._depth.copy()
        np.minimum.at(nearest, pixels, words)
        seen = np.flatnonzero(nearest[pixels] == words)
        corners, share = light[faces[face[seen]]], weights[seen]
        # A fragment's number means nothing to the next drawing: keep the depth, and let equal depths stay.
        nearest[pixels[seen]] &= np.uint64(0xFFFFFFFF00000000)
        # Mixed affinely: with a long lens the error is far below a shade.
        return pixels[seen], encode(np.einsum("kc,kcd->kd", share, corners)), nearest

    def _project(self, positions: Floats) -> Floats:
        """Pixel x, pixel y (downwards) and depth 0..1, shape ``(n, 3)``."""
        unit = to_screen(positions, self._matrix)
        return np.column_stack([(unit[:, 0] + 1) / 2 * self._width, (1 - unit[:, 1]) / 2 * self._height, (unit[:, 2] + 1) / 2])

    def _fragments(self, faces: Ints, screen: Floats) -> tuple[Ints, Ints, Floats, NDArray[np.uint64]]:
        """Every pixel centre inside every front face: its pixel, face, the corners' shares ``(k, 3)``, and depth in 32 bits."""
        a, b, c = (screen[faces[:, k]] for k in range(3))
        area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
        low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
        left, right = _pixels(low[:, 0], high[:, 0], self._width)
        top, bottom = _pixels(low[:, 1], high[:, 1], self._height)
        front = np.flatnonzero((area < 0) & (right > left) & (bottom > top))
        wide = (right - left)[front]
        count = wide * (bottom - top)[front]
        owner = np.repeat(np.arange(len(front)), count)
        step = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
        down, across = np.divmod(step, wide[owner])
        across += left[front][owner]
        down += top[front][owner]
        a, b, c, area = a[front], b[front], c[front], area[front]
        x, y = across + np.float32(0.5), down + np.float32(0.5)
        first = _edge(b, c, area, owner, x, y)
        second = _edge(c, a, area, owner, x, y)
        inside = np.flatnonzero((first >= 0) & (second >= 0) & (first + second <= 1))
        share = np.column_stack([first[inside], second[inside], 1 - first[inside] - second[inside]])
        owner = owner[inside]
        depth = share[:, 0] * a[owner, 2] + share[:, 1] * b[owner, 2] + share[:, 2] * c[owner, 2]
        return down[inside] * self._width + across[inside], front[owner], share, (depth.clip(0, 1) * _DEPTHS).astype(np.uint64)


def _pixels(low: Floats, high: Floats, size: int) -> tuple[Ints, Ints]:
    """The first pixel whose centre is at *low* or after it, and the first whose centre is after *high*."""
    return np.clip(np.ceil(low - 0.5), 0, size).astype(np.intp), np.clip(np.floor(high - 0.5) + 1, 0, size).astype(np.intp)


def _edge(p: Floats, q: Floats, area: Floats, owner: Ints, x: Floats, y: Floats) -> Floats:
    """How far each pixel is from the edge *p* to *q* of its triangle, 1 at the corner across from it."""
    slope_x, slope_y = (p[:, 1] - q[:, 1]) / area, (q[:, 0] - p[:, 0]) / area
    away: Floats = slope_x[owner] * (x - p[owner, 0]) + slope_y[owner] * (y - p[owner, 1])
    return away
