"""Pairs of labels from words: how often each reading stands, and which labels meet where words do.

A pair is either within a word, where the word's count is all that is needed, or across an edge, where only the last label of
one word and the first of the next matter. So there are two counts, of readings and of edges in a matrix of labels, and
never one of pairs of words.
"""

from __future__ import annotations

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.counts import PAIRS, Lines, pair_table
from lipdb.coverage.forms import Forms
from lipdb.coverage.readings import Numbers, Readings
from lipdb.coverage.running import FLOWS, Running

_LARGE = 20_000  # Words. Documents of more are counted one by one, smaller ones all at once.


def pairs_of(lines: Lines, found: Running, forms: Forms) -> pa.Table:
    """The pairs of labels in *found*, the words of *lines*, by document."""
    readings, behind = forms.said(found)
    table = forms.lexicon.readings
    document = lines.document[found.line]
    edges = np.flatnonzero(np.diff(document, prepend=-1, append=-1)) if len(found) else np.zeros(1, np.int64)
    if len(found) < _LARGE * (len(edges) - 1):
        return _small(lines, found, document, readings, behind, table)
    parts = [
        _table(lines.names[document[first]], _matrix(readings[first:last], behind[first:last], table), table)
        for first, last in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True)
    ]
    return pa.concat_tables([PAIRS.empty_table(), *parts])


def _matrix(readings: Numbers, behind: NDArray[np.uint8], table: Readings) -> NDArray[np.int64]:
    """How often each label stands in front of each in one document, of shape (labels, labels)."""
    first, last = table.first[readings], table.last[readings]
    size = len(table.names)
    flows = behind[:-1] == FLOWS
    across = np.bincount(last[:-1] * size + first[1:] * flows, minlength=size * size)
    across += np.bincount(first[1:][~flows], minlength=size * size)
    across[[first[0], last[-1] * size]] += 1
    count = np.bincount(readings)
    there = np.flatnonzero(count)
    labels, owner = _spelled_out(there, table)
    inner = owner[1:] == owner[:-1]
    weights = count[there][owner[1:][inner]]
    within = np.bincount(labels[:-1][inner] * size + labels[1:][inner], weights, minlength=size * size)
    return (across + within.astype(np.int64)).reshape(size, size)


def _spelled_out(readings: NDArray[np.integer], table: Readings) -> tuple[Numbers, NDArray[np.int64]]:
    """The labels of *readings*, one after another, and the index of the reading that each is of."""
    starts = table.starts[readings]
    lengths = table.starts[readings + 1] - starts
    owner = np.repeat(np.arange(len(readings)), lengths)
    begins = np.cumsum(lengths) - lengths
    return table.labels[np.arange(len(owner)) + (starts - begins)[owner]], owner


def _table(name: str, matrix: NDArray[np.int64], table: Readings) -> pa.Table:
    """The pairs of one document."""
    left, right = np.nonzero(matrix)
    names = pa.array(table.names, pa.string())
    document = pa.repeat(pa.scalar(name), len(left))
    return pa.table([document, names.take(pa.array(left)), names.take(pa.array(right)), pa.array(matrix[left, right])], schema=PAIRS)


def _small(lines: Lines, found: Running, document: Numbers, readings: Numbers, behind: NDArray[np.uint8], table: Readings) -> pa.Table:
    """The pairs of many small documents: every label is written out."""
    labels, owner = _spelled_out(readings, table)
    opens = np.diff(found.line, prepend=-1) > 0
    # A silence in front of every line, and one behind every pause and line.
    before, after = np.flatnonzero(opens), np.flatnonzero(behind != FLOWS)
    places = np.concatenate([np.searchsorted(owner, after, side="right"), np.searchsorted(owner, before)])
    owners = np.insert(owner, places, np.concatenate([after, before]))
    return pair_table(lines, document[owners], np.insert(labels, places, 0), list(table.names))
