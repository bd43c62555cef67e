"""Recorded or synthesised speech: one channel of samples."""

from __future__ import annotations

import io
import wave
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError

LOWEST_RATE, HIGHEST_RATE = 1_000, 768_000
"""Samples a second that a recording may have."""
EXTENSIBLE = 0xFFFE


@dataclass(frozen=True, slots=True, eq=False)
class Sound:
    """Signed 16-bit samples of shape ``(n,)``, *rate* of them a second."""

    samples: NDArray[np.int16]
    rate: int

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.samples) / self.rate


def read_wav(path: Path) -> Sound:
    """The first channel of a PCM wave file with 8, 16, 24 or 32 bits. Raises `InputError`."""
    try:
        with wave.open(str(path), "rb") as file:
            width, channels, rate, raw = file.getsampwidth(), file.getnchannels(), file.getframerate(), file.readframes(file.getnframes())
    except FileNotFoundError as error:
        raise InputError(f"{path}: no such file") from error
    except (wave.Error, EOFError, OSError) as error:
        if str(error) == f"unknown format: {EXTENSIBLE}":
            return _read_extensible(path)
        raise InputError(f"{path}: not a PCM wave file ({str(error) or 'cut off'}); convert it to 16-bit WAV") from error
    if not LOWEST_RATE <= rate <= HIGHEST_RATE or width > 4:
        raise InputError(f"{path}: {rate} samples of {8 * width} bits a second can't be sound; convert it to 16-bit WAV")
    if width == 1:
        samples = (np.frombuffer(raw, np.uint8).astype(np.int16) - 128) << 8
    else:
        whole = np.frombuffer(raw[: len(raw) // width * width], np.uint8).reshape(-1, width)
        samples = np.ascontiguousarray(whole[:, -2:]).view("<i2")[:, 0]
    return Sound(np.ascontiguousarray(samples[::channels], np.int16), rate)


def _read_extensible(path: Path) -> Sound:
    """A file in the extensible format, which recorders write for 24 bits and which `wave` reads from Python 3.12 on."""
    import struct

    from scipy.io import wavfile

    try:
        rate, samples = wavfile.read(path)
    except (ValueError, EOFError, OSError, struct.error) as error:
        raise InputError(f"{path}: not a PCM wave file ({error}); convert it to 16-bit WAV") from error
    if not LOWEST_RATE <= rate <= HIGHEST_RATE or samples.dtype not in (np.int16, np.int32):
        raise InputError(f"{path}: {rate} samples of {samples.dtype} a second can't be read; convert it to 16-bit WAV")
    first = samples if samples.ndim == 1 else samples[:, 0]
    return Sound((first >> (16 if first.dtype == np.int32 else 0)).astype(np.int16), int(rate))


def write_wav(path: Path, sound: Sound) -> None:
    """Write 16-bit PCM; the same sound gives the same bytes."""
    path.write_bytes(wav_bytes(sound))


def wav_bytes(sound: Sound) -> bytes:
    """A wave file of 16-bit PCM."""
    with io.BytesIO() as buffer:
        with wave.open(buffer, "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(sound.rate)
            file.writeframes(sound.samples.astype("<i2").tobytes())
        return buffer.getvalue()
