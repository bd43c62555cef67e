"""Merge three ways, row by row: what a text said before, what it says now, and what stands here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from lipdb.curated.tsv import Row
from lipdb.store.cells import Flat, Place
from lipdb.store.conflict import Versions


@dataclass(frozen=True, slots=True)
class Merge:
    """The outcome, each part sorted by place.

    *followed*: rows that only the text changed, and what they become (None: they go). *kept*: rows that only stand
    differently here; they stay. *conflicts*: rows that both changed, each its own way; they stay too.
    """

    followed: Mapping[Place, Row | None]
    kept: tuple[Versions, ...]
    conflicts: tuple[Versions, ...]

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "followed": [{"path": path, "key": list(key)} for path, key in self.followed],
            "kept": [versions.to_json() for versions in self.kept],
            "conflicts": [versions.to_json() for versions in self.conflicts],
        }


def merge(base: Flat, text: Flat, mine: Flat) -> Merge:
    """Merge the newer *text*, which said *base* before, into *mine*."""
    followed: dict[Place, Row | None] = {}
    kept: list[Versions] = []
    conflicts: list[Versions] = []
    for place in sorted(base.keys() | text.keys() | mine.keys()):
        was, says, stands = base.get(place), text.get(place), mine.get(place)
        if stands == says:
            continue
        if stands == was:
            followed[place] = says
        elif says == was:
            kept.append(Versions(*place, mine=stands, theirs=says))
        else:
            conflicts.append(Versions(*place, mine=stands, theirs=says))
    return Merge(followed, tuple(kept), tuple(conflicts))
