"""Video: MP4 with sound through PyAV, and animated WebP where there is none.

One encoding thread and bit-exact flags, so the same pictures and sound give the same bytes.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lipdb.errors import MissingToolError
from lipdb.render.film import FPS, film

if TYPE_CHECKING:
    from lipdb.performance import Performance
    from lipdb.sound import Sound

QUALITY = "18"
"""H.264's constant rate factor: lower is better and larger; 18 shows no loss to the eye."""

SOUND_BITS = 128_000
AAC_RATES = (8_000, 11_025, 12_000, 16_000, 22_050, 24_000, 32_000, 44_100, 48_000, 64_000, 88_200, 96_000)
"""Samples a second that AAC has; others are resampled to the next one."""
WEBP_FPS = 25
WEBP_SIZE = (480, 480)


def write_mp4(performance: Performance, path: Path) -> None:
    """H.264 and AAC, 512 x 512 at 30 frames a second. Raises `MissingToolError` without PyAV."""
    try:
        import av
    except ImportError as error:
        raise MissingToolError("MP4 needs PyAV; run `pip install av`, or write .webp instead") from error
    pictures = film(performance, fps=FPS, ahead=True)
    first = next(pictures)
    # The muxer's own date and version would make two files differ; faststart lets a browser play before it has all.
    with av.open(str(path), "w", format="mp4", options={"fflags": "+bitexact", "movflags": "+faststart"}) as file:
        stream = _picture_stream(file, first.shape[1], first.shape[0])
        packets = _sound_packets(file, performance.sound) if performance.sound else iter(())
        ahead = next(packets, None)
        for number, picture in enumerate(chain([first], pictures)):
            frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
            frame.pts, frame.time_base = number, Fraction(1, FPS)
            file.mux(stream.encode(frame))
            while ahead is not None and ahead.pts * ahead.time_base <= Fraction(number + 1, FPS):
                file.mux(ahead)
                ahead = next(packets, None)
        file.mux(stream.encode(None))
        file.mux(([ahead] if ahead is not None else []) + list(packets))


def _picture_stream(file: Any, width: int, height: int) -> Any:
    stream = file.add_stream("libx264", rate=FPS, options={"crf": QUALITY, "preset": "veryfast", "threads": "1"})
    stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
    stream.codec_context.thread_count = 1
    _make_exact(stream)
    return stream


def _sound_packets(file: Any, sound: Sound) -> Iterator[Any]:
    """AAC packets of *sound*, made as they are asked for."""
    import av

    rate = next((rate for rate in AAC_RATES if rate >= sound.rate), AAC_RATES[-1])
    stream = file.add_stream("aac", rate=rate, layout="mono")
    stream.bit_rate = SOUND_BITS
    _make_exact(stream)
    return _encoded(stream, av.AudioResampler(format="fltp", layout="mono", rate=rate, frame_size=1024), sound)


def _encoded(stream: Any, resampler: Any, sound: Sound) -> Iterator[Any]:
    import av

    for start in range(0, len(sound.samples), sound.rate):
        piece = np.ascontiguousarray(sound.samples[start : start + sound.rate]).reshape(1, -1)
        frame = av.AudioFrame.from_ndarray(piece, format="s16", layout="mono")
        frame.sample_rate, frame.pts, frame.time_base = sound.rate, start, Fraction(1, sound.rate)
        for part in resampler.resample(frame):
            yield from stream.encode(part)
    for part in resampler.resample(None):
        yield from stream.encode(part)
    yield from stream.encode(None)


def _make_exact(stream: Any) -> None:
    from av.codec.context import Flags

    stream.codec_context.flags |= Flags.bitexact


def write_webp(performance: Performance, path: Path) -> None:
    """Animated WebP, 480 x 480 at 25 frames a second: no sound, so write a .wav beside it. Pillow alone is needed."""
    from PIL import Image

    pictures = film(performance, fps=WEBP_FPS, size=WEBP_SIZE)
    first = Image.fromarray(next(pictures))
    rest = (Image.fromarray(picture) for picture in pictures)
    first.save(path, format="WEBP", save_all=True, append_images=rest, duration=1000 // WEBP_FPS, loop=0, quality=80, method=2)
