"""A person's text as sentences and words, and which of them show a language best."""

from __future__ import annotations

import heapq
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from lipdb.languages.sample import symbols_of
from lipdb.schedule import SILENCE
from lipdb.speech.text import SCRIPTS

if TYPE_CHECKING:
    from lipdb.speech.voice import Phrases

# Sentences end at these marks of any script, with the quotes and brackets behind them, and at the end of every line.
_ENDS = re.compile(r"(?<=[.!?…。！？।॥؟۔።။៕])(?=[\"'”’»)\]]?\s)[\"'”’»)\]]?\s+|[。！？]+")
_EDGES = re.compile(r"^[^\w]+|[^\w\u0300-\u036f\u0900-\u0963\u0966-\u0dff\u0e31-\u0e4e\u1000-\u109f]+$")
_CHARACTER = re.compile(r"[\u3400-\u9fff]")
LONGEST, SHORTEST = 160, 8
"""Letters of a sentence for a sample: longer and shorter ones are taken only when nothing else has a sound."""
MOST_WORDS = 5000
MOST_SENTENCES = 50_000
"""So much of a large text is looked at."""
_SYLLABIC = {"HIRAGANA": "Jpan", "KATAKANA": "Jpan", "CJK": "Hans"}


def sentences_of(text: str) -> tuple[str, ...]:
    """The sentences of *text*, each once, in their order; at most `MOST_SENTENCES`. A line's end ends a sentence."""
    found: dict[str, None] = {}
    for line in text.splitlines():
        for sentence in _cut(line):
            found[sentence] = None
            if len(found) == MOST_SENTENCES:
                return tuple(found)
    return tuple(found)


def _cut(line: str) -> Iterator[str]:
    start = 0
    for end in _ENDS.finditer(line):
        piece = line[start : end.end()]
        start = end.end()
        if any(c.isalnum() for c in piece):
            yield " ".join(piece.split())
    if any(c.isalnum() for c in line[start:]):
        yield " ".join(line[start:].split())


def words_of(sentences: Iterable[str]) -> list[str]:
    """The words of *sentences* without digits, the most frequent first; at most `MOST_WORDS`.

    Where characters are written without spaces, each of them is a word.
    """
    counts: Counter[str] = Counter()
    for sentence in sentences:
        for token in _CHARACTER.sub(r" \g<0> ", sentence).split():
            if (word := _EDGES.sub("", token)) and not re.search(r"\d", word):
                counts[word] += 1
    return [word for word, _ in sorted(counts.items(), key=lambda item: (-item[1], item[0]))[:MOST_WORDS]]


def script_in(text: str) -> str:
    """The script (ISO 15924) that most letters of *text* are of; empty where that is none of those known."""
    kinds = Counter(unicodedata.name(c, "?").split()[0] for c in text if unicodedata.category(c)[0] == "L")
    known = {names[0]: script for script, names in reversed(SCRIPTS.items())} | _SYLLABIC
    scripts: Counter[str] = Counter()
    for kind, count in kinds.items():
        scripts[known.get(kind, "")] += count
    # A Japanese text may hold more characters than kana.
    if scripts["Jpan"] > scripts["Hans"] / 10:
        scripts["Jpan"] += scripts.pop("Hans", 0)
    return max(scripts, key=scripts.__getitem__) if scripts else ""


def chosen(said: Mapping[str, Phrases], count: int) -> list[str]:
    """Up to *count* sentences that between them have every label and, as far as that goes, every pair of labels.

    The next one is always that with the most new pairs for its length, so short sentences are not passed over; *said* is
    what a voice makes of each sentence.
    """
    pairs = {sentence: frozenset(_pairs(phrases)) for sentence, phrases in said.items()}
    taken: list[str] = []
    have: set[tuple[str, str]] = set()
    heap = [(-_worth(new, sentence), rank, sentence) for rank, (sentence, new) in enumerate(pairs.items())]
    heapq.heapify(heap)
    while heap and len(taken) < count:
        _, rank, sentence = heapq.heappop(heap)
        worth = _worth(pairs[sentence] - have, sentence)
        # What a sentence is worth only falls, so one that is still worth as much as the next is the best.
        if heap and worth < -heap[0][0]:
            heapq.heappush(heap, (-worth, rank, sentence))
        else:
            taken.append(sentence)
            have |= pairs[sentence]
    return taken


def _worth(new: frozenset[tuple[str, str]], sentence: str) -> float:
    handy = SHORTEST <= len(sentence) <= LONGEST
    return len(new) / (20 + len(sentence)) * (1.0 if handy else 0.1)


def _pairs(phrases: Phrases) -> Iterator[tuple[str, str]]:
    for phrase in phrases:
        yield from pairwise((SILENCE, *symbols_of((phrase,)), SILENCE))


def examples_for(labels: Iterable[str], words: Sequence[tuple[str, Phrases]], said: Mapping[str, Phrases]) -> dict[str, str]:
    """A word for each label: of those in which it was heard, one that is no name, of handy length, where it stands early.

    A label that no word has by itself gets the shortest sentence that has it.
    """
    best: dict[str, tuple[tuple[bool, bool, int, int], str]] = {}
    for rank, (word, phrases) in enumerate(words):
        for position, label in enumerate(symbols_of(phrases)):
            key = (word[0].isupper(), not 3 <= len(word) <= 9, position, rank)
            if label not in best or key < best[label][0]:
                best[label] = key, word
    found = {label: word for label, (_, word) in best.items()}
    for label in labels:
        if label not in found:
            found[label] = min((sentence for sentence, phrases in said.items() if label in symbols_of(phrases)), key=len)
    return found
