"""Text cut at fixed positions: a part has the lines that *start* between one multiple of the part's size and the next.

So a part depends on nothing but its place: when a file grows, only its last part changes, and whoever reads a part needs no
other. A line that nobody would say in one breath (`LONGEST_LINE`) is kept only so far that it can be reported.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Iterator
from typing import BinaryIO, NamedTuple

from lipdb.coverage.findings import LONGEST_LINE

BLOCK = 1 << 18
"""Bytes. Parts are multiples of it, so that however large they are, a corpus has one digest."""
STEP = 1 << 17
"""Bytes that are read at once; fewer than a line may have."""


def overlong(longest: int) -> re.Pattern[bytes]:
    """Lines of more than *longest* bytes; the group is what is kept of them."""
    return re.compile(rb"([^\n]{%d})[^\n]+" % (longest + 1))


_OVERLONG = overlong(LONGEST_LINE)


class Piece(NamedTuple):
    """Whole lines, and the place in the file or stream at which they start."""

    at: int
    raw: bytes


def read_piece(file: BinaryIO, start: int, size: int) -> Piece:
    """The lines of *file* that start at *start* or after and before *start* + *size*; there may be none."""
    file.seek(max(start - 1, 0))
    raw = file.read(size + (start > 0))
    if start:
        # From the byte in front: it tells whether a line starts at *start*.
        head, newline, raw = raw.partition(b"\n")
        if not newline:
            return Piece(start, b"")
        start += len(head)
    if raw and not raw.endswith(b"\n"):
        raw += _rest_of_line(iter(lambda: file.read(STEP), b""))
    return Piece(start, _shortened(raw))


def _rest_of_line(blocks: Iterator[bytes]) -> bytes:
    rest = b""
    for block in blocks:
        head, newline, _ = block.partition(b"\n")
        rest += head + newline
        if newline or len(rest) > LONGEST_LINE:
            break
    return rest


def _shortened(raw: bytes) -> bytes:
    """*raw* with every line that is too long cut off one byte after the longest that is read."""
    start = 0
    while len(raw) - start > LONGEST_LINE:
        edge = raw.rfind(b"\n", start, start + LONGEST_LINE + 1)
        if edge < 0:
            return _OVERLONG.sub(rb"\1", raw)
        start = edge + 1
    return raw


def cut(blocks: Iterable[bytes], size: int) -> Iterator[Piece]:
    """The pieces of *size* of a stream that comes in *blocks* of at most `STEP` bytes."""
    kept, at = bytearray(), 0
    for block in _without_overlong(blocks):
        kept += block
        while (edge := kept.find(b"\n", (at // size + 1) * size - 1 - at)) >= 0:
            yield Piece(at, bytes(kept[: edge + 1]))
            at += edge + 1
            del kept[: edge + 1]
    if kept:
        yield Piece(at, bytes(kept))


def _without_overlong(blocks: Iterable[bytes]) -> Iterator[bytes]:
    """*blocks* as `_shortened` would have them all together; places are counted in what is left."""
    length = 0  # of the line that has not ended yet
    for block in blocks:
        head, newline, _ = block.partition(b"\n")
        room = max(LONGEST_LINE + 1 - length, 0)
        yield block if len(head) <= room else head[:room] + block[len(head) :]
        length = len(block) - block.rfind(b"\n") - 1 if newline else length + len(block)


def digests(piece: Piece) -> tuple[str, ...]:
    """A digest for every `BLOCK` of the file or stream in which lines of *piece* start."""
    found, first = [], 0
    while first < len(piece.raw):
        last = ((piece.at + first) // BLOCK + 1) * BLOCK - 1 - piece.at
        edge = piece.raw.find(b"\n", last) + 1 or len(piece.raw)
        found.append(hashlib.sha256(memoryview(piece.raw)[first:edge]).hexdigest())
        first = edge
    return tuple(found)
