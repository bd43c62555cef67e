"""What to author next: pairs whose winning curve is neither authored nor fitted, by how much of real text needs them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lipdb.decisions import PairUse

MINUTES = 5.0
"""What drawing the curves of one pair takes, on average."""


@dataclass(frozen=True, slots=True)
class Gap:
    """One pair to author: what it carries, and what will be covered by hand when it and all before it are done.

    *percent* and *covered* are of running text; *hours* is the work up to and with it.
    """

    use: PairUse
    percent: float
    covered: float
    hours: float

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing: also where the curve that the pair uses today comes from."""
        return {
            "pair": f"{self.use.left}-{self.use.right}",
            "count": self.use.count,
            "percent": round(self.percent, 4),
            "covered": round(self.covered, 4),
            "hours": round(self.hours, 2),
            "origin": self.use.origin,
            "layer": self.use.layer,
        }


@dataclass(frozen=True, slots=True)
class Outlook:
    """What is left to do: *gaps* of *pairs*, which is *hours* of work; per cent of running text *covered* by hand today.

    *then* is what will be covered after the *next* gaps.
    """

    pairs: int
    gaps: int
    hours: float
    covered: float
    next: int
    then: float


def outlook(uses: Sequence[PairUse], *, minutes: float = MINUTES, next: int = 10) -> Outlook:
    """The gaps among *uses* in numbers, and what the *next* of them will change. Of text without pairs all is covered."""
    found = gaps(uses, minutes=minutes)
    covered = found[0].covered - found[0].percent if found else 100.0
    then = found[:next][-1].covered if found and next else covered
    return Outlook(len(uses), len(found), len(found) * minutes / 60, covered, min(next, len(found)), then)


def gaps(uses: Iterable[PairUse], *, minutes: float = MINUTES) -> list[Gap]:
    """The gaps among *uses*, the most needed first; a pair costs *minutes*."""
    ordered = sorted(uses, key=lambda use: (-use.count, use.pair))
    total = sum(use.count for use in ordered) or 1.0
    done = 100 * sum(use.count for use in ordered if not use.gap) / total
    found: list[Gap] = []
    for use in ordered:
        if use.gap:
            percent = 100 * use.count / total
            done += percent
            found.append(Gap(use, percent, done, (len(found) + 1) * minutes / 60))
    return found
