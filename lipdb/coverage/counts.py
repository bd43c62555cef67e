"""What a part of a corpus holds, as counted: pairs of labels, what was left out, how many lines.

Counting is a map and a sum. A `Counter` turns `Lines` into `Counts`, anywhere; the sum is associative and commutative and
its result is in canonical order, so any division of a corpus, on any number of machines, gives the same bytes.

What is counted are the labels of the voice. They become phones and common phones only at the end (`lipdb.coverage.resolve`):
a changed mapping does not need the voice again.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple, Protocol, Self

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from numpy.typing import NDArray

from lipdb.files import whole_file
from lipdb.schedule import SILENCE

PAIRS = pa.schema([("document", pa.string()), ("left", pa.string()), ("right", pa.string()), ("count", pa.int64())])
"""Two labels of the voice's notation that follow each other, ``_`` at the edges of phrases, and how often."""
FINDINGS = pa.schema([("document", pa.string()), ("reason", pa.string()), ("count", pa.int64()), ("example", pa.string())])
"""Lines that were left out or read in a way that a person may not expect; see `lipdb.coverage.findings`."""
DOCUMENTS = pa.schema([("document", pa.string()), ("lines", pa.int64()), ("spoken", pa.int64())])
"""How many lines a document has, blank ones left out, and how many of them were counted."""
SAMPLE = pa.schema([("fold", pa.int64()), ("left", pa.string()), ("right", pa.string()), ("exact", pa.int64()), ("fast", pa.int64())])
"""Pairs of a sample of the lines, counted both ways, where a counter takes short cuts: what its error is measured on.

Lines belong to one of a few *folds* by what is in them, to tell how far chance goes."""

_SCHEMAS = {"pairs": PAIRS, "findings": FINDINGS, "documents": DOCUMENTS, "sample": SAMPLE}
_HOW = {"count": "sum", "lines": "sum", "spoken": "sum", "exact": "sum", "fast": "sum", "example": "min"}
_PREFIX = b"lipdb:"
_DENSE = 1 << 22  # Pairs that may be counted in an array of all of them; more are sorted.


class Lines(NamedTuple):
    """Lines of text: *texts* (valid UTF-8, one line each), and for each the index of its document in *names*, ascending."""

    texts: pa.StringArray
    document: NDArray[np.int32]
    names: tuple[str, ...]


class Counter(Protocol):
    """One way of counting. A counter is small and can be pickled; what it keeps while it works belongs to the process."""

    @property
    def key(self) -> str:
        """Everything that decides the result beside the lines: equal keys and equal lines give equal counts."""

    @property
    def mode(self) -> str:
        """What a person calls it: ``exact`` or ``fast``."""

    @property
    def notation(self) -> str:
        """The notation of the labels."""

    @property
    def size(self) -> int:
        """How many bytes of text to count at once."""

    @property
    def threads(self) -> bool:
        """Whether threads of one process count side by side; else it takes processes."""

    def count(self, lines: Lines) -> Counts:
        """The counts of *lines*. What can't be read is a finding, never an error."""


