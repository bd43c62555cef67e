"""Lines of text as runs of words that a lexicon knows, and what stands between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.fast.lexicon import Lexicon, Masks, mask_of
from lipdb.coverage.fast.words import Places, cut, spans_of
from lipdb.coverage.findings import NO_WORDS, REASONS

FLOWS, PAUSES, ENDS = range(3)
"""What the gap behind a word says: go on, pause, the line ends."""
LEFT_OUT = np.uint32(mask_of(reason for reason, what in REASONS.items() if what.left_out and reason != NO_WORDS))
"""A line with such a word is left out, as the voice would not say it."""
AT_ONCE = 1 << 20
"""Bytes that are cut at once: what numpy makes of them stays in the processor's cache."""


@dataclass(frozen=True)
class Running:
    """The *n* words of some lines that have a reading: *words* (numbers in the lexicon), what is *behind* each, its *line*.

    *remarks* is a mask for each line, of what there is to remark about its words. Lines that are left out have no words here.
    *unread* are lines with signs that the voice may not read.
    """

    words: Places
    behind: NDArray[np.uint8]
    line: NDArray[np.int32]
    remarks: Masks
    unread: Places

    def __len__(self) -> int:
        return len(self.words)

    def part(self, first: int, last: int) -> Running:
        """The words from *first* to *last*; remarks are of all lines."""
        return Running(self.words[first:last], self.behind[first:last], self.line[first:last], self.remarks, self.unread)

    def parts(self, size: int) -> Iterator[Running]:
        """The words in parts of about *size*, each of whole lines."""
        ends = np.flatnonzero(self.behind == ENDS) + 1
        chosen = ends[np.searchsorted(ends, range(size, len(self), size))]
        for first, last in pairwise([0, *dict.fromkeys(chosen.tolist()), len(self)]):
            if first < last:
                yield self.part(first, last)


def running(lexicon: Lexicon, texts: pa.StringArray, asked: Callable[[], None] = lambda: None) -> Running:
    """*texts*, one line each, as *lexicon* reads their words.

    It asks the voice for those that are new to it; *asked* is called now and then, for the answers to be shared.
    """
    _, starts, _ = spans_of(texts)
    edges = [*np.searchsorted(starts, range(0, starts[-1] + 1, AT_ONCE)).tolist(), len(texts)] if len(texts) else [0, 0]
    parts = []
    for first, last in pairwise(edges):
        parts.append(_running(lexicon, texts[first:last], first))
        asked()
    return Running(*(np.concatenate(columns) for columns in zip(*parts, strict=True)))


def _running(lexicon: Lexicon, texts: pa.StringArray, first: int) -> tuple[Places, NDArray[np.uint8], NDArray[np.int32], Masks, Places]:
    """The fields of `Running` for *texts*, whose lines are numbered from *first*."""
    words = cut(texts)
    numbers = lexicon.words(words)
    counts = np.diff(np.append(words.lines, len(words)))
    line = np.repeat(np.arange(len(texts), dtype=np.int32), counts)
    behind = np.zeros(len(words), np.uint8)
    behind[words.lines[counts > 0] + counts[counts > 0] - 1] = ENDS
    places = words.wide_gaps()
    places = places[behind[places] == FLOWS]
    behind[places] = lexicon.gaps(words, places)
    remarks = np.zeros(len(texts), np.uint32)
    unusual = np.flatnonzero(lexicon.unusual.take(numbers))
    if unusual.size:
        np.bitwise_or.at(remarks, line[unusual], lexicon.remarks[numbers[unusual]])
        dropped = np.zeros(len(words), bool)
        dropped[unusual] = lexicon.reading[numbers[unusual]] == 0
        if (left_out := remarks & LEFT_OUT != 0).any():
            dropped |= left_out[line]
        if dropped.any():
            kept = np.flatnonzero(~dropped)
            # What stood behind a word that is not there stands behind the one in front of it.
            behind = np.maximum.reduceat(behind, kept) if kept.size else behind[:0]
            numbers, line = numbers[kept], line[kept]
    return numbers, behind, line + np.int32(first), remarks, words.unread + first
