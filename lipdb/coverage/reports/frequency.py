"""How often each pair of common phones occurs: what scans, the paper and published counts have in common."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError
from lipdb.schedule import SILENCE

Pair = tuple[str, str]


@dataclass(frozen=True, eq=False)
class Frequency:
    """Pairs of common phones with their counts, most frequent first, of equals by name; no pair is there with count 0.

    *whole* says whether pairs that are not listed never occurred; the paper prints only its most frequent ones. *scale* is
    what the counts are parts of: their sum, or 100 for per cents.
    """

    counts: Mapping[Pair, float]
    whole: bool
    scale: float

    @classmethod
    def of(cls, counts: Iterable[tuple[str, str, float]], *, silence: bool = True, percent: bool = False) -> Self:
        """The frequency of (left, right, count) rows, summed by pair; pairs with ``_`` are left out without *silence*.

        With *percent* the counts are per cent of a whole of which only the most frequent pairs are given.
        """
        total: dict[Pair, float] = {}
        for left, right, count in counts:
            if silence or SILENCE not in (left, right):
                total[left, right] = total.get((left, right), 0) + count
        kept = {pair: count for pair, count in sorted(total.items(), key=lambda item: (-item[1], item[0])) if count > 0}
        return cls(kept, whole=not percent, scale=100.0 if percent else float(sum(kept.values())))

    def __len__(self) -> int:
        return len(self.counts)

    @cached_property
    def pairs(self) -> tuple[Pair, ...]:
        """The pairs, most frequent first."""
        return tuple(self.counts)

    @cached_property
    def shares(self) -> NDArray[np.float64]:
        """The part of all that each pair has, ``(n,)``, 0..1."""
        return np.array(list(self.counts.values()), dtype=np.float64) / (self.scale or 1.0)

    @cached_property
    def phones(self) -> frozenset[str]:
        """The common phones that occur, without silence."""
        return frozenset(phone for pair in self.counts for phone in pair) - {SILENCE}

    def share(self, pair: Pair) -> float:
        """The part of all that *pair* has, 0..1."""
        return self.counts.get(pair, 0.0) / (self.scale or 1.0)

    def covering(self, share: float) -> int:
        """How many of the most frequent pairs cover *share* (0..1) of all; 0 when there is nothing to cover."""
        reached = self.shares.cumsum()
        # The sum of all shares may miss 1 by a rounding.
        return min(int(np.searchsorted(reached, share - 1e-12)) + 1, len(reached)) if len(reached) else 0

    def covered_by(self, first: int) -> float:
        """The part of all (0..1) that the *first* most frequent pairs cover."""
        return float(self.shares[:first].sum())

    def required(self, where: str) -> Self:
        """Itself. Raises `InputError` naming *where* when no pair occurs, so nothing can be said of it."""
        if not self.counts:
            raise InputError(f"{where}: holds no pair of phones; scan a corpus that has text in the language")
        return self
