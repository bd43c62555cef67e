"""A performance as pictures, one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from queue import SimpleQueue
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import MeshError
from lipdb.interrupts import give
from lipdb.progress import steps
from lipdb.render.flat import Pictures
from lipdb.render.renderer import Renderer
from lipdb.track import Track

if TYPE_CHECKING:
    from lipdb.performance import Performance

FPS = 30
SIZE = (512, 512)


def film(
    performance: Performance, *, fps: float = FPS, size: tuple[int, int] = SIZE, view: str = "front", ahead: bool = False
) -> Iterator[NDArray[np.uint8]]:
    """Pictures ``(height, width, 3)`` of the whole performance, *fps* a second, until both track and sound have ended.

    A mesh is drawn at the shapes' weights; flat pictures follow the cues, held as `Performance.cues` holds them. With *ahead*
    each is drawn, by another thread, while the one before it is used.
    """
    times = np.arange(frame_count(performance, fps)) / fps
    yield from stills(performance, times, size=size, view=view, ahead=ahead)


def frame_count(performance: Performance, fps: float) -> int:
    """How many pictures the performance has at *fps*."""
    sound = performance.sound.duration if performance.sound else 0.0
    seconds = max(len(performance.track.weights) / performance.track.fps, sound)
    return max(math.ceil(seconds * fps - 1e-9), 1)


def stills(
    performance: Performance, times: NDArray[np.float64], *, size: tuple[int, int], view: str = "front", ahead: bool = False
) -> Iterator[NDArray[np.uint8]]:
    """The picture at each of *times* (seconds, in order)."""
    pictures = _drawn(performance, times, size=size, view=view)
    # Counted here and not where they are drawn: only the thread that asked can tell somebody.
    yield from steps(_ahead(pictures) if ahead else pictures, total=len(times), what=f"drawing {performance.character.name}")


def _ahead(pictures: Iterator[NDArray[np.uint8]]) -> Iterator[NDArray[np.uint8]]:
    """The same pictures, each drawn while the one before it is used."""
    with ThreadPoolExecutor(max_workers=1) as pool:
        done: SimpleQueue[Future[NDArray[np.uint8] | None]] = SimpleQueue()
        give(pool, done, next, pictures, None)
        while (picture := done.get().result()) is not None:
            give(pool, done, next, pictures, None)
            yield picture


def _drawn(performance: Performance, times: NDArray[np.float64], *, size: tuple[int, int], view: str) -> Iterator[NDArray[np.uint8]]:
    character = performance.character
    if character.pictures:
        pictures = Pictures(character.pictures, size=size)
        yield from (pictures.draw(shape) for shape in shapes_at(performance, times))
        return
    if character.mesh is None:
        raise MeshError(f"character {character.name!r} has neither a mesh nor pictures to draw; add one with `lipdb character add`")
    shapes = performance.shapes
    weights = sampled(shapes, times)
    with Renderer(character.mesh, size=size, view=view) as renderer:
        shown, picture = None, np.empty(0, np.uint8)
        for row in weights:
            if shown is None or (row != shown).any():
                shown, picture = row, renderer.draw(dict(zip(shapes.poses, row.tolist(), strict=True)))
            yield picture


def sampled(track: Track, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weights at *times*, shape ``(times, poses)``, along straight lines between frames; the ends hold."""
    frame = np.clip(times * track.fps, 0, max(len(track.weights) - 1, 0))
    # A time that is a frame but for rounding is that frame, so that pictures at half the rate are every second frame.
    whole = np.rint(frame)
    frame = np.where(np.abs(frame - whole) < 1e-6, whole, frame)
    before = np.floor(frame).astype(np.intp)
    after = np.minimum(before + 1, len(track.weights) - 1)
    part = (frame - before)[:, None]
    mixed: NDArray[np.float64] = track.weights[before] * (1 - part) + track.weights[after] * part
    return mixed


def shapes_at(performance: Performance, times: NDArray[np.float64]) -> list[str]:
    """The one shape shown at each of *times*."""
    found = performance.cues()
    starts = np.array([start for start, _, _ in found])
    return [found[index][2] for index in np.searchsorted(starts, times + 1e-6, side="right") - 1]
