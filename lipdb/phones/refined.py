"""Refined common phones: which coarser phone a common phone is a kind of, so that it can use that one's curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Self

from lipdb.curated.tsv import Records, Row


@dataclass(frozen=True, slots=True)
class Kinds:
    """The column *kind_of* of common.tsv: a refined common phone to the coarser one that it was split from."""

    coarser: Mapping[str, str]

    @classmethod
    def from_records(cls, records: Records) -> Self:
        """The kinds in common.tsv."""
        return cls.from_common({phone: row for (phone,), row in records.get("common.tsv", {}).items()})

    @classmethod
    def from_common(cls, common: Mapping[str, Row]) -> Self:
        """The kinds among the rows of common.tsv, by phone."""
        return cls({phone: row["kind_of"] for phone, row in common.items() if row.get("kind_of")})

    def line(self, phone: str) -> tuple[str, ...]:
        """*phone*, what it is a kind of, what that is a kind of, and so on; a circle ends where it closes."""
        found = [phone]
        while (phone := self.coarser.get(phone, "")) and phone not in found:
            found.append(phone)
        return tuple(found)

    def coarser_pairs(self, left: str, right: str) -> Iterator[tuple[str, str]]:
        """The pairs that can stand in for *left* → *right*, the nearest to it first: fewest steps up, then the right's before
        the left's.
        """
        if left not in self.coarser and right not in self.coarser:
            return iter(())
        lefts, rights = self.line(left), self.line(right)
        steps = sorted(product(range(len(lefts)), range(len(rights))), key=lambda step: (sum(step), step[0]))
        return ((lefts[i], rights[j]) for i, j in steps if i or j)
