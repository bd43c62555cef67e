"""Wave files of any width are read as 16-bit samples of one channel."""

import struct
import wave
from pathlib import Path

import numpy as np
import pytest

from lipdb.errors import InputError
from lipdb.sound import Sound, read_wav, write_wav


def test_a_sound_comes_back_as_it_was_written(tmp_path: Path) -> None:
    sound = Sound(np.array([0, 1, -1, 32767, -32768], np.int16), 22050)
    write_wav(tmp_path / "a.wav", sound)
    again = read_wav(tmp_path / "a.wav")
    assert again.rate == 22050
    assert again.samples.tolist() == sound.samples.tolist()


@pytest.mark.parametrize(
    ("width", "frame"), [(1, bytes([192, 0])), (2, b"\x00\x40\xff\xff"), (3, b"\xff\x00\x40\x01\x02\x03"), (4, b"\xff\xff\x00\x40" * 2)]
)
def test_every_width_and_the_first_channel(tmp_path: Path, width: int, frame: bytes) -> None:
    with wave.open(str(tmp_path / "a.wav"), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(width)
        file.setframerate(8000)
        file.writeframes(frame * 3)
    assert read_wav(tmp_path / "a.wav").samples.tolist() == [0x4000] * 3


def test_the_extensible_format_of_recorders_is_read(tmp_path: Path) -> None:
    frames = b"\xff\x00\x40" * 2 * 3
    layout = struct.pack("<HHIIHHHHI", 0xFFFE, 2, 48000, 48000 * 6, 6, 24, 22, 24, 3)
    guid = bytes.fromhex("0100000000001000800000aa00389b71")
    body = b"WAVE" + b"fmt " + struct.pack("<I", 40) + layout + guid + b"data" + struct.pack("<I", len(frames)) + frames
    (tmp_path / "a.wav").write_bytes(b"RIFF" + struct.pack("<I", len(body)) + body)
    sound = read_wav(tmp_path / "a.wav")
    assert (sound.rate, sound.samples.tolist()) == (48000, [0x4000] * 3)


@pytest.mark.parametrize("content", [b"", b"RIFF", b"RIFF\x04\x00\x00\x00WAVE", b"not a wave file at all, but text"])
def test_what_is_no_wave_file_is_refused_in_one_line(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a.wav").write_bytes(content)
    with pytest.raises(InputError, match="not a PCM wave file"):
        read_wav(tmp_path / "a.wav")
    with pytest.raises(InputError, match="no such file"):
        read_wav(tmp_path / "b.wav")
