"""Write revisions, and ask about the rows that they change. Everything here works inside a caller's transaction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, islice
from operator import itemgetter
from typing import Any

import sqlalchemy as sa

from lipdb.curated.tsv import Row
from lipdb.errors import InputError
from lipdb.store.cells import Flat, Place, cells_text, flat, key_text, records_from, row_from
from lipdb.store.tables import change, record, revision

_CHUNK = 500  # Keys in one query; older builds of SQLite take 999 values.


@dataclass(frozen=True, slots=True)
class Present:
    """A row as it is stored, and the revision that changed it last."""

    row: Row
    revision: int


@dataclass(frozen=True, slots=True)
class Changed:
    """One row of a revision: what it was and what it became; None for a row that was not there."""

    place: Place
    before: Row | None
    after: Row | None


def one_line(text: str) -> str:
    """*text* on one line, without bytes that are no text (as a terminal may pass them on)."""
    return " ".join(text.encode(errors="replace").decode().split())


def author_name(author: str) -> str:
    """*author* on one line. Raises `InputError` when nothing is left: every change names who made it."""
    name = one_line(author)
    if not name:
        raise InputError("edit: there is no author; every change names who made it")
    return name


def write(connection: sa.Connection, changes: Sequence[Changed], *, author: str, time: str, note: str) -> int:
    """Make one revision of *changes* and apply them to the records; its number."""
    number = newest_revision(connection) + 1
    signature = {"author": author_name(author), "time": time, "note": one_line(note)}
    connection.execute(sa.insert(revision), {"id": number, **signature})
    log = [
        {"revision_id": number, "path": one.place[0], "key": key_text(one.place[1]), "before": _text(one.before), "after": _text(one.after)}
        for one in changes
    ]
    connection.execute(sa.insert(change), log)
    _apply(connection, log)
    return number


def _text(row: Row | None) -> str | None:
    return None if row is None else cells_text(row)


def _apply(connection: sa.Connection, log: Sequence[Mapping[str, Any]]) -> None:
    """Do to the records what *log*, rows of `change`, says."""
    named = record.c.path == sa.bindparam("_path"), record.c.key == sa.bindparam("_key")
    gone, kept, new = [], [], []
    for one in log:
        now = {"cells": one["after"], "revision": one["revision_id"]}
        if one["after"] is None:
            gone.append({"_path": one["path"], "_key": one["key"]})
        elif one["before"] is None:
            new.append({"path": one["path"], "key": one["key"], **now})
        else:
            kept.append({"_path": one["path"], "_key": one["key"], **now})
    for statement, rows in ((sa.delete(record).where(*named), gone), (sa.update(record).where(*named), kept), (sa.insert(record), new)):
        if rows:
            connection.execute(statement, rows)


def newest_revision(connection: sa.Connection) -> int:
    """The number of the newest revision, 0 when there is none."""
    return int(connection.scalar(sa.select(sa.func.max(revision.c.id))) or 0)


def last_change(connection: sa.Connection, place: Place) -> int:
    """The newest revision that changed the row at *place*, 0 when none did."""
    query = sa.select(sa.func.max(change.c.revision_id)).where(change.c.path == place[0], change.c.key == key_text(place[1]))
    return int(connection.scalar(query) or 0)


def author_of(connection: sa.Connection, number: int) -> str:
    """Who made revision *number*."""
    return str(connection.scalar(sa.select(revision.c.author).where(revision.c.id == number)))


def present_rows(connection: sa.Connection, places: Mapping[Place, object]) -> dict[Place, Present]:
    """The stored rows at *places*, those that are there."""
    found: dict[Place, Present] = {}
    for path, group in groupby(sorted(places), key=itemgetter(0)):
        keys = iter({key_text(key): key for _, key in group}.items())
        while chunk := dict(islice(keys, _CHUNK)):
            query = sa.select(record.c.key, record.c.cells, record.c.revision).where(record.c.path == path, record.c.key.in_(chunk))
            for text, cells, number in connection.execute(query):
                found[path, chunk[text]] = Present(row_from(path, cells) or {}, number)
    return found


def read_flat(connection: sa.Connection, table: sa.Table) -> Flat:
    """Every row of *table*, which is `record` or `shipped`."""
    return flat(records_from(connection.execute(sa.select(table.c.path, table.c.key, table.c.cells)).all()))
