"""Flat mouths: one picture a shape, SVG or PNG, laid over the wall.

SVG is drawn by resvg through `resvg-py`: one self-contained wheel under the MIT licence, no system library, the same bytes
for the same picture. (cairosvg needs the system's cairo; skia-python needs the system's OpenGL and fontconfig.)
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipdb.characters.pictures import LARGEST_FILE
from lipdb.characters.svg import check_svg
from lipdb.errors import MeshError
from lipdb.render.scene import background, encode

MARGIN = 0.06
"""Free room at each side of the picture, as a part of it."""


class Pictures:
    """Draws the pictures of *files* (shape to SVG or PNG) at *size* (width, height); each is read when it is first shown."""

    def __init__(self, files: Mapping[str, Path], *, size: tuple[int, int] = (512, 512)) -> None:
        self._files, self._size = files, size
        self._wall = encode(background(*size))
        self._drawn: dict[str, NDArray[np.uint8]] = {}

    def draw(self, shape: str) -> NDArray[np.uint8]:
        """The picture of *shape*, ``(height, width, 3)`` sRGB; the wall alone when there is none of this name.

        Raises `MeshError` for a file that is missing or is not a picture.
        """
        if shape not in self._drawn:
            self._drawn[shape] = self._over_wall(self._files[shape]) if shape in self._files else self._wall
        return self._drawn[shape]

    def _over_wall(self, file: Path) -> NDArray[np.uint8]:
        from PIL import Image

        width, height = (round(side * (1 - 2 * MARGIN)) for side in self._size)
        picture = read_picture(file, width, height)
        wall = Image.fromarray(self._wall).convert("RGBA")
        corner = ((self._size[0] - picture.shape[1]) // 2, (self._size[1] - picture.shape[0]) // 2)
        wall.alpha_composite(Image.fromarray(picture), corner)
        return np.asarray(wall.convert("RGB"))


def read_picture(file: Path, width: int, height: int) -> NDArray[np.uint8]:
    """The picture in *file* as RGBA, as large as fits into *width* x *height* without being distorted.

    Raises `MeshError` for a file that is missing, too large, or no picture, and for an SVG that is more than one.
    """
    from PIL import Image

    try:
        data = file.read_bytes() if file.stat().st_size <= LARGEST_FILE else b""
    except OSError as error:
        raise MeshError(f"{file}: can't be read ({error.strerror}); give an SVG or PNG for each shape") from error
    if file.suffix.lower() == ".svg":
        data = _svg_to_png(file, data, width)
    try:
        with Image.open(io.BytesIO(data), formats=["PNG"]) as opened:
            scale = min(width / opened.width, height / opened.height)
            fitted = (max(round(opened.width * scale), 1), max(round(opened.height * scale), 1))
            image = opened.convert("RGBA")
            return np.asarray(image if image.size == fitted else image.resize(fitted, Image.Resampling.LANCZOS))
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        raise MeshError(f"{file}: not a PNG or SVG picture of at most {LARGEST_FILE >> 20} MiB; draw it again") from error


def _svg_to_png(file: Path, data: bytes, width: int) -> bytes:
    import resvg_py

    check_svg(data, file)
    try:
        return bytes(resvg_py.svg_to_bytes(svg_string=data.decode("utf-8"), width=width, skip_system_fonts=True))
    except (ValueError, UnicodeDecodeError) as error:
        raise MeshError(f"{file}: not an SVG ({error}); save it again as plain SVG") from error
