"""Draw a mesh at given weights of its shapes, with whatever this machine has."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError, MeshError
from lipdb.render.gl import backend
from lipdb.render.gl_painter import GLPainter
from lipdb.render.morph import Morph
from lipdb.render.raster import NumpyPainter
from lipdb.render.scene import Floats, camera_for, shade

if TYPE_CHECKING:
    from lipdb.characters.mesh import Mesh

LARGEST = 4096


class Painter(Protocol):
    """What turns vertices into pictures."""

    def paint(self, positions: Floats, light: Floats) -> NDArray[np.uint8]:
        """The picture of vertices that send this light, ``(height, width, 3)`` sRGB."""
        ...

    def close(self) -> None:
        """Give back what it holds."""
        ...


class Renderer:
    """Pictures of *mesh*, *size* (width, height) pixels, seen from *view* (``front``, ``three-quarter``, ``side``).

    *painter* is ``numpy``, or else whatever `lipdb.render.gl.backend` finds. Close it, or use it in a ``with`` block.
    Raises `MeshError` for a mesh without triangles, `InputError` for a size or view that can't be.
    """

    def __init__(self, mesh: Mesh, *, size: tuple[int, int] = (512, 512), view: str = "front", painter: str = "") -> None:
        width, height = size
        if not (0 < width <= LARGEST and 0 < height <= LARGEST):
            raise InputError(f"picture size {width}x{height}: each side must be 1 to {LARGEST} pixels")
        if not any(len(part.faces) for part in mesh.parts):
            raise MeshError(f"mesh {mesh.name!r} has no triangles to draw; export it with its faces")
        self._morph = Morph(mesh)
        self._camera = camera_for(self._morph.positions, self._morph.moving, view=view, aspect=width / height)
        self._light = shade(self._morph.colours, self._morph.normals, self._morph.positions, self._morph.finish, self._camera)
        kind = NumpyPainter if (painter or backend()) == "numpy" else GLPainter
        self._painter: Painter = kind(self._morph, self._light, self._camera, width, height)

    def draw(self, weights: Mapping[str, float]) -> NDArray[np.uint8]:
        """The picture with each shape at its weight, ``(height, width, 3)`` sRGB; shapes the mesh lacks move nothing."""
        morph, rows = self._morph, self._morph.changing
        positions, normals = morph.at(weights)
        light = self._light.copy()
        light[rows] = shade(morph.colours[rows], normals[rows], positions[rows], morph.finish[rows], self._camera)
        return self._painter.paint(positions, light)

    def close(self) -> None:
        """Give back what the painter holds."""
        self._painter.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()
