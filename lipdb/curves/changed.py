"""What a revision did to curves: by layer and pair, what counted there before and after."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Records, Row
from lipdb.curves.curve import Curve, curve_from_row
from lipdb.curves.lookup import CurveBook


class RowChange(Protocol):
    """One row before and after, as the store tells it."""

    @property
    def path(self) -> str:
        """The path of its table."""

    @property
    def key(self) -> Key:
        """Its key."""

    @property
    def before(self) -> Row | None:
        """What it was; None when it was not there."""

    @property
    def after(self) -> Row | None:
        """What it became; None when it was taken away."""


@dataclass(frozen=True, slots=True)
class ChangedPair:
    """One pair in one layer (*language* and *character* are empty where it is not theirs).

    *poses* has, for each pose that changed, the curve before and after; None where the layer had none of its own.
    """

    pose_set: str
    left: str
    right: str
    language: str
    character: str
    poses: Mapping[str, tuple[Curve | None, Curve | None]]

    @property
    def layer(self) -> str:
        """The layer as answers name it."""
        return f"character:{self.character}" if self.character else f"language:{self.language}" if self.language else "common"

    @property
    def pair(self) -> str:
        """The pair as people write it."""
        return f"{self.left}-{self.right}"

    @property
    def inherits(self) -> bool:
        """Whether the layer had, or has, no curve of its own for some pose."""
        return any(before is None or after is None for before, after in self.poses.values())

    def filled(self, before: Records, after: Records) -> Mapping[str, tuple[Curve, Curve]]:
        """*poses* with what the layers below said where there was no own curve, in the records *before* and *after*."""
        books = [
            CurveBook.from_records(records, self.pose_set, language=self.language or None, character=self.character or None)
            for records in (before, after)
        ]
        old, new = ({pose: book.find(self.left, self.right, pose).curve for pose in self.poses if pose in book.poses} for book in books)
        rest = Curve(())
        return {pose: (then or old.get(pose, rest), now or new.get(pose, rest)) for pose, (then, now) in self.poses.items()}


def changed_pairs(changes: Iterable[RowChange]) -> list[ChangedPair]:
    """The pairs whose curves *changes* touch, in their order; other rows are left out."""
    found: dict[tuple[str, str, str], dict[str, tuple[Curve | None, Curve | None]]] = {}
    for one in changes:
        table = table_of(one.path)
        if table is None or table.key != ("left", "right", "pose"):
            continue
        left, right, pose = one.key
        before, after = (curve_from_row(row) if row else None for row in (one.before, one.after))
        found.setdefault((one.path, left, right), {})[pose] = before, after
    pairs = []
    for (path, left, right), poses in found.items():
        table = table_of(path)
        parts = (table.parts(path) if table else None) or {}
        pairs.append(ChangedPair(parts["pose_set"], left, right, parts.get("language", ""), parts.get("character", ""), poses))
    return pairs
