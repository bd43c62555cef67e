"""What decided a result: the curves that a phone pair uses, and what made a weight at one instant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lipdb.curated.schema import BY_HAND
from lipdb.curves.lookup import trust

if TYPE_CHECKING:
    from lipdb.curves.lookup import CurveBook, Found

FALL_BACK = "fall-back"
ORIGINS = ("authored", "fitted", "imported", "generated", FALL_BACK)
"""Where a curve comes from, the most worked on first; a fall-back stands in no table."""


@dataclass(frozen=True, slots=True)
class PairUse:
    """A phone pair that a line or a corpus needs: how often, and the winning curve of every pose."""

    left: str
    right: str
    count: float
    curves: Mapping[str, Found]

    @property
    def pair(self) -> tuple[str, str]:
        """Left and right phone."""
        return self.left, self.right

    @property
    def missing(self) -> list[str]:
        """The poses whose curve no table has: it was made for the moment."""
        return [pose for pose, found in self.curves.items() if found.fallback]

    @property
    def moving(self) -> list[Found]:
        """What moves the face; all that there is when nothing does."""
        return [found for found in self.curves.values() if found.curve.keys] or list(self.curves.values())

    @property
    def origin(self) -> str:
        """The least worked on of the origins of what moves the face, ``fall-back`` for what no table has."""
        return max((FALL_BACK if found.fallback else found.curve.origin for found in self.moving), key=ORIGINS.index)

    @property
    def gap(self) -> bool:
        """Whether some curve of what moves the face is neither authored nor fitted: work for an artist."""
        return self.origin not in BY_HAND

    @property
    def layer(self) -> str:
        """The least specific of the layers of what moves the face."""
        return max((found.layer for found in self.moving), key=trust)

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        moving = self.moving
        return {
            "left": self.left,
            "right": self.right,
            "count": self.count,
            "origin": sorted({found.curve.origin for found in moving}),
            "layer": sorted({found.layer for found in moving}),
            "inherited": sorted({"-".join(found.inherited) for found in moving if found.inherited}),
            "poses": [pose for pose, found in self.curves.items() if found.curve.keys],
            "missing": self.missing,
        }


def pair_uses(book: CurveBook, counts: Iterable[tuple[tuple[str, str], float]]) -> list[PairUse]:
    """What *book* has for every pair of *counts*, in its order."""
    return [PairUse(left, right, count, {pose: book.find(left, right, pose) for pose in book.poses}) for (left, right), count in counts]


@dataclass(frozen=True, slots=True)
class Cause:
    """What made the weight of one pose at one instant.

    *weights* by stage of the engine, from ``curve`` to ``final``; *curves* of the pairs that lie there: (left, right,
    weight, where it was found); *stage* changed the weight most, "" when it is as drawn; *yields_to* are the poses whose
    constraints cut into it.
    """

    pose: str
    time: float
    weights: Mapping[str, float]
    curves: tuple[tuple[str, str, float, Found], ...]
    stage: str
    yields_to: tuple[str, ...]

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing; the curve named first is the one that won by maximum."""
        curves = sorted(self.curves, key=lambda curve: -curve[2])
        return {
            "pose": self.pose,
            "weight": self.weights["final"],
            "stage": self.stage or "as drawn",
            "yields_to": list(self.yields_to),
            "pair": [f"{left}-{right}" for left, right, _, _ in curves],
            "curve": [f"{weight:.3f}" for _, _, weight, _ in curves],
            "origin": [found.curve.origin for *_, found in curves],
            "layer": [found.where for *_, found in curves],
        }

    def to_json(self) -> dict[str, Any]:
        """Plain data with every stage and every curve's provenance."""
        return {
            "pose": self.pose,
            "time": self.time,
            "weights": dict(self.weights),
            "stage": self.stage,
            "yields_to": list(self.yields_to),
            "curves": [
                {
                    "weight": weight,
                    **found.curve.row((left, right, self.pose)),
                    "layer": found.layer,
                    "reason": found.reason,
                    "inherited": "-".join(found.inherited),
                }
                for left, right, weight, found in self.curves
            ],
        }
