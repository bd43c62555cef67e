"""What a corpus needs: the frequencies of the paper's Table 2 and the curve of its Figure 2 (Xu et al. 2013, section 3.1.1)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lipdb.coverage.reports.frequency import Frequency
from lipdb.errors import MissingToolError, OutputError
from lipdb.files import whole_file
from lipdb.schedule import SILENCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lipdb.decisions import PairUse

LEVELS = (0.5, 0.9, 0.95, 0.99, 0.991, 0.999, 1.0)
"""Parts of running text; the paper asks for 0.991."""

DRAWINGS = ("png", "svg", "pdf")


@dataclass(frozen=True, slots=True)
class Ranked:
    """One line of Table 2: a pair, how often it occurs, and what it covers with all that are more frequent."""

    rank: int
    left: str
    right: str
    count: float
    percent: float
    cumulative: float

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "rank": self.rank,
            "pair": f"{self.left}-{self.right}",
            "count": self.count,
            "percent": round(self.percent, 4),
            "cumulative": round(self.cumulative, 4),
        }


def ranked(frequency: Frequency, top: int | None = None) -> list[Ranked]:
    """Table 2: the *top* most frequent pairs, or all."""
    reached = 100 * frequency.shares.cumsum()
    return [
        Ranked(k + 1, left, right, count, 100 * share, float(reached[k]))
        for k, ((left, right), count, share) in enumerate(zip(frequency.pairs, frequency.counts.values(), frequency.shares, strict=True))
        if top is None or k < top
    ]


@dataclass(frozen=True, slots=True)
class Summary:
    """A corpus in numbers. *possible* counts the pairs of *phones* (and silence, if counted); *covering* is by `LEVELS`."""

    total: float
    phones: int
    possible: int
    seen: int
    covering: dict[float, int]

    @classmethod
    def of(cls, frequency: Frequency, phones: int) -> Summary:
        """The numbers of *frequency* in a language of *phones* common phones, silence not counted."""
        silent = any(SILENCE in pair for pair in frequency.counts)
        possible = (phones + 1) ** 2 - 1 if silent else phones**2
        return cls(frequency.scale, phones, possible, len(frequency), {level: frequency.covering(level) for level in LEVELS})

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "total": self.total,
            "phones": self.phones,
            "possible": self.possible,
            "seen": self.seen,
            "never": self.possible - self.seen,
            "covering": {f"{100 * level:g}": count for level, count in self.covering.items()},
        }


def by_curve(uses: Sequence[PairUse]) -> dict[str, list[dict[str, Any]]]:
    """How many pairs, and what part of running text, use curves of each origin and of each layer today."""
    total = sum(use.count for use in uses) or 1
    found: dict[str, list[dict[str, Any]]] = {}
    for what in ("origin", "layer"):
        names = {use.pair: getattr(use, what) for use in uses}
        found[what] = [
            {
                what: name,
                "pairs": sum(names[use.pair] == name for use in uses),
                "percent": round(100 * sum(use.count for use in uses if names[use.pair] == name) / total, 4),
            }
            for name in sorted(set(names.values()))
        ]
    return found


def plot(frequency: Frequency, path: Path, *, title: str = "") -> None:
    """Draw Figure 2 to *path* (.png, .svg or .pdf): what each pair has, by rank, and what the most frequent ones cover.

    Raises `MissingToolError` without matplotlib, `OutputError` when the file can't be written.
    """
    kind = path.suffix.lower().lstrip(".")
    if kind not in DRAWINGS:
        raise OutputError(f"{path}: can't draw into such a file; end its name in {' or '.join('.' + kind for kind in DRAWINGS)}")
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingToolError("drawing needs matplotlib; install it with: pip install 'lipdb[plot]'") from None
    figure = Figure(figsize=(8, 4.5), layout="constrained")
    axes = figure.add_subplot(xlabel="pairs of common phones, most frequent first", ylabel="part of running text (%)", title=title)
    rank = np.arange(1, len(frequency) + 1)
    axes.bar(rank, 100 * frequency.shares, width=1, color="#0072b2", label="each pair")
    cumulative = axes.twinx()
    cumulative.plot(rank, 100 * frequency.shares.cumsum(), color="#d55e00", label="all up to here")
    cumulative.set(ylabel="covered so far (%)", ylim=(0, 101), xlim=(0, len(frequency) + 1))
    for level in (0.9, 0.991):
        count = frequency.covering(level)
        cumulative.plot([count, count], [0, 100 * level], color="#555555", linewidth=0.8, linestyle=":")
        cumulative.annotate(f"{count} pairs: {100 * level:g} %", (count, 100 * level), (6, -14), textcoords="offset points")
    with whole_file(path) as partial:
        figure.savefig(partial, format=kind, dpi=150)
