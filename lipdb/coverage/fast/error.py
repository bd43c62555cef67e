"""How far a fast count is from an exact one, measured on lines that were counted both ways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.counts import PAIRS
from lipdb.coverage.resolve import resolve
from lipdb.phones.phoneset import PhoneSet


@dataclass(frozen=True, slots=True)
class Distance:
    """The total variation distance of two distributions of pairs: half the sum of how far the shares of each pair are apart.

    It is measured on a sample in which exact counting finds *pairs* pairs, and is somewhat too large rather than too small,
    for chance adds to it and takes nothing away. *spread* is its standard error, from leaving out each fold of the sample
    in turn (the jackknife: Efron 1982).
    """

    value: float
    spread: float
    pairs: int

    def __str__(self) -> str:
        return f"{self.value:.4f} ± {self.spread:.4f}"


def distance(sample: pa.Table, phoneset: PhoneSet, notation: str) -> Distance | None:
    """The distance between fast and exact counts in *sample* (of `SAMPLE`), as common phones; none when it is empty."""
    if not sample.num_rows:
        return None
    exact, fast = (_by_fold(sample, way, phoneset, notation) for way in ("exact", "fast"))
    pairs = sorted({pair for counts in (exact, fast) for _, pair in counts})
    folds = sorted({fold for counts in (exact, fast) for fold, _ in counts})
    arrays = [np.array([[counts.get((fold, pair), 0) for pair in pairs] for fold in folds]) for counts in (exact, fast)]
    whole = [array.sum(axis=0) for array in arrays]
    without = [_apart(whole[0] - arrays[0][i], whole[1] - arrays[1][i]) for i in range(len(folds))]
    spread = np.sqrt((len(folds) - 1) * np.var(without)) if len(folds) > 1 else 0.0
    return Distance(_apart(*whole), float(spread), int(whole[0].sum()))


def _by_fold(sample: pa.Table, way: str, phoneset: PhoneSet, notation: str) -> dict[tuple[str, tuple[str, str]], int]:
    """How often each pair of common phones is in each fold, counted in this *way*."""
    columns = [sample["fold"].cast(pa.string()), sample["left"], sample["right"], sample[way]]
    table = resolve(pa.table(columns, schema=PAIRS), phoneset, notation).pairs
    found: dict[tuple[str, tuple[str, str]], int] = {}
    for fold, left, right, count in zip(*(table[name].to_pylist() for name in ("document", "left", "right", "count")), strict=True):
        found[fold, (left, right)] = found.get((fold, (left, right)), 0) + count
    return found


def _apart(a: NDArray[np.int64], b: NDArray[np.int64]) -> float:
    """The total variation distance of two rows of counts; 1 when one of them is empty."""
    return float(np.abs(a / a.sum() - b / b.sum()).sum() / 2) if a.sum() and b.sum() else 1.0
