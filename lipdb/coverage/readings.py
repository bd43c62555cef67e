"""Ways in which words are said: a growing table of runs of labels, as arrays in which many words are looked up at once."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from lipdb.phones.segments import read_segment
from lipdb.schedule import SILENCE

Numbers = NDArray[np.int32]


class Readings:
    """Distinct readings, numbered as they come: labels between spaces, ``_`` where the voice pauses within one.

    Reading 0 is the empty one, label 0 is ``_``.

    * *labels* of all readings, one after another; reading *i* has ``labels[starts[i] : starts[i + 1]]``
    * *first* and *last*: the outer labels of each reading, 0 for the empty one
    * *vowels*: whether each label is, or begins with, a vowel
    """

    def __init__(self) -> None:
        self.names: list[str] = [SILENCE]
        self.vowels: NDArray[np.bool_] = np.zeros(1, bool)
        self.labels: Numbers = np.zeros(0, np.int32)
        self.starts: NDArray[np.int64] = np.zeros(2, np.int64)
        self.first: Numbers = np.zeros(1, np.int32)
        self.last: Numbers = np.zeros(1, np.int32)
        self._numbers = {"": 0}
        self._label_numbers = {SILENCE: 0}

    def __len__(self) -> int:
        return len(self._numbers)

    def number(self, readings: Sequence[str]) -> Numbers:
        """The numbers of *readings*; those that are new are added."""
        new = [reading for reading in dict.fromkeys(readings) if reading not in self._numbers]
        if new:
            self._add([reading.split(" ") for reading in new])
            self._numbers |= {reading: len(self._numbers) + i for i, reading in enumerate(new)}
        return np.array([self._numbers[reading] for reading in readings], np.int32)

    def spelled(self, number: int) -> str:
        """Reading *number* as labels between spaces."""
        return " ".join(self.names[label] for label in self.labels[self.starts[number] : self.starts[number + 1]].tolist())

    def label_numbers(self, labels: Sequence[str]) -> Numbers:
        """The numbers of single *labels*; those that are new are added."""
        new = [label for label in dict.fromkeys(labels) if label not in self._label_numbers]
        if new:
            self._label_numbers |= {label: len(self.names) + i for i, label in enumerate(new)}
            self.names = [*self.names, *new]
            self.vowels = np.append(self.vowels, [_is_vowel(label) for label in new])
        return np.array([self._label_numbers[label] for label in labels], np.int32)

    def _add(self, runs: Sequence[Sequence[str]]) -> None:
        labels = self.label_numbers(list(chain.from_iterable(runs)))
        ends = np.cumsum([len(run) for run in runs])
        self.labels = np.concatenate([self.labels, labels])
        self.starts = np.concatenate([self.starts, self.starts[-1] + ends])
        self.first = np.concatenate([self.first, labels[np.append(0, ends[:-1])]])
        self.last = np.concatenate([self.last, labels[ends - 1]])


def _is_vowel(label: str) -> bool:
    letters = read_segment(label).letters
    return bool(letters) and letters[0].vowel
