"""Which of its readings a word has at its place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.fast.context import CONSONANT, KINDS, PAUSE, PLACES, VOWEL, Context
from lipdb.coverage.fast.lexicon import Lexicon
from lipdb.coverage.fast.readings import Numbers
from lipdb.coverage.fast.running import FLOWS, PAUSES, Running
from lipdb.coverage.fast.words import cut
from lipdb.speech.voice import Voice

# What a word is to its neighbours: to the one in front (`VOWEL` or `CONSONANT`), to the one behind (the same, shifted), and more.
_BEGINS, _ENDS, _PAUSES_BEFORE, _FLOWS_AFTER = 0b11, 0b1100, 16, 32
_SHIFT = 2


class Forms:
    """The readings of a lexicon's words by what stands before and behind them, as *context* says."""

    def __init__(self, lexicon: Lexicon, context: Context) -> None:
        self.lexicon = lexicon
        self.context = context
        self._learned = _numbers(lexicon, [word for word, _, _ in context.readings]) * PLACES
        self._learned += np.array([place for _, place, _ in context.readings], np.int64)
        self._learned_readings = lexicon.readings.number(pa.array([reading for _, _, reading in context.readings], pa.string()))
        self._pauses = _numbers(lexicon, [*context.pauses_before, *context.flows_after])
        self._marks = np.repeat(np.array([_PAUSES_BEFORE, _FLOWS_AFTER], np.uint8), [len(context.pauses_before), len(context.flows_after)])
        self._places = _places(context)
        self._variants: Numbers = np.zeros((0, PLACES), np.int32)
        self._varied = 0  # Words whose readings have their variants.
        self._readings: Numbers = np.zeros(0, np.int32)
        self._traits: NDArray[np.uint8] = np.zeros(0, np.uint8)

    def arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """All that `of` needs of the present words: arrays of one dimension, and plain data."""
        self._grow()
        arrays, told = self.lexicon.arrays()
        return {**arrays, "variants": self._variants.reshape(-1)}, told

    @classmethod
    def of(cls, voice: Voice, context: Context, arrays: dict[str, NDArray[Any]], told: dict[str, Any]) -> Self:
        """The forms that `arrays` gave, of the same *voice* in the same *context*."""
        lexicon, variants = Lexicon(voice), arrays.pop("variants").reshape(-1, PLACES)
        lexicon.restore(arrays, told)
        count = len(lexicon)
        forms = cls(lexicon, context)
        forms._variants, forms._varied = variants, count
        return forms

    def said(self, found: Running) -> tuple[Numbers, NDArray[np.uint8]]:
        """The reading of every word of *found*, whole lines, and what is behind it when it is said."""
        if len(self._traits) < len(self.lexicon):
            self._grow()
        traits, behind = self._traits.take(found.words), found.behind
        if self._pauses.size:
            goes_on = (traits & _FLOWS_AFTER) * (behind == PAUSES)
            stops = (traits[1:] & _PAUSES_BEFORE) * (behind[:-1] == FLOWS)
            behind = np.where(goes_on, FLOWS, behind)
            behind[:-1][stops > 0] = PAUSES
        flows = behind[:-1] == FLOWS
        place = np.full(len(behind), PAUSE * KINDS + PAUSE, np.uint8)
        place[:-1] += (traits[1:] & _BEGINS) * flows
        place[1:] += ((traits[:-1] & _ENDS) >> _SHIFT) * flows * np.uint8(KINDS)
        return self._readings.take(found.words * PLACES + place), behind

    def _grow(self) -> None:
        """Make arrays for all words that the lexicon has by now."""
        count, table = len(self.lexicon), self.lexicon.readings
        alone = self.lexicon.reading[:count]
        self._vary(alone[self._varied :])
        self._varied = count
        self._readings = self._variants[alone].reshape(-1)
        self._readings[self._learned] = self._learned_readings
        begins, ends = (np.where(table.vowels[labels], VOWEL, CONSONANT) for labels in (table.first[alone], table.outer[alone] & 0xFFFF))
        self._traits = (begins + (ends << _SHIFT)).astype(np.uint8)
        np.bitwise_or.at(self._traits, self._pauses, self._marks)

    def _vary(self, alone: Numbers) -> None:
        """Enter what the rules make of the readings *alone* of new words."""
        table = self.lexicon.readings
        different = np.unique(alone)
        heads, tails = (table.label_numbers(sorted({label for label, _, _ in rules})) for rules in (self.context.heads, self.context.tails))
        ruled = different[np.isin(table.first[different], heads) | np.isin(table.outer[different] & 0xFFFF, tails)]
        texts = [table.spelled(reading) for reading in ruled.tolist()]
        varied = np.repeat(ruled[:, None].astype(np.int32), PLACES, axis=1)
        for places in self._places:
            varied[:, places] = table.number(pa.array([self.context.usual(reading, places[0]) for reading in texts], pa.string()))[:, None]
        more = np.arange(len(self._variants), len(table), dtype=np.int32)
        self._variants = np.concatenate([self._variants, np.repeat(more[:, None], PLACES, axis=1)])
        self._variants[ruled] = varied


def _places(context: Context) -> list[list[int]]:
    """The places at which rules change readings, those together at which all do the same."""
    alike: dict[tuple[int | None, int | None], list[int]] = {}
    kinds = [{kind for _, kind, _ in rules} for rules in (context.heads, context.tails)]
    for place in range(PLACES):
        before, behind = (kind if kind in ruled else None for kind, ruled in zip(divmod(place, KINDS), kinds, strict=True))
        alike.setdefault((before, behind), []).append(place)
    alike.pop((None, None), None)
    return list(alike.values())


def _numbers(lexicon: Lexicon, texts: Sequence[str]) -> NDArray[np.int64]:
    return lexicon.words(cut(pa.array(texts, pa.string())))
