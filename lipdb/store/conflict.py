"""Somebody else saved first: which rows, and what both sides say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from lipdb.curated.tsv import Key, Row
from lipdb.errors import ConflictError
from lipdb.store.cells import differing
from lipdb.words import counted


@dataclass(frozen=True, slots=True)
class Versions:
    """One row as two sides have it. None for *mine* or *theirs* means that it is not there on that side."""

    path: str
    key: Key
    mine: Row | None
    theirs: Row | None

    def __str__(self) -> str:
        return f"{self.path} {' '.join(self.key)}: {self.sides}"

    @property
    def sides(self) -> str:
        """What the two sides say, where they differ."""
        return f"theirs {differing(self.theirs, self.mine)}, yours {differing(self.mine, self.theirs)}"

    def swapped(self) -> Versions:
        """The same row seen from the other side."""
        return Versions(self.path, self.key, mine=self.theirs, theirs=self.mine)

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"path": self.path, "key": list(self.key), "mine": self.mine, "theirs": self.theirs}


class EditConflictError(ConflictError):
    """An edit or an undo that would lose somebody else's newer work; nothing was saved.

    *conflicts* has every row with both versions; *mine* and *theirs* are those of the first; *revision* is the newest
    revision that touched one of them, by *author*: the one to look at before trying again.
    """

    def __init__(self, conflicts: Sequence[Versions], *, revision: int, author: str, doing: str) -> None:
        self.conflicts = tuple(conflicts)
        self.revision, self.author = revision, author
        self.mine = self.conflicts[0].mine
        self.theirs = self.conflicts[0].theirs
        more = f" (and {counted(len(self.conflicts) - 1, 'more row')})" if len(self.conflicts) > 1 else ""
        super().__init__(f"{doing}: {author} changed the same in revision {revision}; {self.conflicts[0]}{more}; look at it and try again")
