"""A contact sheet: the face in the middle of every phone, to see a whole line at a glance."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.render.film import stills
from lipdb.schedule import MICROSECONDS

if TYPE_CHECKING:
    from lipdb.performance import Performance

CELL = 240
COLUMNS = 6
LONGEST = 120
"""Pictures at most: a longer line shows its first phones."""


def write_png(performance: Performance, path: Path) -> None:
    """A picture a phone with its time and symbol; without a line, one every quarter of a second."""
    from PIL import Image

    moments = _moments(performance)
    pictures = stills(performance, np.array([time for time, _ in moments]), size=(CELL, CELL))
    named = [_labelled(picture, f"{time:.2f} s   {label}") for picture, (time, label) in zip(pictures, moments, strict=True)]
    Image.fromarray(_sheet(named)).save(path, format="PNG")


def _moments(performance: Performance) -> list[tuple[float, str]]:
    """When to draw, and what to write under it."""
    if performance.line is None:
        count = max(int(len(performance.track.weights) / performance.track.fps * 4), 1)
        return [(index / 4, "") for index in range(min(count, LONGEST))]
    edges, phones = performance.line.schedule.common()
    middles = [(start + end) / 2 / MICROSECONDS for start, end in pairwise(edges)]
    return list(zip(middles, phones, strict=True))[:LONGEST]


def _labelled(picture: NDArray[np.uint8], text: str) -> NDArray[np.uint8]:
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(picture)
    ImageDraw.Draw(image).text((8, CELL - 20), text, fill=(255, 255, 255), font=ImageFont.load_default(13))
    return np.asarray(image)


def _sheet(pictures: list[NDArray[np.uint8]]) -> NDArray[np.uint8]:
    """*pictures* side by side; empty places are white."""
    columns = min(COLUMNS, len(pictures))
    sheet = np.full((-(-len(pictures) // columns), columns, CELL, CELL, 3), 255, np.uint8)
    for index, picture in enumerate(pictures):
        sheet[divmod(index, columns)] = picture
    return sheet.swapaxes(1, 2).reshape(sheet.shape[0] * CELL, columns * CELL, 3)
