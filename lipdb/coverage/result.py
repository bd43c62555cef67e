"""The result of a scan: counts of all parts summed, resolved and written as one long table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby, pairwise
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from lipdb.coverage.archive import Archive
from lipdb.coverage.counts import FINDINGS, Counts, metadata_of, read_metadata
from lipdb.coverage.findings import REASONS
from lipdb.coverage.resolve import RESULT, Resolved, resolve
from lipdb.coverage.scan import Counted, Place
from lipdb.files import whole_file
from lipdb.phones.phoneset import PhoneSet

AT_ONCE = 4_000_000
"""Rows of counts that are summed at once: what bounds the memory, whatever the corpus."""
MOST_FINDINGS = 10_000
"""Findings that a result lists by document; beyond, it has only their sums."""


@dataclass(frozen=True, eq=False)
class Summary:
    """What a result holds: totals, all *findings*, and the *error* of a fast count."""

    documents: int
    lines: int
    spoken: int
    pairs: int
    findings: pa.Table
    error: Mapping[str, Any]

    def by_reason(self) -> list[dict[str, Any]]:
        """The findings of all documents together, what was left out first, the most frequent first."""
        summed = self.findings.group_by("reason", use_threads=False).aggregate(
            [("count", "sum"), ("document", "count_distinct"), ("example", "min")]
        )
        rows = [
            {
                "reason": row["reason"],
                "left_out": REASONS[row["reason"]].left_out,
                "count": row["count_sum"],
                "unit": REASONS[row["reason"]].unit,
                "documents": row["document_count_distinct"],
                "meaning": REASONS[row["reason"]].meaning,
                "example": row["example_min"],
            }
            for row in summed.to_pylist()
        ]
        return sorted(rows, key=lambda row: (not row["left_out"], -row["count"], row["reason"]))


def write_result(
    counted: Counted,
    archive: Archive,
    phoneset: PhoneSet,
    notation: str,
    path: Path,
    metadata: Mapping[str, Any],
    *,
    error: Callable[[pa.Table], Mapping[str, Any]] | None = None,
) -> Summary:
    """Sum the counts of *counted*, resolve them by *phoneset* and write them to *path*, whole or not at all, with *metadata*.

    *notation* is that of the counter's labels; *error* makes of the sample what is to be told of a fast count's error. Raises
    `OutputError`; `OSError` or `ValueError` when kept counts are damaged: they are gone then, and counting again mends it.
    """
    rest = [counted.apart]
    documents = lines = spoken = pairs = 0
    with whole_file(path) as temporary, pq.ParquetWriter(temporary, RESULT, compression="zstd") as writer:
        for aligned, counts in _summed(counted.places, archive):
            resolved = _resolved(counts, phoneset, "" if aligned else notation)
            writer.write_table(resolved.pairs)
            rest.append(Counts.of(findings=pa.concat_tables([counts.findings, resolved.findings]), sample=counts.sample))
            documents += len(counts.documents)
            lines, spoken = lines + _total(counts.documents["lines"]), spoken + _total(counts.documents["spoken"])
            pairs += _total(resolved.pairs["count"])
        left = Counts.sum(rest)
        wrong = dict(error(left.sample)) if error and len(left.sample) else {}
        summary = Summary(documents, lines, spoken, pairs, left.findings, wrong)
        totals = {"documents": documents, "lines": lines, "spoken": spoken, "pairs": pairs}
        listed = left.findings.to_pylist() if len(left.findings) <= MOST_FINDINGS else []
        told = {**metadata, **totals, **wrong, "findings": summary.by_reason(), "findings_by_document": listed}
        writer.add_key_value_metadata(metadata_of(told))
    return summary


def read_result(path: Path) -> dict[str, Any]:
    """What a result's file tells beside its table."""
    return read_metadata(pq.read_metadata(path).metadata or {})


def _resolved(counts: Counts, phoneset: PhoneSet, notation: str) -> Resolved:
    """Alignments may each have a notation of their own, so they are resolved one by one."""
    if notation:
        return resolve(counts.pairs, phoneset, notation)
    each = [resolve(counts.pairs.filter(pc.equal(counts.pairs["document"], name)), phoneset, "") for name in counts.documents["document"]]
    return Resolved(
        pa.concat_tables([RESULT.empty_table(), *(one.pairs for one in each)]),
        pa.concat_tables([FINDINGS.empty_table(), *(one.findings for one in each)]),
    )


def _summed(places: list[Place], archive: Archive) -> Iterator[tuple[bool, Counts]]:
    """The counts of all *places*, document by document in order, as many at once as `AT_ONCE` allows; whether they are aligned."""
    for (aligned, unnamed), group in groupby(sorted(places, key=_order), key=lambda place: (place.aligned, bool(place.document))):
        of = list(group)
        parts = _by_file(of, archive) if unnamed else _by_range(of, archive)
        yield from ((aligned, counts) for counts in parts)


def _order(place: Place) -> tuple[bool, bool, str, int, int]:
    return place.aligned, bool(place.document), place.document, place.source, place.part


def _by_file(places: list[Place], archive: Archive) -> Iterator[Counts]:
    """Whole documents, some files at once."""
    named = (
        _sum(archive.read(place.key) for place in parts).named(document)
        for document, parts in groupby(places, key=lambda place: place.document)
    )
    yield from map(Counts.sum, _batches(named))


def _by_range(places: list[Place], archive: Archive) -> Iterator[Counts]:
    """Documents that any part may tell of: in ranges of their names, each range from all parts."""
    rows, names = 0, set[str]()
    for place in places:
        column = archive.read(place.key).documents["document"]
        rows += archive.rows(place.key)
        names.update(column.to_pylist()[:: max(1, len(column) // 100)])
    ordered, ranges = sorted(names), rows // AT_ONCE + 1
    edges = ["", *(ordered[len(ordered) * k // ranges] for k in range(1, ranges)), None]
    for low, high in pairwise(edges):
        yield _sum(archive.read(place.key).between(low or "", high) for place in places)


def _sum(parts: Iterable[Counts]) -> Counts:
    """The sum of *parts*, with only some of them in memory."""
    total = Counts.of()
    for some in _batches(parts):
        total = Counts.sum([total, *some])
    return total


def _batches(parts: Iterable[Counts]) -> Iterator[list[Counts]]:
    """*parts* in lists of about `AT_ONCE` rows."""
    some, rows = list[Counts](), 0
    for part in parts:
        some.append(part)
        rows += len(part.pairs)
        if rows > AT_ONCE:
            yield some
            some, rows = [], 0
    if some:
        yield some


def _total(column: pa.ChunkedArray) -> int:
    return pc.sum(column).as_py() or 0
