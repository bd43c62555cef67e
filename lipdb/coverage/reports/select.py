"""The fewest sentences that between them hold every pair: what to record, or to look at in a test."""

from __future__ import annotations

import heapq
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from lipdb.coverage.reports.frequency import Pair


@dataclass(frozen=True, slots=True)
class Chosen:
    """A sentence that was chosen: which pairs it adds to those before it, and how many are covered with it."""

    sentence: str
    adds: tuple[Pair, ...]
    covered: int

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"covered": self.covered, "sentence": self.sentence, "adds": ["-".join(pair) for pair in self.adds]}


def select(sentences: Sequence[tuple[str, Iterable[Pair]]], *, most: int | None = None) -> list[Chosen]:
    """Choose sentences that cover all pairs of *sentences* (text, pairs), or as many as *most* sentences can.

    Greedy: each time the sentence that adds the most pairs, of equals the shortest, then the first; those that later
    ones made needless are taken out again. Greedy needs at most ln(pairs) + 1 times as many as the best choice would
    (Chvátal 1979, Mathematics of Operations Research 4:233).
    """
    held = [frozenset(pairs) for _, pairs in sentences]
    numbers = _greedy([len(text) for text, _ in sentences], held, most)
    if most is None or len(numbers) < most:
        numbers = _without_needless(numbers, held)
    covered: set[Pair] = set()
    chosen = []
    for k in numbers:
        adds = held[k] - covered
        covered |= adds
        chosen.append(Chosen(sentences[k][0], tuple(sorted(adds)), len(covered)))
    return chosen


def _greedy(sizes: Sequence[int], held: Sequence[frozenset[Pair]], most: int | None) -> list[int]:
    """The sentences in the order in which they are chosen.

    What a sentence adds can only fall as others are chosen, so it is worked out anew only for the one that leads.
    """
    order = [(-len(pairs), size, k) for k, (size, pairs) in enumerate(zip(sizes, held, strict=True)) if pairs]
    heapq.heapify(order)
    covered: set[Pair] = set()
    chosen: list[int] = []
    while order and (most is None or len(chosen) < most):
        before, size, k = order[0]
        adds = len(held[k] - covered)
        if adds == -before:
            heapq.heappop(order)
            covered |= held[k]
            chosen.append(k)
        elif adds:
            heapq.heapreplace(order, (-adds, size, k))
        else:
            heapq.heappop(order)
    return chosen


def _without_needless(numbers: Sequence[int], held: Sequence[frozenset[Pair]]) -> list[int]:
    """*numbers* without sentences all of whose pairs the others hold, the last chosen first."""
    holders = Counter(pair for k in numbers for pair in held[k])
    kept = list(numbers)
    for k in reversed(numbers):
        if all(holders[pair] > 1 for pair in held[k]):
            kept.remove(k)
            holders.subtract(held[k])
    return kept
