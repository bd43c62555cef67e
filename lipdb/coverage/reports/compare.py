"""Two frequencies side by side: how far apart they are, and which pairs make the difference."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from lipdb.coverage.reports.frequency import Frequency, Pair


@dataclass(frozen=True, slots=True)
class Difference:
    """One pair's part of running text in both, in per cent."""

    pair: Pair
    first: float
    second: float

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "pair": "-".join(self.pair),
            "first": round(self.first, 4),
            "second": round(self.second, 4),
            "difference": round(self.second - self.first, 4),
        }


@dataclass(frozen=True, slots=True)
class Comparison:
    """How two frequencies differ.

    *pairs* are those compared: all that occur in either, or, where one lists only its most frequent, those. *rank* is
    Spearman's correlation over them (NaN for less than three pairs), *distance* the total variation distance 0..1 (NaN
    where a list is not whole), *differences* the pairs with the largest difference first.
    """

    pairs: int
    rank: float
    distance: float
    only_first: tuple[Pair, ...]
    only_second: tuple[Pair, ...]
    differences: tuple[Difference, ...]

    def to_json(self) -> dict[str, Any]:
        """Plain data; what can't be said is null."""
        return {
            "pairs": self.pairs,
            "rank_correlation": None if np.isnan(self.rank) else round(self.rank, 4),
            "total_variation": None if np.isnan(self.distance) else round(self.distance, 6),
            "only_first": ["-".join(pair) for pair in self.only_first],
            "only_second": ["-".join(pair) for pair in self.only_second],
            "differences": [difference.to_row() for difference in self.differences],
        }


def compare(first: Frequency, second: Frequency) -> Comparison:
    """Compare two frequencies of pairs of common phones."""
    both = {**first.counts, **second.counts}
    pairs = [pair for pair in both if all(side.whole or pair in side.counts for side in (first, second))]
    a, b = (np.array([side.share(pair) for pair in pairs]) for side in (first, second))
    whole = first.whole and second.whole
    order = sorted(range(len(pairs)), key=lambda k: (-abs(a[k] - b[k]), pairs[k]))
    return Comparison(
        len(pairs),
        _spearman(a, b),
        float(np.abs(a - b).sum() / 2) if whole else float("nan"),
        tuple(pair for pair in first.counts if pair not in second.counts) if second.whole else (),
        tuple(pair for pair in second.counts if pair not in first.counts) if first.whole else (),
        tuple(Difference(pairs[k], 100 * float(a[k]), 100 * float(b[k])) for k in order),
    )


def _spearman(a: np.ndarray, b: np.ndarray) -> float:
    from scipy.stats import rankdata

    if len(a) < 3 or not np.ptp(a) or not np.ptp(b):
        return float("nan")
    return float(np.corrcoef(rankdata(a), rankdata(b))[0, 1])
