"""Keep what a voice has said: a repeat gives the same bytes, and gives them sooner.

One file an utterance, named by a digest of everything that decides the result: text, language, voice and the voice's
version. An entry that can't be read is made again; a cache that can't be written is done without.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

import numpy as np

from lipdb.errors import OutputError, ScheduleError
from lipdb.files import whole_file
from lipdb.paths import expanded
from lipdb.schedule import Schedule
from lipdb.sound import Sound
from lipdb.speech.voice import Spoken, Voice

FORMAT = 1
LIMIT = 256 * 1024 * 1024
"""Bytes. The entries that were used longest ago go first."""


def cache_folder() -> Path:
    """``LIPDB_CACHE``, else ``lipdb`` in the place for users' caches (XDG)."""
    if chosen := os.environ.get("LIPDB_CACHE"):
        return expanded(chosen)
    return expanded(os.environ.get("XDG_CACHE_HOME") or "~/.cache") / "lipdb"


def spoken(voice: Voice, text: str, *, folder: Path | None = None) -> Spoken:
    """What *voice* makes of *text*, from *folder* (default: the user's cache) if it is there.

    Raises what the voice raises.
    """
    folder = folder or cache_folder() / "speech"
    file = folder / f"{_digest(voice, text)}.speech"
    kept = _read(file)
    if kept is None:
        kept = voice.speak(text)
        _write(kept, file)
    return kept


def _digest(voice: Voice, text: str) -> str:
    parts = [FORMAT, voice.language, voice.name, voice.version, text]
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:32]


def _read(file: Path) -> Spoken | None:
    """The entry in *file*: a line with the digest of the rest, a line of JSON, then the samples."""
    try:
        digest, _, rest = file.read_bytes().partition(b"\n")
        if digest != _check(rest):
            return None
        header, _, samples = rest.partition(b"\n")
        told = json.loads(header)
        sound = Sound(np.frombuffer(samples, "<i2").astype(np.int16), told["rate"])
        said = Spoken(Schedule.from_json(told["schedule"]), sound, tuple(told["notes"]))
        file.touch()
    except (OSError, ValueError, KeyError, ScheduleError):
        return None
    return said


def _write(said: Spoken, file: Path) -> None:
    header = json.dumps({"schedule": said.schedule.to_json(), "rate": said.sound.rate, "notes": said.notes})
    rest = header.encode() + b"\n" + said.sound.samples.astype("<i2").tobytes()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(file) as temporary:
            temporary.write_bytes(_check(rest) + b"\n" + rest)
        _tidy(file.parent)
    except (OutputError, OSError):
        return


def _check(rest: bytes) -> bytes:
    return hashlib.sha256(rest).hexdigest().encode()


def _tidy(folder: Path) -> None:
    """Delete the entries used longest ago until the rest fits into `LIMIT`."""
    entries = sorted(((e.stat().st_mtime, e.stat().st_size, e) for e in folder.glob("[!.]*.speech")), reverse=True)
    total = 0
    for _, size, entry in entries:
        total += size
        if total > LIMIT:
            entry.unlink(missing_ok=True)
