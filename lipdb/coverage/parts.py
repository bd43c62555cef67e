"""One part of a corpus: what a worker is given. It reads the part itself, so that files need not travel."""

from __future__ import annotations

import codecs
import hashlib
import os
from collections import Counter as Tally
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple, Protocol

import pyarrow as pa
import pyarrow.parquet as pq

from lipdb.coverage.counts import DOCUMENTS, PAIRS, Counter, Counts
from lipdb.coverage.cut import Piece, digests, read_piece
from lipdb.coverage.findings import NOT_READABLE
from lipdb.coverage.lines import finding, lines_of, rows_of
from lipdb.errors import InputError
from lipdb.schedule import SILENCE

_SMALLEST = 1 << 10  # Bytes. A part that is not larger is not cut in halves again.


class Content(NamedTuple):
    """What a part holds: its digests, and a function that counts it."""

    digests: tuple[str, ...]
    counted: Callable[[Counter], Counts]


class Part(Protocol):
    """A part of a corpus. Parts are small and can be pickled."""

    @property
    def document(self) -> str:
        """The file that it is part of."""

    @property
    def weight(self) -> int:
        """How much work it is, in bytes; about."""

    @property
    def named(self) -> bool:
        """Whether its counts name their documents; else they have no name, and all are of the file."""

    def read(self) -> Content:
        """Its content. Raises `OSError` when the file can't be read (any more)."""

    def halves(self) -> tuple[Part, ...]:
        """The same in two parts; nothing when it can't be divided."""


@dataclass(frozen=True, slots=True)
class FilePart:
    """The lines of the plain file *path* that start in *size* bytes from *start* on."""

    document: str
    path: Path
    start: int
    size: int

    @property
    def named(self) -> bool:
        """No."""
        return False

    @property
    def weight(self) -> int:
        """Its bytes."""
        return self.size

    def read(self) -> Content:
        """The text. Raises `OSError` too when somebody made the file shorter since it was divided into parts."""
        with self.path.open("rb") as file:
            piece = read_piece(file, self.start, self.size)
            if os.fstat(file.fileno()).st_size < self.start + self.size:
                raise OSError("it became shorter while it was read")
            return _text(piece)

    def halves(self) -> tuple[Part, ...]:
        """Those that start in each half."""
        half = self.size // 2
        if half < _SMALLEST:
            return ()
        return FilePart(self.document, self.path, self.start, half), FilePart(self.document, self.path, self.start + half, self.size - half)


@dataclass(frozen=True, slots=True)
class StreamPart:
    """A *piece* of what can be read only from its beginning."""

    document: str
    piece: Piece

    @property
    def named(self) -> bool:
        """No."""
        return False

    @property
    def weight(self) -> int:
        """Its bytes."""
        return len(self.piece.raw)

    def read(self) -> Content:
        """The text."""
        return _text(self.piece)

    def halves(self) -> tuple[Part, ...]:
        """The lines of each half."""
        edge = self.piece.raw.find(b"\n", len(self.piece.raw) // 2) + 1
        if edge in (0, len(self.piece.raw)) or len(self.piece.raw) < 2 * _SMALLEST:
            return ()
        first, second = Piece(self.piece.at, self.piece.raw[:edge]), Piece(self.piece.at + edge, self.piece.raw[edge:])
        return StreamPart(self.document, first), StreamPart(self.document, second)


def _text(piece: Piece) -> Content:
    raw = piece.raw.removeprefix(codecs.BOM_UTF8) if piece.at == 0 else piece.raw

    def count(counter: Counter) -> Counts:
        lines, left_out = lines_of(raw)
        return counter.count(lines) + left_out

    return Content(digests(piece), count)


@dataclass(frozen=True, slots=True)
class RowsPart:
    """A row group of the Parquet file *path*; documents are *named* by a column, else the file is the document."""

    document: str
    path: Path
    group: int
    named: bool

    @property
    def weight(self) -> int:
        """Its bytes in the file."""
        return sum(size for _, size in self._places())

    def read(self) -> Content:
        """The rows; the digest is of the bytes in the file."""
        digest = hashlib.sha256()
        with self.path.open("rb") as file:
            for start, size in self._places():
                file.seek(start)
                digest.update(file.read(size))
        return Content((digest.hexdigest(),), self._count)

    def halves(self) -> tuple[Part, ...]:
        """A row group is not divided."""
        return ()

    def _places(self) -> list[tuple[int, int]]:
        """Where the columns stand in the file: start and size."""
        with pq.ParquetFile(self.path) as file:
            group = file.metadata.row_group(self.group)
            columns = [group.column(k) for k in range(group.num_columns) if group.column(k).path_in_schema in self._columns]
        return [(column.dictionary_page_offset or column.data_page_offset, column.total_compressed_size) for column in columns]

    @property
    def _columns(self) -> list[str]:
        return ["document", "text"] if self.named else ["text"]

    def _count(self, counter: Counter) -> Counts:
        total = Counts.of()
        for batch in self._batches(counter.size):
            lines, left_out = rows_of(batch, None if self.named else "")
            total += counter.count(lines) + left_out
        return total

    def _batches(self, size: int) -> Iterator[pa.RecordBatch]:
        """The rows, about *size* bytes at once."""
        with pq.ParquetFile(self.path, buffer_size=1 << 20, pre_buffer=False) as file:
            group = file.metadata.row_group(self.group)
            rows = max(1, size * group.num_rows // max(group.total_byte_size, 1))
            yield from file.iter_batches(batch_size=min(rows, 1 << 16), row_groups=[self.group], columns=self._columns)


@dataclass(frozen=True, slots=True)
class AlignedPart:
    """A recording that was aligned already: a TextGrid."""

    document: str
    path: Path

    @property
    def named(self) -> bool:
        """No."""
        return False

    @property
    def weight(self) -> int:
        """Its bytes."""
        return self.path.stat().st_size

    def read(self) -> Content:
        """The phones of the file."""
        digest = hashlib.sha256(self.path.read_bytes()).hexdigest()
        return Content((digest,), self._count)

    def halves(self) -> tuple[Part, ...]:
        """An alignment is not divided."""
        return ()

    def _count(self, _counter: Counter) -> Counts:
        from lipdb.speech.textgrid import read_textgrid

        try:
            schedule = read_textgrid(self.path)
        except InputError as error:
            return finding("", NOT_READABLE, str(error).removeprefix(f"{self.path}: "))
        pairs = Tally(pairwise((SILENCE, *(phone.symbol for phone in schedule.phones), SILENCE)))
        pairs.pop((SILENCE, SILENCE), None)
        rows = [("", left, right, count) for (left, right), count in pairs.items()]
        return Counts.of(
            pairs=pa.table([list(column) for column in zip(*rows, strict=True)] if rows else [[]] * 4, schema=PAIRS),
            documents=pa.table([[""], [1], [1]], schema=DOCUMENTS),
        )