@dataclass(frozen=True, eq=False)
class Counts:
    """Tables of the schemas `PAIRS`, `FINDINGS`, `DOCUMENTS` and `SAMPLE`, each sorted and without a key twice."""

    pairs: pa.Table
    findings: pa.Table
    documents: pa.Table
    sample: pa.Table

    @classmethod
    def of(
        cls,
        pairs: pa.Table | None = None,
        findings: pa.Table | None = None,
        documents: pa.Table | None = None,
        sample: pa.Table | None = None,
    ) -> Self:
        """Counts of tables in any order, whose keys may repeat; a table that is not given is empty."""
        given = {"pairs": pairs, "findings": findings, "documents": documents, "sample": sample}
        return cls(**{name: _canonical(table, _SCHEMAS[name]) for name, table in given.items()})

    @classmethod
    def sum(cls, parts: Iterable[Counts]) -> Self:
        """The sum of *parts*: associative, commutative, `Counts.of()` is its zero."""
        tables: dict[str, list[pa.Table]] = {name: [schema.empty_table()] for name, schema in _SCHEMAS.items()}
        for part in parts:
            for name, found in tables.items():
                found.append(getattr(part, name))
        return cls.of(**{name: pa.concat_tables(found) for name, found in tables.items()})

    def __add__(self, other: Counts) -> Counts:
        return Counts.sum((self, other))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Counts) and all(getattr(self, name).equals(getattr(other, name)) for name in _SCHEMAS)

    __hash__ = None  # type: ignore[assignment]

    def named(self, document: str) -> Counts:
        """The same counts, all of them of *document*."""
        tables = {name: getattr(self, name) for name in _SCHEMAS}
        for name in ("pairs", "findings", "documents"):
            column = pa.repeat(pa.scalar(document), len(tables[name]))
            tables[name] = tables[name].set_column(0, tables[name].schema.field(0), column)
        return Counts.of(**tables)

    def between(self, low: str, high: str | None) -> Counts:
        """The counts of the documents from *low* to before *high* by name (None: to the last); the sample goes with the first."""
        tables = {name: getattr(self, name) for name in _SCHEMAS}
        for name in ("pairs", "findings", "documents"):
            document = tables[name]["document"]
            within = pc.greater_equal(document, low)
            tables[name] = tables[name].filter(within if high is None else pc.and_(within, pc.less(document, high)))
        return Counts(**(tables if not low else {**tables, "sample": SAMPLE.empty_table()}))

    def write(self, path: Path, **metadata: Any) -> None:
        """Write into the Parquet file *path*, whole or not at all: the pairs as rows, the rest in its metadata."""
        small = {name: getattr(self, name).to_pydict() for name in _SCHEMAS if name != "pairs"}
        write_table(self.pairs, path, {**metadata, **small})

    @classmethod
    def read(cls, path: Path) -> Self:
        """What `write` wrote. Raises `OSError` or `ValueError` for any other file."""
        with pq.ParquetFile(path) as file:  # pq.read_table would bring data sets and threads
            pairs = file.read(use_threads=False)
        told = read_metadata(pairs.schema.metadata)
        if not pairs.schema.equals(PAIRS) or not all(name in told for name in _SCHEMAS if name != "pairs"):
            raise ValueError(f"{path}: no counts of a part of a corpus")
        small = {name: pa.table(told[name], schema=schema) for name, schema in _SCHEMAS.items() if name != "pairs"}
        return cls(pairs.replace_schema_metadata(), **small)


def write_table(table: pa.Table, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write *table* as Parquet, whole or not at all, with *metadata* as JSON under names of our own. Raises `OutputError`."""
    with whole_file(path) as temporary:
        pq.write_table(table.replace_schema_metadata(metadata_of(metadata)), temporary, compression="zstd")


def metadata_of(told: Mapping[str, Any]) -> dict[bytes, bytes]:
    """*told* as the metadata of a Parquet file: JSON under names of our own."""
    return {_PREFIX + name.encode(): json.dumps(value, ensure_ascii=False).encode() for name, value in told.items()}


def read_metadata(metadata: Mapping[bytes, bytes] | None) -> dict[str, Any]:
    """What `metadata_of` was told."""
    found = (metadata or {}).items()
    return {name.removeprefix(_PREFIX).decode(): json.loads(value) for name, value in found if name.startswith(_PREFIX)}


def pair_table(
    lines: Lines, document: NDArray[np.integer], codes: NDArray[np.integer], labels: list[str], weights: NDArray[np.integer] | None = None
) -> pa.Table:
    """The pairs in a run of label *codes* (indices into *labels*, of which one is ``_``), by *document*.

    *document* (indices into ``lines.names``) and *weights* (how often the line came) have one entry a code. The codes of every
    line begin and end with ``_``; pairs of two silences are no pairs.
    """
    size = len(labels)
    silence = labels.index(SILENCE)
    key = (document[:-1].astype(np.int64) * size + codes[:-1]) * size + codes[1:]
    space = len(lines.names) * size * size
    if space <= _DENSE:
        count = np.bincount(key, None if weights is None else weights[:-1], space)
        found = np.flatnonzero(count)
        count = count[found]
    else:
        found, inverse = np.unique(key, return_inverse=True)
        count = np.bincount(inverse, None if weights is None else weights[:-1], len(found))
    left, right = found // size % size, found % size
    keep = (left != silence) | (right != silence)
    names, spelled = pa.array(lines.names, pa.string()), pa.array(labels, pa.string())
    columns = (
        names.take(pa.array(found // size**2)),
        spelled.take(pa.array(left)),
        spelled.take(pa.array(right)),
        pa.array(count.astype(np.int64)),
    )
    return pa.table(list(columns), schema=PAIRS).filter(pa.array(keep))


def _canonical(table: pa.Table | None, schema: pa.Schema) -> pa.Table:
    """*table* summed by its key, sorted by it, in one chunk."""
    if table is None or not len(table):
        return schema.empty_table()
    keys = [name for name in schema.names if name not in _HOW]
    summed = table.group_by(keys, use_threads=False).aggregate([(name, _HOW[name]) for name in schema.names if name in _HOW])
    summed = summed.rename_columns([*keys, *(name for name in schema.names if name in _HOW)]).select(schema.names)
    return summed.sort_by([(name, "ascending") for name in keys]).cast(schema).combine_chunks()
