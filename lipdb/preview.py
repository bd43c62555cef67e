"""What a player in a browser needs of performances: small plain data, with everything large behind links."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from lipdb.errors import InputError
from lipdb.schedule import MICROSECONDS
from lipdb.sound import wav_bytes

if TYPE_CHECKING:
    from lipdb.characters.character import Character
    from lipdb.characters.mesh import Mesh
    from lipdb.performance import Performance
    from lipdb.schedule import Schedule
    from lipdb.sound import Sound
    from lipdb.track import Track

Link = Callable[[bytes, str], str]
"""Turns bytes and their media type into a URL."""

PEAKS = 100
"""Steps a second of the drawn waveform, about."""
BINARY = "application/octet-stream"
MEDIA = {".svg": "image/svg+xml", ".png": "image/png"}


def preview(performances: Sequence[Performance], link: Link) -> dict[str, Any]:
    """One or several faces that speak the same line, on one clock.

    Times are seconds from the start of the track. Weights (``track`` of poses, ``weights`` of a mesh's shapes) are links
    to little-endian 32-bit floats, frame by frame; ``peaks`` to signed bytes, lowest and highest sample of each step in
    turn, ``peak_rate`` steps a second. ``id`` changes exactly when something else does. Raises `InputError` when the
    performances are not of one length.
    """
    first = performances[0]
    if any(len(p.track.weights) != len(first.track.weights) or p.track.fps != first.track.fps for p in performances):
        raise InputError("preview: the performances differ in length or frames a second; make them from one line")
    data: dict[str, Any] = {
        "fps": first.track.fps,
        "duration": max(len(first.track.weights) - 1, 0) / first.track.fps,
        **_sound(first.sound, link),
        **(_spans(first.line.schedule) if first.line else {"words": [], "phones": [], "common": []}),
        "faces": [_face(performance, link) for performance in performances],
    }
    return {"id": hashlib.sha256(repr(data).encode()).hexdigest()[:16], **data}


def _sound(sound: Sound | None, link: Link) -> dict[str, Any]:
    if sound is None:
        return {"audio": None, "peaks": None, "peak_rate": PEAKS}
    step = max(sound.rate // PEAKS, 1)
    return {
        "audio": link(wav_bytes(sound), "audio/wav"),
        "peaks": link(_peaks(sound, step).tobytes(), BINARY),
        "peak_rate": sound.rate / step,
    }


def _face(performance: Performance, link: Link) -> dict[str, Any]:
    who, track = performance.character, performance.track
    face = {"name": who.name, "title": who.title or who.name, "poses": list(track.poses), "track": _weights(track, link)}
    if who.mesh is None:
        pictures = {shape: link(file.read_bytes(), MEDIA[file.suffix.lower()]) for shape, file in who.pictures.items()}
        return {**face, "kind": "pictures", "pictures": pictures, "cues": [list(cue) for cue in performance.cues()]}
    shapes = performance.shapes
    return {
        **face,
        "kind": "mesh",
        "url": link(mesh_bytes(who), "model/gltf-binary"),
        "shapes": list(shapes.poses),
        "weights": _weights(shapes, link),
    }


def mesh_bytes(character: Character) -> bytes:
    """The character's mesh as GLB; the same character gives the same bytes. Raises `InputError` for one of pictures."""
    if character.mesh is None:
        raise InputError(f"character {character.name!r} is made of pictures; it has no mesh")
    return _glb(character.mesh)


@lru_cache(maxsize=16)
def _glb(mesh: Mesh) -> bytes:
    from lipdb.characters.gltf_write import glb_bytes

    return glb_bytes(mesh)


def _spans(schedule: Schedule) -> dict[str, list[tuple[float, float, str]]]:
    edges = [edge / MICROSECONDS for edge in schedule.edges]
    phones = [(start, end, phone.symbol) for phone, start, end in zip(schedule.phones, edges, edges[1:], strict=False)]
    words: list[tuple[float, float, str]] = []
    last = -1
    for phone, (start, end, _) in zip(schedule.phones, phones, strict=True):
        if phone.word >= 0 and phone.word == last:
            words[-1] = (words[-1][0], end, words[-1][2])
        elif phone.word >= 0:
            words.append((start, end, schedule.words[phone.word]))
        last = phone.word
    common_edges, names = schedule.common()
    common = [(a / MICROSECONDS, b / MICROSECONDS, name) for a, b, name in zip(common_edges, common_edges[1:], names, strict=False)]
    return {"words": words, "phones": phones, "common": common}


def _weights(track: Track, link: Link) -> str:
    return link(np.ascontiguousarray(track.weights, dtype="<f4").tobytes(), BINARY)


def _peaks(sound: Sound, step: int) -> np.ndarray:
    """The lowest and highest of each *step* samples, of the loudest 127."""
    rows = np.zeros((-(-len(sound.samples) // step), step), dtype=np.int16)
    rows.reshape(-1)[: len(sound.samples)] = sound.samples
    found = np.stack([rows.min(axis=1, initial=0), rows.max(axis=1, initial=0)], axis=1).astype(np.float64)
    largest = np.abs(found).max(initial=1.0)
    return np.asarray(np.rint(found * (127 / max(largest, 1.0))), dtype=np.int8)
