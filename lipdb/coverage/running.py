"""Lines of text as runs of words that a lexicon knows, and what stands between them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.findings import NO_WORDS, REASONS
from lipdb.coverage.lexicon import Lexicon, Masks, mask_of
from lipdb.coverage.readings import Numbers
from lipdb.coverage.words import cut

FLOWS, PAUSES, ENDS = range(3)
"""What the gap behind a word says: go on, pause, the line ends."""
LEFT_OUT = np.uint32(mask_of(reason for reason, what in REASONS.items() if what.left_out and reason != NO_WORDS))
"""A line with such a word is left out, as the voice would not say it."""


@dataclass(frozen=True)
class Running:
    """The *n* words of some lines that have a reading: *words* (numbers in the lexicon), what is *behind* each, its *line*.

    *remarks* is a mask for each line, of what there is to remark about its words. Lines that are left out have no words here.
    """

    words: Numbers
    behind: NDArray[np.uint8]
    line: NDArray[np.int32]
    remarks: Masks

    def __len__(self) -> int:
        return len(self.words)


def running(lexicon: Lexicon, texts: pa.StringArray) -> Running:
    """*texts*, one line each, as *lexicon* reads their words. It asks the voice for those that are new to it."""
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
    remarked = np.flatnonzero(lexicon.remarks[numbers])
    np.bitwise_or.at(remarks, line[remarked], lexicon.remarks[numbers[remarked]])
    said = lexicon.reading[numbers] != 0
    if (remarks & LEFT_OUT).any():
        said &= (remarks & LEFT_OUT == 0)[line]
    kept = np.flatnonzero(said)
    if len(kept) < len(words):
        # What stood behind a word that is not there stands behind the one in front of it.
        behind = np.maximum.reduceat(behind, kept) if kept.size else behind[:0]
        numbers, line = numbers[kept], line[kept]
    return Running(numbers, behind, line, remarks)
