"""Pairs of labels from words: how often each reading stands, and which labels meet where words do.

A pair is either within a word, where the word's count is all that is needed, or across an edge, where only the last label of
one word and the first of the next matter. So there are two counts, of readings and of edges in a matrix of labels, and
never one of pairs of words.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.counts import PAIRS, Lines, pair_table
from lipdb.coverage.fast.forms import Forms
from lipdb.coverage.fast.readings import Numbers, Readings
from lipdb.coverage.fast.running import FLOWS, Running

_AT_ONCE = 1 << 17  # Words: what numpy makes of them stays in the processor's cache.
_LARGE = 20_000  # Words. Documents of more are counted one by one, smaller ones all at once.


def pairs_of(lines: Lines, found: Running, forms: Forms) -> pa.Table:
    """The pairs of labels in *found*, the words of *lines*, by document."""
    if not len(found):
        return PAIRS.empty_table()
    names, edges = list(lines.names), [0, len(found)]
    if len(names) > 1:
        document = lines.document[found.line]
        edges = np.flatnonzero(np.diff(document, prepend=-1, append=-1)).tolist()
        names = [names[number] for number in document[edges[:-1]].tolist()]
    if len(found) < _LARGE * len(names):
        return _small(lines, found, forms)
    return pa.concat_tables(
        _table(name, _matrix(found.part(first, last), forms), forms.lexicon.readings)
        for name, (first, last) in zip(names, pairwise(edges), strict=True)
    )


def _matrix(found: Running, forms: Forms) -> NDArray[np.int64]:
    """How often each label stands in front of each in one document, of shape (labels, labels)."""
    table = forms.lexicon.readings
    size = len(table.names)
    count = np.zeros(size * size, np.int64)
    said: list[Numbers] = []
    for part in found.parts(_AT_ONCE):
        readings, behind = forms.said(part)
        count += _across(table.outer.take(readings), behind, size)
        said.append(readings)
    often = np.bincount(np.concatenate(said))
    there = np.flatnonzero(often)
    matrix = count.reshape(size, size)
    # In front of a word that no other flows into stands a silence.
    first = np.bincount(table.first[there], often[there], size).astype(np.int64)
    matrix[0, 1:] = (first - matrix.sum(axis=0))[1:]
    labels, owner = _spelled_out(there, table)
    inner = owner[1:] == owner[:-1]
    within = np.bincount(labels[:-1][inner] * size + labels[1:][inner], often[there][owner[1:][inner]], minlength=size * size)
    return matrix + within.astype(np.int64).reshape(size, size)


def _across(outer: Numbers, behind: NDArray[np.uint8], size: int) -> NDArray[np.int64]:
    """The pairs between words with these *outer* labels, and of their last labels and the silence behind them."""
    pairs = (outer & 0xFFFF) * size
    pairs[:-1] += (outer[1:] >> 16) * (behind[:-1] == FLOWS)
    return np.bincount(pairs, minlength=size * size)


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


def _small(lines: Lines, found: Running, forms: Forms) -> pa.Table:
    """The pairs of many small documents: every label is written out."""
    readings, behind = forms.said(found)
    table = forms.lexicon.readings
    labels, owner = _spelled_out(readings, table)
    opens = np.diff(found.line, prepend=-1) > 0
    # A silence in front of every line, and one behind every pause and line.
    before, after = np.flatnonzero(opens), np.flatnonzero(behind != FLOWS)
    places = np.concatenate([np.searchsorted(owner, after, side="right"), np.searchsorted(owner, before)])
    owners = np.insert(owner, places, np.concatenate([after, before]))
    return pair_table(lines, lines.document[found.line[owners]], np.insert(labels, places, 0), list(table.names))
