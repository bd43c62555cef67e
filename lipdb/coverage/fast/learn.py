"""Learn what running speech does to words from sentences that the voice says whole.

Each sentence is laid beside the readings of its words alone (`lipdb.coverage.fast.align`), which gives every word the labels that
were said for it. Pauses are compared with what the gaps say: there are words before which the voice pauses without a mark
("and" in a long sentence), and words behind which it does not pause in spite of one ("Mr. Smith").

Chinese characters are not learned: how one is read depends on the word that it is in, not on the sounds beside it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.fast.align import align
from lipdb.coverage.fast.context import CONSONANT, PAUSE, VOWEL, Context
from lipdb.coverage.fast.heard import SURE, Evidence, Heard
from lipdb.coverage.fast.lexicon import BREAK, Lexicon
from lipdb.coverage.fast.readings import Numbers, Readings
from lipdb.coverage.fast.running import PAUSES, Running, running
from lipdb.coverage.fast.words import Places, cut, is_character

# What it costs to take one label for another: a vowel for a vowel, and so on; and to take none for it.
_VOWELS, _CONSONANTS, _UNLIKE, _SILENT, _SKIP = 1, 2, 6, 8, 3
NOBODY = -1
_SILENCE = np.zeros(1, np.int32)


def learn(lexicon: Lexicon, lines: Sequence[str]) -> Context:
    """What the voice does in *lines* that it does not do to their words alone."""
    found = running(lexicon, pa.array(lines, pa.string()))
    edges = np.searchsorted(found.line, np.arange(len(lines) + 1))
    rows = [np.arange(first, last) for first, last in pairwise(edges.tolist())]
    table, texts = lexicon.readings, _texts(lexicon, lines)
    spoken = [BREAK.join(said.phrases).split() for said in lexicon.said(lines)]
    table.label_numbers([label for labels in spoken for label in labels])
    pairs = [(row, table.label_numbers(labels)) for row, labels in zip(rows, spoken, strict=True) if row.size and labels]
    alone = [_alone(lexicon, found, row) for row, _ in pairs]
    places = align([labels for labels, _ in alone], [labels for _, labels in pairs], _costs(table.vowels), skip=_SKIP)
    evidence, before, behind = Evidence(), Counter[tuple[str, bool]](), Counter[tuple[str, bool]]()
    for (row, labels), (_, owners), place in zip(pairs, alone, places, strict=True):
        words = [texts[word] for word in found.words[row].tolist()]
        runs, paused = _shared_out(labels.tolist(), _owners(labels, owners, place), len(words))
        for heard in _heard(lexicon, found.words[row], words, runs, paused):
            evidence.add(heard)
        for i, marked in enumerate(found.behind[row[:-1]] == PAUSES):
            (behind if marked else before)[words[i] if marked else words[i + 1], paused[i]] += 1
    return evidence.context(_usually(before, paused=True), _usually(behind, paused=False))


def _texts(lexicon: Lexicon, lines: Sequence[str]) -> dict[int, str]:
    """The words of *lines* by their numbers."""
    words = cut(pa.array(lines, pa.string()))
    numbers, places = np.unique(lexicon.words(words), return_index=True)
    return {number: words.word(place) for number, place in zip(numbers.tolist(), places.tolist(), strict=True)}


def _alone(lexicon: Lexicon, found: Running, row: Places) -> tuple[Numbers, Places]:
    """The labels of the words of one line, each as it is said alone, ``_`` where a gap says so; and whose each label is."""
    labels, owners = list[Numbers](), list[int]()
    for i, word in enumerate(row.tolist()):
        run = lexicon.readings.run(lexicon.reading[found.words[word]])
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


def _shared_out(labels: list[int], owners: list[int], count: int) -> tuple[list[list[int]], list[bool]]:
    """The labels of each of *count* words, ``_`` among them where the voice paused within one; and whether it paused behind."""
    runs: list[list[int]] = [[] for _ in range(count)]
    paused = [False] * count
    last = NOBODY
    for at, (label, owner) in enumerate(zip(labels, owners, strict=True)):
        if label:
            runs[owner].append(label)
            last = owner
        elif last != NOBODY and at + 1 < len(labels):
            if owners[at + 1] == last:
                runs[last].append(0)
            else:
                paused[last] = True
    return runs, paused


def _heard(lexicon: Lexicon, numbers: Places, words: list[str], runs: list[list[int]], paused: list[bool]) -> Iterator[Heard]:
    """The words of one line with their neighbours."""
    table = lexicon.readings
    said = [i for i, run in enumerate(runs) if run]
    for place, i in enumerate(said):
        if is_character(words[i]):
            continue
        opens, ends = place == 0 or paused[said[place - 1]], place + 1 == len(said) or paused[i]
        before = PAUSE if opens else _kind(table, runs[said[place - 1]][-1])
        behind = PAUSE if ends else _kind(table, runs[said[place + 1]][0])
        alone = table.spelled(int(lexicon.reading[numbers[i]])).split(" ")
        yield Heard(words[i], alone, [table.names[label] for label in runs[i]], before, behind)


def _kind(table: Readings, label: int) -> int:
    return VOWEL if table.vowels[label] else CONSONANT


def _usually(counts: Counter[tuple[str, bool]], *, paused: bool) -> list[str]:
    """The words at which the voice did so more often than not, and more than once."""
    return [word for (word, did), count in counts.items() if did is paused and count >= SURE and count > counts[word, not paused]]
