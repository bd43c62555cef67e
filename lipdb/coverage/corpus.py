"""What a corpus is made of: files, folders and standard input; text, compressed text, Parquet and alignments."""

from __future__ import annotations

import codecs
import os
import stat
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import BinaryIO, NamedTuple

import pyarrow as pa
import pyarrow.parquet as pq

from lipdb.coverage.counts import Counts
from lipdb.coverage.cut import STEP, cut
from lipdb.coverage.findings import CUT_OFF, NO_LINES, NOT_READABLE, NOT_TEXT
from lipdb.coverage.lines import finding
from lipdb.coverage.parts import AlignedPart, FilePart, Part, RowsPart, StreamPart
from lipdb.errors import InputError

STANDARD_INPUT = "-"
TEXT, PARQUET, ALIGNED, UTF16 = "text", "parquet", "aligned", "utf-16"
COMPRESSED = {b"\x1f\x8b": "gzip", b"\x28\xb5\x2f\xfd": "zstd", b"BZh": "bz2"}
MARKS = {codecs.BOM_UTF16_LE: UTF16, codecs.BOM_UTF16_BE: UTF16}
_HEAD = 1 << 16
_PARQUET = b"PAR1"
_STRINGS = frozenset({pa.string(), pa.large_string(), pa.string_view(), pa.binary(), pa.large_binary()})
_TEXTGRID = ".textgrid"


class Source(NamedTuple):
    """One file of a corpus: how it is called in results, where it is, of what *kind*, how many bytes (0: nobody knows)."""

    document: str
    path: Path
    kind: str
    size: int
    modified: int = 0


def sources(paths: Sequence[str]) -> Iterator[Source | Counts]:
    """The files of *paths* in order, folders by name and all the way down; a finding for each that can't be used.

    In a folder with alignments only those are counted, for the texts beside them say the same. Hidden files are left out.
    Raises `InputError` for a path that is not there.
    """
    for path in paths:
        if path == STANDARD_INPUT:
            if sys.stdin is None:
                raise InputError("standard input is closed; pipe a text in, or name a file")
            yield Source(path, Path(path), TEXT, 0)
        elif not path or not Path(path).exists():
            raise InputError(
                f"{path or repr(path)}: there is no such file or folder; give a text, a folder of texts, or - for standard input"
            )
        elif Path(path).is_fifo():
            # One that somebody names; those in a folder are not read, for nobody may ever write into them.
            yield Source(printable_path(Path(path)), Path(path), TEXT, 0)
        else:
            files = list(_files(Path(path), set())) if Path(path).is_dir() else [Path(path)]
            aligned = [file for file in files if file.suffix.lower() == _TEXTGRID]
            yield from map(_source, aligned or files)


def _files(folder: Path, seen: set[tuple[int, int]]) -> Iterator[Path]:
    """The files below *folder*, sorted; a folder that links lead back to is entered once."""
    try:
        told = folder.stat()
        entries = sorted(folder.iterdir()) if (told.st_dev, told.st_ino) not in seen else []
    except OSError:
        yield folder  # it becomes a finding
        return
    seen.add((told.st_dev, told.st_ino))
    for entry in entries:
        if entry.name.startswith("."):
            continue
        if entry.is_dir():
            yield from _files(entry, seen)
        else:
            yield entry


def _source(path: Path) -> Source | Counts:
    """*path* by what its first bytes say that it is."""
    document = printable_path(path)
    try:
        told = path.stat()
        if not stat.S_ISREG(told.st_mode):
            return finding(document, NOT_READABLE, "it is no file")
        with path.open("rb") as file:
            head = file.read(_HEAD)
    except OSError as error:
        return finding(document, NOT_READABLE, error.strerror or str(error))
    kind = _kind(path, head)
    if not head:
        return finding(document, NO_LINES, "it is empty")
    if kind == TEXT and b"\0" in head:
        return finding(document, NOT_TEXT, "it has zero bytes")
    return Source(document, path, kind, told.st_size, told.st_mtime_ns)


