"""Bytes of text to lines that a voice can be given, with what of them was left out and why."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from lipdb.coverage.counts import DOCUMENTS, FINDINGS, Counts, Lines
from lipdb.coverage.findings import LONGEST_LINE, NOT_UTF8, TOO_LONG

_SHOWN = 60
_SLICE = 4 * _SHOWN
NEWLINE = b"\n"


class Read(NamedTuple):
    """The lines that a voice is given, and the counts of those that it is not."""

    lines: Lines
    left_out: Counts


def finding(document: str, reason: str, example: str, count: int = 1) -> Counts:
    """Counts of nothing but *count* times *reason*."""
    return Counts.of(findings=pa.table([[document], [reason], [count], [shown(example)]], schema=FINDINGS))


def shown(text: str) -> str:
    """*text* on one line, not too long, without signs that a terminal would obey."""
    plain = "".join(c if c.isprintable() else "�" for c in text[: 2 * _SHOWN].strip())
    return plain if len(plain) <= _SHOWN else plain[: _SHOWN - 1] + "…"


def lines_of(raw: bytes) -> Read:
    """The lines of *raw*, without blank ones and without white space at their ends; the document has no name yet.

    Lines that are too long, their end included, or no UTF-8 are left out.
    """
    edges = np.flatnonzero(np.frombuffer(raw, np.uint8) == NEWLINE[0]) + 1
    offsets = np.concatenate(([0], edges, [] if raw.endswith(NEWLINE) or not raw else [len(raw)])).astype(np.int32)
    array = pa.BinaryArray.from_buffers(pa.binary(), len(offsets) - 1, [None, pa.py_buffer(offsets), pa.py_buffer(raw)])
    return _read(array, np.zeros(len(array), np.int32), ("",))


def rows_of(batch: pa.RecordBatch, document: str | None) -> Read:
    """The lines of a batch with the columns ``text`` and, unless *document* is given, ``document``."""
    text = batch.column("text").cast(pa.large_binary())
    pieces = pc.split_pattern(text, NEWLINE)
    lines, row = pc.list_flatten(pieces).cast(pa.binary()), pc.list_parent_indices(pieces).to_numpy()
    if document is not None:
        return _read(lines, np.zeros(len(lines), np.int32), (document,))
    names = pc.fill_null(batch.column("document").cast(pa.string()), "").dictionary_encode()
    order = np.argsort(names.indices.to_numpy()[row], kind="stable")
    return _read(lines.take(pa.array(order)), names.indices.to_numpy()[row][order], tuple(names.dictionary.to_pylist()))


def _read(lines: pa.BinaryArray, document: NDArray[np.int32], names: tuple[str, ...]) -> Read:
    left_out = Counts.of()
    long = pc.binary_length(lines).to_numpy(zero_copy_only=False) > LONGEST_LINE
    if long.any():
        left_out += _left_out(lines, document, names, long, TOO_LONG)
        lines, document = lines.filter(pa.array(~long)), document[~long]
    if not _is_utf8(lines):
        wrong = np.array([not _is_utf8_bytes(line.as_py()) for line in lines], bool)
        left_out += _left_out(lines, document, names, wrong, NOT_UTF8)
        lines, document = lines.filter(pa.array(~wrong)), document[~wrong]
    texts = pc.utf8_trim_whitespace(lines.view(pa.string()))
    said = pc.binary_length(texts).to_numpy(zero_copy_only=False) > 0
    if not said.all():
        texts, document = texts.filter(pa.array(said)), document[said]
    return Read(Lines(texts, document, names), left_out)


def _left_out(lines: pa.BinaryArray, document: NDArray[np.int32], names: tuple[str, ...], wrong: NDArray[np.bool_], reason: str) -> Counts:
    """The counts of the lines that are *wrong*: for each document how many, and the first by its bytes as the example."""
    of = pa.array(document[wrong])
    found = pa.table([of, pc.binary_slice(lines.filter(pa.array(wrong)), 0, _SLICE)], ["document", "example"])
    found = found.group_by("document").aggregate([("example", "count"), ("example", "min")]).combine_chunks()
    name = pa.array(names, pa.string()).take(found["document"])
    examples = [shown(example.decode(errors="replace")) for example in found["example_min"].to_pylist()]
    nothing = pa.repeat(pa.scalar(0, pa.int64()), len(found))
    return Counts.of(
        findings=pa.table([name, pa.repeat(reason, len(found)), found["example_count"], pa.array(examples, pa.string())], schema=FINDINGS),
        documents=pa.table([name, found["example_count"], nothing], schema=DOCUMENTS),
    )


def _is_utf8(lines: pa.BinaryArray) -> bool:
    try:
        lines.view(pa.string()).validate(full=True)
    except pa.ArrowInvalid:
        return False
    return True


def _is_utf8_bytes(raw: bytes) -> bool:
    try:
        raw.decode()
    except UnicodeDecodeError:
        return False
    return True
