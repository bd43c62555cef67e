"""The sound alone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.errors import InputError
from lipdb.sound import write_wav

if TYPE_CHECKING:
    from lipdb.performance import Performance


def write_wave(performance: Performance, path: Path) -> None:
    """16-bit PCM. Raises `InputError` when the performance has no sound."""
    if performance.sound is None:
        raise InputError("this performance has no sound to write; give a recording with --audio")
    write_wav(path, performance.sound)
