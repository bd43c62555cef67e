"""Write revisions, and ask about the rows that they change. Everything here works inside a caller's transaction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, islice
from operator import itemgetter

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


def author_name(author: str) -> str:
    """*author* on one line. Raises `InputError` when nothing is left: every change names who made it."""
    name = " ".join(author.split())
    if not name:
        raise InputError("edit: there is no author; every change names who made it")
    return name


def write(connection: sa.Connection, changes: Sequence[Changed], *, author: str, time: str, note: str) -> int:
    """Make one revision of *changes* and apply them to the records; its number."""
    number = newest_revision(connection) + 1
    signature = {"author": author_name(author), "time": time, "note": " ".join(note.split())}
    connection.execute(sa.insert(revision), {"id": number, **signature})
    texts = [_texts(changed) for changed in changes]
    connection.execute(sa.insert(change), [{"revision_id": number, **text} for text in texts])
    _apply(connection, sa.delete(record).where(*_named()), [t for t in texts if t["after"] is None], number)
    _apply(
        connection,
        sa.update(record).where(*_named()).values(cells=sa.bindparam("_after"), revision=sa.bindparam("_number")),
        [t for t in texts if t["before"] is not None and t["after"] is not None],
        number,
    )
    new = [t for t in texts if t["before"] is None]
    if new:
        connection.execute(sa.insert(record), [{"path": t["path"], "key": t["key"], "cells": t["after"], "revision": number} for t in new])
    return number


def _texts(changed: Changed) -> dict[str, str | None]:
    (path, key), before, after = changed.place, changed.before, changed.after
    return {
        "path": path,
        "key": key_text(key),
        "before": None if before is None else cells_text(before),
        "after": None if after is None else cells_text(after),
    }


def _named() -> tuple[sa.ColumnElement[bool], ...]:
    return record.c.path == sa.bindparam("_path"), record.c.key == sa.bindparam("_key")


def _apply(connection: sa.Connection, statement: sa.Update | sa.Delete, texts: Sequence[Mapping[str, str | None]], number: int) -> None:
    if texts:
        names = statement.compile().params
        every = [{"_path": t["path"], "_key": t["key"], "_after": t["after"], "_number": number} for t in texts]
        connection.execute(statement, [{name: values[name] for name in names} for values in every])


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
                found[path, chunk[text]] = Present(row_from(cells) or {}, number)
    return found


def read_flat(connection: sa.Connection, table: sa.Table) -> Flat:
    """Every row of *table*, which is `record` or `shipped`."""
    return flat(records_from(connection.execute(sa.select(table.c.path, table.c.key, table.c.cells)).all()))
