"""Ways in which words are said: a growing table of runs of labels, as arrays in which many words are looked up at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
from numpy.typing import NDArray

from lipdb.phones.segments import read_segment
from lipdb.schedule import SILENCE

Numbers = NDArray[np.int32]


class Readings:
    """Readings, numbered as they come: labels between spaces, ``_`` where the voice pauses within one.

    Reading 0 is the empty one, label 0 is ``_``.

    * *labels* of all readings, one after another; reading *i* has ``labels[starts[i] : starts[i + 1]]``
    * *first*: the first label of each reading, 0 for the empty one
    * *outer*: the first and, in the lower 16 bits, the last label of each
    * *vowels*: whether each label is, or begins with, a vowel
    """

    def __init__(self) -> None:
        self.names: list[str] = [SILENCE]
        self.vowels: NDArray[np.bool_] = np.zeros(1, bool)
        self.labels: Numbers = np.zeros(0, np.int32)
        self.starts: NDArray[np.int64] = np.zeros(2, np.int64)
        self.first: Numbers = np.zeros(1, np.int32)
        self.outer: Numbers = np.zeros(1, np.int32)
        self._numbers = {"": 0}
        self._label_numbers = {SILENCE: 0}

    def __len__(self) -> int:
        return len(self.first)

    def arrays(self) -> dict[str, NDArray[np.integer]]:
        """All that `of` needs beside *names*."""
        return {"labels": self.labels, "starts": self.starts, "first": self.first, "outer": self.outer}

    @classmethod
    def of(cls, names: Sequence[str], **arrays: NDArray[Any]) -> Self:
        """Readings from their labels' *names* and what `arrays` gave."""
        table = cls()
        table.label_numbers(names)
        vars(table).update(arrays)
        return table

    def number(self, readings: pa.StringArray) -> Numbers:
        """The numbers of *readings*; those that are new are added."""
        encoded = readings.dictionary_encode()
        different = encoded.dictionary.to_pylist()
        new = [i for i, reading in enumerate(different) if reading not in self._numbers]
        if new:
            self._numbers |= {different[i]: len(self) + k for k, i in enumerate(new)}
            self._add(encoded.dictionary.take(pa.array(new)))
        numbers = np.array([self._numbers[reading] for reading in different], np.int32)
        found: Numbers = numbers[encoded.indices.to_numpy()]
        return found

    def number_many(self, readings: pa.StringArray) -> Numbers:
        """As `number`, quicker for very many: they get numbers of their own even if they are there already."""
        encoded = readings.dictionary_encode()
        said = pc.not_equal(encoded.dictionary, "").to_numpy(zero_copy_only=False)
        numbers = np.where(said, len(self) - 1 + np.cumsum(said), 0).astype(np.int32)
        self._add(encoded.dictionary.filter(pa.array(said)))
        found: Numbers = numbers[encoded.indices.to_numpy()]
        return found

    def spelled(self, number: int) -> str:
        """Reading *number* as labels between spaces."""
        return " ".join(self.names[label] for label in self.run(number).tolist())

    def run(self, number: int) -> Numbers:
        """The labels of reading *number*."""
        return self.labels[self.starts[number] : self.starts[number + 1]]

    def label_numbers(self, labels: Sequence[str]) -> Numbers:
        """The numbers of single *labels*; those that are new are added."""
        new = [label for label in dict.fromkeys(labels) if label not in self._label_numbers]
        if new:
            self._label_numbers |= {label: len(self.names) + i for i, label in enumerate(new)}
            self.names = [*self.names, *new]
            self.vowels = np.append(self.vowels, [_is_vowel(label) for label in new])
        return np.array([self._label_numbers[label] for label in labels], np.int32)

    def _add(self, readings: pa.StringArray) -> None:
        if not len(readings):
            return
        runs = pc.split_pattern(readings, " ")
        encoded = runs.flatten().dictionary_encode()
        labels = self.label_numbers(encoded.dictionary.to_pylist())[encoded.indices.to_numpy()]
        ends = np.cumsum(pc.list_value_length(runs).to_numpy())
        self.labels = np.concatenate([self.labels, labels])
        self.starts = np.concatenate([self.starts, self.starts[-1] + ends])
        first = labels[np.append(0, ends[:-1])]
        self.first = np.concatenate([self.first, first])
        self.outer = np.concatenate([self.outer, (first << 16) + labels[ends - 1]])


def _is_vowel(label: str) -> bool:
    letters = read_segment(label).letters
    return bool(letters) and letters[0].vowel
