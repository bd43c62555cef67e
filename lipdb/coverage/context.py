"""What running speech does to words, learned from sentences that the voice said whole.

By itself the voice says "the" with ə, "a" as the letter and "of" in full; in a sentence what follows decides. So a word has
up to three readings: before a vowel, before a consonant, and before a pause. Each sentence of a sample is laid beside the
readings of its words alone (`lipdb.coverage.align`), which gives every word the labels that were said for it; what is
heard most often stays. A word that the sample lacks keeps the reading that it has alone: such words are rare, and rare
words are said in full.

In the same way words are found before which the voice pauses without a mark ("and" in a long sentence), and words behind
which it does not pause in spite of one ("Mr. Smith").
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.align import align
from lipdb.coverage.lexicon import BREAK, Lexicon
from lipdb.coverage.readings import Numbers, Readings
from lipdb.coverage.running import PAUSES, Running, running
from lipdb.coverage.words import cut

Places = NDArray[np.int64]

PAUSE, VOWEL, CONSONANT = range(3)
"""What follows a word."""
FOLLOWING = 3
# What it costs to take one label for another: a vowel for a vowel, and so on; and to take none for it.
_VOWELS, _CONSONANTS, _UNLIKE, _SILENT, _SKIP = 1, 2, 6, 8, 3
NOBODY = -1
_SILENCE = np.zeros(1, np.int32)
_SURE = 2  # Times that the voice must do something to be believed that it always does.


@dataclass(frozen=True)
class Context:
    """What a sample taught: readings by word and by what follows it, and where pauses differ from what the gaps say."""

    readings: tuple[tuple[str, int, str], ...] = ()
    pauses_before: tuple[str, ...] = ()
    flows_after: tuple[str, ...] = ()

    @property
    def digest(self) -> str:
        """Changes with anything in it."""
        return hashlib.sha256(repr((self.readings, self.pauses_before, self.flows_after)).encode()).hexdigest()[:12]


def learn(lexicon: Lexicon, lines: Sequence[str]) -> Context:
    """What the voice does in *lines* that it does not do to their words alone."""
    found = running(lexicon, pa.array(lines, pa.string()))
    rows = np.split(np.arange(len(found)), np.searchsorted(found.line, np.arange(1, len(lines))))
    table = lexicon.readings
    spoken = [BREAK.join(lexicon.said(line).phrases).split() for line in lines]
    table.label_numbers([label for labels in spoken for label in labels])
    pairs = [(row, table.label_numbers(labels)) for row, labels in zip(rows, spoken, strict=True) if row.size and labels]
    alone = [_alone(lexicon, found, row) for row, _ in pairs]
    places = align([labels for labels, _ in alone], [labels for _, labels in pairs], _costs(table.vowels), skip=_SKIP)
    heard = Heard({}, Counter(), Counter())
    for (row, labels), (_, owners), place in zip(pairs, alone, places, strict=True):
        heard.add(found.words[row], found.behind[row] == PAUSES, labels, _owners(labels, owners, place), table)
    return heard.context(lexicon, _texts(lexicon, lines))


def _texts(lexicon: Lexicon, lines: Sequence[str]) -> dict[int, str]:
    """The words of *lines* by their numbers."""
    words = cut(pa.array(lines, pa.string()))
    numbers, places = np.unique(lexicon.words(words), return_index=True)
    return {number: words.word(place) for number, place in zip(numbers.tolist(), places.tolist(), strict=True)}


def _alone(lexicon: Lexicon, found: Running, row: Places) -> tuple[Numbers, Places]:
    """The labels of the words of one line, each as it is said alone, ``_`` where a gap says so; and whose each label is."""
    table = lexicon.readings
    labels, owners = list[Numbers](), list[int]()
    for i, word in enumerate(row.tolist()):
        number = lexicon.reading[found.words[word]]
        run = table.labels[table.starts[number] : table.starts[number + 1]]
        labels.append(run)
        owners += [i] * len(run)
        if found.behind[word] == PAUSES:
            labels.append(_SILENCE)
            owners.append(NOBODY)
    return np.concatenate(labels), np.array(owners)


def _costs(vowels: NDArray[np.bool_]) -> NDArray[np.int16]:
    costs = np.where(vowels[:, None] == vowels, _CONSONANTS, _UNLIKE).astype(np.int16)
    costs[np.ix_(vowels, vowels)] = _VOWELS
    costs[0] = costs[:, 0] = _SILENT
    np.fill_diagonal(costs, 0)
    return costs


def _owners(labels: Numbers, alone: Places, place: Places) -> list[int]:
    """Whose each of the *labels* of a line is. One that stands beside no label of a word alone is of the word in front."""
    owners = [NOBODY] * len(labels)
    for owner, at in zip(alone.tolist(), place.tolist(), strict=True):
        if at >= 0:
            owners[at] = owner
    current = 0
    for at, label in enumerate(labels.tolist()):
        if label and owners[at] == NOBODY:
            owners[at] = current
        elif label:
            current = owners[at]
    return owners


@dataclass
class Heard:
    """How often each word was read in each way, and the voice paused before or behind it where the gap says otherwise."""

    readings: dict[tuple[int, int], Counter[str]]
    before: Counter[tuple[int, bool]]
    behind: Counter[tuple[int, bool]]

    def add(self, words: Places, marked: NDArray[np.bool_], labels: Numbers, owners: Sequence[int], table: Readings) -> None:
        """Add one line: its *words*, whether the gap behind each is *marked* as a pause, and whose each label said is."""
        runs: list[list[int]] = [[] for _ in words]
        paused = [False] * len(words)
        last = NOBODY
        for at, (label, owner) in enumerate(zip(labels.tolist(), owners, strict=True)):
            if label:
                runs[owner].append(label)
                last = owner
            elif last != NOBODY and at + 1 < len(labels):
                if owners[at + 1] == last:
                    runs[last].append(0)
                else:
                    paused[last] = True
        following = PAUSE
        for i in range(len(words) - 1, -1, -1):
            word = int(words[i])
            if i + 1 < len(words):
                (self.behind if marked[i] else self.before)[word if marked[i] else int(words[i + 1]), paused[i]] += 1
            if runs[i]:
                reading = " ".join(table.names[label] for label in runs[i])
                self.readings.setdefault((word, PAUSE if paused[i] else following), Counter())[reading] += 1
                following = VOWEL if table.vowels[runs[i][0]] else CONSONANT

    def context(self, lexicon: Lexicon, texts: Mapping[int, str]) -> Context:
        """What was heard most often, where it is not what the lexicon has."""
        return Context(
            tuple(sorted((texts[word], following, reading) for word, following, reading in self._usual(lexicon))),
            tuple(sorted(texts[word] for word in _usually(self.before, paused=True))),
            tuple(sorted(texts[word] for word in _usually(self.behind, paused=False))),
        )

    def _usual(self, lexicon: Lexicon) -> Iterator[tuple[int, int, str]]:
        whole: dict[int, Counter[str]] = {}
        for (word, _), counts in self.readings.items():
            whole.setdefault(word, Counter()).update(counts)
        for word, counts in whole.items():
            for following in range(FOLLOWING):
                here = self.readings.get((word, following), counts)
                usual = _most(here if here.total() >= _SURE else counts)
                if counts[usual] >= _SURE and usual != lexicon.readings.spelled(int(lexicon.reading[word])):
                    yield word, following, usual


def _most(counts: Counter[str]) -> str:
    """The most frequent reading; of equals the first by the alphabet."""
    return min(counts, key=lambda reading: (-counts[reading], reading))


def _usually(counts: Counter[tuple[int, bool]], *, paused: bool) -> list[int]:
    """The words at which the voice did so more often than not, and more than once."""
    return [word for (word, did), count in counts.items() if did is paused and count >= _SURE and count > counts[word, not paused]]
