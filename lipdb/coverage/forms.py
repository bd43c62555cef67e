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

# What a word is to its neighbours: `VOWEL` or `CONSONANT` to the one in front, and these.
_FOLLOWS, _PAUSES_BEFORE, _FLOWS_AFTER = 3, 4, 8


class Forms:
    """The readings of a lexicon's words by what follows them, as *context* says."""

    def __init__(self, lexicon: Lexicon, context: Context) -> None:
        self.lexicon = lexicon
        following = np.array([following for _, following, _ in context.readings], np.int64)
        self._learned = _numbers(lexicon, [text for text, _, _ in context.readings]) * FOLLOWING + following
        self._learned_readings = lexicon.readings.number(pa.array([reading for _, _, reading in context.readings], pa.string()))
        self._pauses = _numbers(lexicon, [*context.pauses_before, *context.flows_after])
        self._kinds = np.repeat(np.array([_PAUSES_BEFORE, _FLOWS_AFTER], np.uint8), [len(context.pauses_before), len(context.flows_after)])
        self._readings_of: Numbers = np.zeros(0, np.int32)
        self._traits: NDArray[np.uint8] = np.zeros(0, np.uint8)

    def said(self, found: Running) -> tuple[Numbers, NDArray[np.uint8]]:
        """The reading of every word of *found*, and what is behind it when it is said."""
        if len(self._readings_of) < len(self.lexicon) * FOLLOWING:
            self._grow()
        traits, behind = self._traits[found.words], found.behind
        if self._pauses.size:
            opens = (traits[1:] & _PAUSES_BEFORE) * (behind[:-1] == FLOWS)
            goes_on = (traits & _FLOWS_AFTER) * (behind == PAUSES)
            behind = np.where(goes_on, FLOWS, behind)
            behind[:-1][opens > 0] = PAUSES
        following = np.full(len(behind), PAUSE, np.uint8)
        following[:-1] = (traits[1:] & _FOLLOWS) * (behind[:-1] == FLOWS)
        return self._readings_of[found.words * FOLLOWING + following], behind

    def _grow(self) -> None:
        """Make arrays for all words that the lexicon has by now."""
        count, table = len(self.lexicon), self.lexicon.readings
        alone = self.lexicon.reading[:count]
        self._readings_of = np.repeat(alone, FOLLOWING)
        self._readings_of[self._learned] = self._learned_readings
        self._traits = np.where(table.vowels[table.first[alone]], VOWEL, CONSONANT).astype(np.uint8)
        np.bitwise_or.at(self._traits, self._pauses, self._kinds)


def _numbers(lexicon: Lexicon, texts: Sequence[str]) -> NDArray[np.int64]:
    return lexicon.words(cut(pa.array(texts, pa.string()))).astype(np.int64)
