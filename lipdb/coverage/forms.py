"""Which of its readings a word has at its place."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.context import CONSONANT, FOLLOWING, PAUSE, VOWEL, Context
from lipdb.coverage.lexicon import Lexicon
from lipdb.coverage.readings import Numbers
from lipdb.coverage.running import FLOWS, PAUSES, Running
from lipdb.coverage.words import cut


class Forms:
    """The readings of a lexicon's words by what follows them, as *context* says."""

    def __init__(self, lexicon: Lexicon, context: Context) -> None:
        self.lexicon = lexicon
        self._forms = _numbers(lexicon, [text for text, _, _ in context.readings]) * FOLLOWING
        self._forms += np.array([following for _, following, _ in context.readings], np.int64)
        self._readings = lexicon.readings.number([reading for _, _, reading in context.readings])
        self._before = _numbers(lexicon, context.pauses_before)
        self._after = _numbers(lexicon, context.flows_after)
        self._grown = self._grow()

    def said(self, found: Running) -> tuple[Numbers, NDArray[np.uint8]]:
        """The reading of every word of *found*, and what is behind it when it is said."""
        reading, follows, before, after = self._current()
        words, behind = found.words, found.behind
        if self._before.size or self._after.size:
            opens = np.append(before[words[1:]] & (behind[:-1] == FLOWS), False) if len(words) else np.zeros(0, bool)
            behind = np.where(opens, PAUSES, np.where(after[words] & (behind == PAUSES), FLOWS, behind)).astype(np.uint8)
        following = np.full(len(words), PAUSE, np.int32)
        following[:-1] = np.where(behind[:-1] == FLOWS, follows[words[1:]], PAUSE)
        return reading[words * FOLLOWING + following], behind

    def _current(self) -> tuple[Numbers, NDArray[np.uint8], NDArray[np.bool_], NDArray[np.bool_]]:
        if len(self._grown[1]) < len(self.lexicon):
            self._grown = self._grow()
        return self._grown

    def _grow(self) -> tuple[Numbers, NDArray[np.uint8], NDArray[np.bool_], NDArray[np.bool_]]:
        """Arrays for all words that the lexicon has by now: readings (three a word), what each is to the word in front, pauses."""
        count, table = len(self.lexicon), self.lexicon.readings
        alone = self.lexicon.reading[:count]
        reading = np.repeat(alone, FOLLOWING)
        reading[self._forms] = self._readings
        follows = np.where(table.vowels[table.first[alone]], VOWEL, CONSONANT).astype(np.uint8)
        before, after = np.zeros(count, bool), np.zeros(count, bool)
        before[self._before], after[self._after] = True, True
        return reading, follows, before, after


def _numbers(lexicon: Lexicon, texts: Sequence[str]) -> NDArray[np.int64]:
    return lexicon.words(cut(pa.array(texts, pa.string()))).astype(np.int64)
