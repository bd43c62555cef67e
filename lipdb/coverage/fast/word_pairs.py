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
    document = lines.document[found.line] if len(lines.names) > 1 else np.zeros(len(found), np.int32)
    edges = np.flatnonzero(np.diff(document, prepend=-1, append=-1)) if len(found) else np.zeros(1, np.int64)
    if len(found) < _LARGE * (len(edges) - 1):
        return _small(lines, found, document, forms)
    tables = [
        _table(lines.names[document[first]], _matrix(found.part(first, last), forms), forms.lexicon.readings)
        for first, last in pairwise(edges.tolist())
    ]
    return pa.concat_tables([PAIRS.empty_table(), *tables])


def _matrix(found: Running, forms: Forms) -> NDArray[np.int64]:
    """How often each label stands in front of each in one document, of shape (labels, labels)."""
    table = forms.lexicon.readings
    size = len(table.names)
    count = np.zeros(size * size, np.int64)
    said: list[Numbers] = []
    for part in found.parts(_AT_ONCE):
        readings, behind = forms.said(part)
        outer = table.outer[readings]
        count += _across(outer >> 16, outer & 0xFFFF, behind, size)
        said.append(readings)
    often = np.bincount(np.concatenate(said))
    there = np.flatnonzero(often)
    labels, owner = _spelled_out(there, table)
    inner = owner[1:] == owner[:-1]
    within = np.bincount(labels[:-1][inner] * size + labels[1:][inner], often[there][owner[1:][inner]], minlength=size * size)
    return (count + within.astype(np.int64)).reshape(size, size)


def _across(first: Numbers, last: Numbers, behind: NDArray[np.uint8], size: int) -> NDArray[np.int64]:
    """The pairs between words with these outer labels, and between them and the silence around them."""
    flows = behind[:-1] == FLOWS
    count = np.bincount(last[:-1] * size + first[1:] * flows, minlength=size * size)
    count += np.bincount(first[1:][~flows], minlength=size * size)
    count[[first[0], last[-1] * size]] += 1
    return count


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


def _small(lines: Lines, found: Running, document: Numbers, forms: Forms) -> pa.Table:
    """The pairs of many small documents: every label is written out."""
    readings, behind = forms.said(found)
    table = forms.lexicon.readings
    labels, owner = _spelled_out(readings, table)
    opens = np.diff(found.line, prepend=-1) > 0
    # A silence in front of every line, and one behind every pause and line.
    before, after = np.flatnonzero(opens), np.flatnonzero(behind != FLOWS)
    places = np.concatenate([np.searchsorted(owner, after, side="right"), np.searchsorted(owner, before)])
    owners = np.insert(owner, places, np.concatenate([after, before]))
    return pair_table(lines, document[owners], np.insert(labels, places, 0), list(table.names))
