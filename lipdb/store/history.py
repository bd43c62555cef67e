"""What happened: the revisions, the rows each one changed, the difference of two, and any old state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sqlalchemy as sa

from lipdb.curated.tsv import Key, Row
from lipdb.errors import InputError
from lipdb.store.cells import Flat, Place, differing, key_from, key_text, row_from
from lipdb.store.revisions import newest_revision, read_flat
from lipdb.store.tables import change, record, revision


@dataclass(frozen=True, slots=True)
class Change:
    """One row of a revision: what it was and what it became; None for a row that was not there."""

    revision: int
    path: str
    key: Key
    before: Row | None
    after: Row | None

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"revision": self.revision, "path": self.path, "key": list(self.key), "before": self.before, "after": self.after}

    def to_row(self) -> dict[str, str]:
        """A line of a listing: only the cells that changed."""
        before, after = differing(self.before, self.after), differing(self.after, self.before)
        return {"path": self.path, "key": " ".join(self.key), "before": before, "after": after}


@dataclass(frozen=True, slots=True)
class Revision:
    """One edit: its number, who made it, when (UTC), why, and how many rows it changed."""

    number: int
    author: str
    time: str
    note: str
    rows: int

    def to_json(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"revision": self.number, "author": self.author, "time": self.time, "note": self.note, "rows": self.rows}


def _below(prefix: str | None, key: Sequence[str] | None) -> list[sa.ColumnElement[bool]]:
    wanted: list[sa.ColumnElement[bool]] = []
    if prefix:
        wanted.append(change.c.path.startswith(prefix, autoescape=True))
    if key is not None:
        wanted.append(change.c.key == key_text(key))
    return wanted


def read_revisions(connection: sa.Connection, prefix: str | None, key: Sequence[str] | None, limit: int | None) -> list[Revision]:
    """The revisions that changed rows below *prefix* (with *key*), newest first."""
    query = (
        sa.select(revision.c.id, revision.c.author, revision.c.time, revision.c.note, sa.func.count())
        .join(change, change.c.revision_id == revision.c.id)
        .where(*_below(prefix, key))
        .group_by(revision.c.id)
        .order_by(revision.c.id.desc())
        .limit(limit)
    )
    return [Revision(*row) for row in connection.execute(query)]


def read_changes(
    connection: sa.Connection, *wanted: sa.ColumnElement[bool], prefix: str | None = None, key: Sequence[str] | None = None
) -> list[Change]:
    """The changes that *wanted* chooses, below *prefix* (with *key*), oldest first."""
    columns = (change.c.revision_id, change.c.path, change.c.key, change.c.before, change.c.after)
    query = sa.select(*columns).where(*wanted, *_below(prefix, key)).order_by(change.c.revision_id, change.c.id)
    return [
        Change(number, path, key_from(key_json), row_from(path, before), row_from(path, after))
        for number, path, key_json, before, after in connection.execute(query)
    ]


def require_revision(connection: sa.Connection, number: int) -> None:
    """Raise `InputError` unless *number* is a revision, or 0 for the state before the first."""
    newest = newest_revision(connection)
    if not 0 <= number <= newest:
        raise InputError(f"there is no revision {number}; the newest is {newest}")


def difference(changes: Sequence[Change]) -> dict[Place, tuple[Row | None, Row | None]]:
    """What *changes*, oldest first, did in the end to each row: before and after; rows that came back are left out."""
    ends: dict[Place, tuple[Row | None, Row | None]] = {}
    for one in changes:
        place = (one.path, one.key)
        ends[place] = (ends[place][0] if place in ends else one.before, one.after)
    return {place: (before, after) for place, (before, after) in ends.items() if before != after}


def roll_back(rows: Flat, changes: Sequence[Change]) -> Flat:
    """*rows* as they were before *changes* (oldest first)."""
    result = dict(rows)
    for place, (before, _) in difference(changes).items():
        if before is None:
            result.pop(place, None)
        else:
            result[place] = before
    return result


def state_at(connection: sa.Connection, number: int) -> Flat:
    """Every row as it was at revision *number*; 0 is the empty store."""
    require_revision(connection, number)
    return roll_back(read_flat(connection, record), read_changes(connection, change.c.revision_id > number))
