"""Find revisions: by who made them, and by what they are about."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

import sqlalchemy as sa

from lipdb.curated.schema import table_of
from lipdb.store.cells import key_text
from lipdb.store.history import Change, Revision
from lipdb.store.tables import change, revision

CURVES, MAPPING = "curves", "mapping"


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which revisions: those by *author* with *words* in their note that changed a row of this kind. Empty: any.

    *kind* is one that `kind_of` names; *pair* are the common phones of a curve.
    """

    author: str = ""
    words: str = ""
    kind: str = ""
    language: str = ""
    character: str = ""
    pair: tuple[str, str] | None = None


def kind_of(path: str) -> str:
    """What the table at *path* is about: the name of its file, or of the folder in which there is one a pose set or corpus."""
    table = table_of(path)
    parts = PurePosixPath(table.pattern if table else path).with_suffix("").parts
    return next(part for part in reversed(parts) if not part.startswith("{"))


def find_revisions(connection: sa.Connection, wanted: Wanted, *, limit: int | None = None) -> list[Revision]:
    """The revisions that *wanted* names, newest first; `Revision.rows` counts the rows that it names, too."""
    query = (
        sa.select(revision.c.id, revision.c.author, revision.c.time, revision.c.note, sa.func.count())
        .join(change, change.c.revision_id == revision.c.id)
        .where(*_rows(wanted, connection.scalars(sa.select(change.c.path).distinct())), *_made(wanted))
        .group_by(revision.c.id)
        .order_by(revision.c.id.desc())
        .limit(limit)
    )
    return [Revision(*row) for row in connection.execute(query)]


def changes_named(wanted: Wanted, changes: Sequence[Change]) -> list[Change]:
    """Those of *changes* that *wanted* names: the rows that `find_revisions` counts."""
    whole, by_key = map(set, _tables(wanted, {one.path for one in changes}))
    rows = [one for one in changes if one.path in whole or (one.path in by_key and one.key[0] == wanted.language)]
    return [one for one in rows if one.key[:2] == wanted.pair] if wanted.pair else rows


def read_authors(connection: sa.Connection) -> list[str]:
    """Everybody who has made a revision, sorted."""
    return list(connection.scalars(sa.select(revision.c.author).distinct().order_by(revision.c.author)))


def read_kinds(connection: sa.Connection) -> list[str]:
    """The kinds of tables that have ever changed, sorted."""
    return sorted({kind_of(path) for path in connection.scalars(sa.select(change.c.path).distinct())})


def _made(wanted: Wanted) -> list[sa.ColumnElement[bool]]:
    made = [revision.c.author == wanted.author] if wanted.author else []
    return [*made, revision.c.note.icontains(wanted.words, autoescape=True)] if wanted.words else made


def _rows(wanted: Wanted, paths: Iterable[str]) -> list[sa.ColumnElement[bool]]:
    """Conditions on rows; *paths* are those of all tables."""
    rows: list[sa.ColumnElement[bool]] = []
    if wanted.pair:
        rows.append(change.c.key.startswith(key_text(wanted.pair)[:-1] + ",", autoescape=True))
    if not (wanted.pair or wanted.kind or wanted.language or wanted.character):
        return rows
    whole, by_key = _tables(wanted, paths)
    in_key = change.c.key.startswith(key_text([wanted.language])[:-1] + ",", autoescape=True)
    return [*rows, sa.or_(change.c.path.in_(whole), sa.and_(change.c.path.in_(by_key), in_key))]


def _tables(wanted: Wanted, paths: Iterable[str]) -> tuple[list[str], list[str]]:
    """Of the tables at *paths* those that *wanted* names, and those of which it names the rows with its language in their key."""
    kind = CURVES if wanted.pair else wanted.kind
    whole, by_key = [], []
    for path in paths:
        table = table_of(path)
        parts = (table.parts(path) if table else None) or {}
        if (kind and kind_of(path) != kind) or (wanted.character and parts.get("character") != wanted.character):
            continue
        if not wanted.language or parts.get("language") == wanted.language:
            whole.append(path)
        elif kind_of(path) == MAPPING:  # a character's own mapping has the language in its key
            by_key.append(path)
    return whole, by_key
