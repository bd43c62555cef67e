"""The common phones: who uses each, and how many pairs it costs, drawn, made, or inherited from a coarser phone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from lipdb.curated.tsv import Records
from lipdb.curves.lookup import CurveBook
from lipdb.languages.reuse import common_phones
from lipdb.poses import SHARED
from lipdb.schedule import SILENCE


@dataclass(frozen=True, slots=True)
class CommonPhone:
    """A common phone with the languages that use it and its pairs with every phone of those, silence among them.

    Of these *pairs*, *own* have curves of their own in a table, *inherited* use those of a coarser pair, and the rest
    is made for the moment. *kind_of* is the phone that it was split from, if it was.
    """

    phone: str
    kind: str
    ipa: str
    kind_of: str
    languages: tuple[str, ...]
    pairs: int
    own: int
    inherited: int

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {**{name: getattr(self, name) for name in self.__dataclass_fields__}, "languages": list(self.languages)}


def inventory(records: Records, pose_set: str = SHARED) -> Iterator[CommonPhone]:
    """Every common phone but silence, by name, with the curves of *pose_set* in the common layer."""
    languages = sorted(path.split("/")[0] for path in records if path.endswith("/language.tsv"))
    used = {code: common_phones(records, code) for code in languages}
    book = CurveBook.from_records(records, pose_set)
    for (phone,), row in sorted(records.get("common.tsv", {}).items()):
        if phone == SILENCE:
            continue
        users = tuple(code for code in languages if phone in used[code])
        others = frozenset((SILENCE, phone)).union(*(used[code] for code in users))
        pairs = {pair for other in others for pair in ((phone, other), (other, phone))} if users else set()
        found = [{book.find(*pair, pose) for pose in book.poses} for pair in pairs]
        made = sum(any(one.fallback for one in poses) for poses in found)
        inherited = sum(not any(one.fallback for one in poses) and any(one.inherited for one in poses) for poses in found)
        yield CommonPhone(
            phone, row["kind"], row["ipa"], row.get("kind_of", ""), users, len(pairs), len(pairs) - made - inherited, inherited
        )
