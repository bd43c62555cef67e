"""From pairs of labels to pairs of common phones: the last step of a scan, the only one that a changed mapping repeats."""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from itertools import groupby, pairwise

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from lipdb.coverage.counts import FINDINGS
from lipdb.coverage.findings import UNKNOWN
from lipdb.curated.tsv import Records
from lipdb.phones.phoneset import PhoneSet
from lipdb.schedule import MICROSECONDS, SILENCE, Phone, Schedule

RESULT = pa.schema([(name, pa.string()) for name in ("document", "source_left", "source_right", "left", "right")] + [("count", pa.int64())])
"""A scan's long table: the phones of the language's own notation and the common phones that follow each other in them."""

_KEYS = RESULT.names[:-1]
# What decides which phones labels stand for, and which common phones those are: tables with their columns.
_DECIDING = {
    "{}/language.tsv": ("notation",),
    "{}/phones.tsv": ("phone", "common"),
    "{}/aliases.tsv": ("notation", "symbol", "phones"),
    "{}/syllables.tsv": ("syllable", "phones"),
    "ipa.tsv": ("phone", "common", "xsampa"),
    "marks.tsv": ("mark",),
    "common.tsv": ("phone",),
}
Unit = tuple[str, str]
"""A phone of the language, and one of its common phones."""


def mapping_digest(records: Records, language: str) -> str:
    """A digest of what decides how *language*'s labels become common phones; comments and provenance do not."""
    digest = hashlib.sha256()
    for path, columns in _DECIDING.items():
        rows = sorted([row.get(name, "") for name in columns] for row in records.get(path.format(language), {}).values())
        digest.update(json.dumps([path, rows], ensure_ascii=False).encode())
    return digest.hexdigest()[:16]


@dataclass(frozen=True)
class Resolved:
    """Pairs of common phones (of `RESULT`, sorted), and labels that no table knows, as findings."""

    pairs: pa.Table
    findings: pa.Table


def resolve(pairs: pa.Table, phoneset: PhoneSet, notation: str) -> Resolved:
    """*pairs* of labels as pairs of common phones; a label of several phones adds the pairs within it.

    *notation* is that of the labels; empty, it is found by the labels themselves. Unknown labels are mapped by articulation and
    reported; neighbouring silences are one.
    """
    encoded = pa.chunked_array([*pairs["left"].chunks, *pairs["right"].chunks], pa.string()).combine_chunks().dictionary_encode()
    labels = encoded.dictionary.to_pylist()
    if not labels:
        return Resolved(RESULT.empty_table(), FINDINGS.empty_table())
    codes = encoded.indices.to_numpy()
    left, right = codes[: len(pairs)], codes[len(pairs) :]
    units, unknown = units_of(labels, phoneset, notation)
    names = sorted({unit for row in units for unit in row})
    index = {unit: k for k, unit in enumerate(names)}
    first, last = (np.array([index[row[end]] for row in units]) for end in (0, -1))
    across = _table(pairs["document"], last[left], first[right], pairs["count"], names)
    count = pairs["count"].to_numpy()
    return Resolved(
        _summed([across, *_within(pairs["document"], left, count, units, names, index)]), _reported(pairs, left, unknown, labels)
    )


def units_of(labels: list[str], phoneset: PhoneSet, notation: str) -> tuple[list[list[Unit]], dict[str, str]]:
    """What each of *labels* stands for, and why for those that no table knows, which are mapped by articulation."""
    # A second each, and its index as the word: so it can be told which phones came of which label.
    edges = tuple(range(0, (len(labels) + 1) * MICROSECONDS, MICROSECONDS))
    raw = Schedule(edges, tuple(Phone(label, word=k) for k, label in enumerate(labels)), phoneset.language, notation)
    schedule, unknown = phoneset.resolve(raw, allow_unknown=True)
    units = [
        [(phone.symbol, common) for phone in phones for common in phone.common]
        for _, phones in groupby(schedule.phones, key=lambda phone: phone.word)
    ]
    return units, {one.symbol: f"{one.symbol}: {f'nearest {one.proposal}, ' if one.proposal else ''}{one.reason}" for one in unknown}


def _within(
    document: pa.ChunkedArray,
    left: NDArray[np.int64],
    count: NDArray[np.int64],
    units: list[list[Unit]],
    names: list[Unit],
    index: dict[Unit, int],
) -> list[pa.Table]:
    """The pairs within labels. Each label that is said stands once on the left, be it before silence."""
    tables = []
    for label, row in enumerate(units):
        if len(row) > 1:
            places = np.flatnonzero(left == label)
            of, times = document.take(pa.array(places)), count[places]
            for one, following in pairwise(row):
                first, second = (np.full(len(places), index[unit]) for unit in (one, following))
                tables.append(_table(of, first, second, pa.chunked_array([times]), names))
    return tables


def _table(
    document: pa.ChunkedArray, left: NDArray[np.int64], right: NDArray[np.int64], count: pa.ChunkedArray, names: list[Unit]
) -> pa.Table:
    source, common = (pa.array([unit[k] for unit in names], pa.string()) for k in (0, 1))
    at, then = pa.array(left), pa.array(right)
    return pa.table([document, source.take(at), source.take(then), common.take(at), common.take(then), count], schema=RESULT)


def _summed(tables: list[pa.Table]) -> pa.Table:
    table = pa.concat_tables(tables)
    silent = pc.and_(pc.equal(table["left"], SILENCE), pc.equal(table["right"], SILENCE))
    summed = table.filter(pc.invert(silent)).group_by(_KEYS, use_threads=False).aggregate([("count", "sum")])
    return summed.rename_columns(RESULT.names).sort_by([(name, "ascending") for name in _KEYS]).combine_chunks()


def _reported(pairs: pa.Table, left: NDArray[np.int64], unknown: dict[str, str], labels: list[str]) -> pa.Table:
    """A finding for each unknown label in each document, with how often it came."""
    rows = []
    for label, why in unknown.items():
        found = pairs.filter(pa.array(left == labels.index(label)))
        counts = found.group_by("document").aggregate([("count", "sum")])
        rows += [(row["document"], UNKNOWN, row["count_sum"], why) for row in counts.to_pylist()]
    return pa.table([list(column) for column in zip(*rows, strict=True)] if rows else [[]] * 4, schema=FINDINGS)