def _kind(path: Path, head: bytes) -> str:
    if path.suffix.lower() == _TEXTGRID:
        return ALIGNED
    if head.startswith(_PARQUET):
        return PARQUET
    return next((kind for magic, kind in {**COMPRESSED, **MARKS}.items() if head.startswith(magic)), TEXT)


def printable_path(path: Path) -> str:
    """How *path* is called in results: as it was given, with `/`, and bytes that are no text shown as such."""
    return printable(path.as_posix())


def printable(name: str) -> str:
    """*name* with bytes that are no text shown as such."""
    return name.encode("utf-8", "backslashreplace").decode()


def parts(source: Source, size: int) -> Iterator[Part | Counts]:
    """The parts of *source*, of about *size* bytes each, and a finding where it ends early or is not what it seems."""
    if source.kind == ALIGNED:
        yield AlignedPart(source.document, source.path)
    elif source.kind == PARQUET:
        yield from _row_groups(source)
    elif source.kind == TEXT and source.size:
        for start in range(0, source.size, size):
            yield FilePart(source.document, source.path, start, min(size, source.size - start))
    else:
        yield from _stream(source, size)


def _row_groups(source: Source) -> Iterator[Part | Counts]:
    try:
        with pq.ParquetFile(source.path) as file:
            schema, groups = file.schema_arrow, file.metadata.num_row_groups
    except (OSError, ValueError) as error:
        yield finding(source.document, NOT_READABLE, f"the Parquet file is damaged: {error}")
        return
    if wrong := _wrong_columns(schema):
        yield finding(source.document, NOT_TEXT, wrong)
        return
    for group in range(groups):
        yield RowsPart(source.document, source.path, group, named="document" in schema.names)


def _wrong_columns(schema: pa.Schema) -> str:
    """Why a Parquet file of *schema* holds no text; nothing when it does.

    Strings may stand in a dictionary, as categories are written, or as bytes, as older programs write them.
    """
    if "text" not in schema.names:
        return f"it has no column text of strings, but {', '.join(schema.names)}"
    for name in ("text", "document"):
        if schema.names.count(name) > 1:
            return f"it has more than one column {name}"
    kind = schema.field("text").type
    if (kind.value_type if pa.types.is_dictionary(kind) else kind) not in _STRINGS:
        return f"its column text is {kind}, not strings"
    if "document" in schema.names and pa.types.is_nested(schema.field("document").type):
        return f"its column document is {schema.field('document').type}, not names"
    return ""


def _stream(source: Source, size: int) -> Iterator[Part | Counts]:
    """The parts of what can't be read from the middle: compressed text, another encoding, standard input."""
    wrong: list[Counts] = []

    def blocks() -> Iterator[bytes]:
        try:
            with _opened(source) as stream:
                first = True
                while block := stream.read(STEP):
                    if first and b"\0" in block[:_HEAD]:
                        wrong.append(finding(source.document, NOT_TEXT, "it has zero bytes"))
                        return
                    first = False
                    yield block
                if first:
                    wrong.append(finding(source.document, NO_LINES, "it is empty"))
        except (OSError, EOFError, UnicodeError) as error:
            wrong.append(finding(source.document, CUT_OFF, str(error)))

    for piece in cut(blocks(), size):
        yield StreamPart(source.document, piece)
    yield from wrong


def _opened(source: Source) -> BinaryIO:
    if source.document == STANDARD_INPUT:
        return os.fdopen(os.dup(sys.stdin.fileno()), "rb")
    if source.kind == UTF16:
        return _Recoded(source.path)
    compression = source.kind if source.kind in COMPRESSED.values() else None
    stream: BinaryIO = pa.input_stream(str(source.path), compression=compression) if compression else source.path.open("rb")
    return stream


class _Recoded(codecs.StreamRecoder):
    """A file in UTF-16 as UTF-8."""

    def __init__(self, path: Path) -> None:
        utf8, utf16 = codecs.lookup("utf-8"), codecs.lookup("utf-16")
        super().__init__(path.open("rb"), utf8.encode, utf8.decode, utf16.streamreader, utf16.streamwriter)
