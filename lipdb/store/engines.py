"""Connections: which database, and how SQLite is set up for many readers and colliding writers.

SQLite keeps its rollback journal. The write-ahead log would let readers and a writer pass each other, but it can damage
a file before SQLite 3.51.3, can't be read in a folder that is read-only, and makes three files of one; a hundred
edits a second are enough.
"""

from __future__ import annotations

import os
import sqlite3
from pathlib import Path
from typing import Any

import sqlalchemy as sa

from lipdb.errors import StoreError
from lipdb.paths import DATABASE, expanded, home

BUSY_MILLISECONDS = 5000
WRITER_LOCK = 0x6C697064  # "lipd": PostgreSQL's advisory lock that writers take in turn.
_DRIVERS = {
    "sqlite": "sqlite",
    "postgres": "postgresql+psycopg",
    "postgresql": "postgresql+psycopg",
    "postgresql+psycopg": "postgresql+psycopg",
}
_SMALLEST_FILE = 512  # Bytes: one page of the smallest size.


def database_url(place: str | Path | None = None) -> sa.URL:
    """The address of the database: *place*, else ``LIPDB_URL``, else a SQLite file in the user's data folder.

    A place without ``://`` is a SQLite file. Raises `StoreError` for an address that can't be read.
    """
    text = str(place or os.environ.get("LIPDB_URL") or home() / DATABASE)
    if "://" not in text:
        return sa.URL.create("sqlite", database=str(expanded(text).absolute()))
    shown = text.rpartition("@")[2]
    try:
        url = sa.make_url(text)
    except (sa.exc.ArgumentError, ValueError) as error:
        raise StoreError(f"{shown}: not the address of a database; give a file, or postgresql://user@host/name") from error
    driver = _DRIVERS.get(url.drivername)
    if driver is None:
        raise StoreError(f"{shown}: lipdb keeps its data in SQLite or PostgreSQL; give a file, or postgresql://user@host/name")
    if driver == "sqlite" and url.database in (None, "", ":memory:"):
        raise StoreError(f"{shown}: a database in memory would be empty for every connection; give a file")
    if driver == "sqlite" and url.query:
        raise StoreError(f"{shown}: a SQLite file takes no options; leave out what stands after the question mark")
    return url.set(drivername=driver)


def place_of(url: sa.URL) -> str:
    """How *url* is named in messages: the file, or the address without its password."""
    return str(url.database) if is_file(url) else url.render_as_string(hide_password=True)


def is_file(url: sa.URL) -> bool:
    """Whether *url* is a SQLite file."""
    return url.get_backend_name() == "sqlite"


def has_content(url: sa.URL) -> bool:
    """Whether the SQLite file at *url* is there and not empty; True for other databases.

    Raises `StoreError` for a file too short for a database, which SQLite would take for an empty one.
    """
    if not is_file(url):
        return True
    # Never open and close the file itself: that would drop the locks that this process holds on it (POSIX), and
    # two writers at once damage it.
    try:
        size = Path(place_of(url)).stat().st_size
    except FileNotFoundError:
        return False
    except OSError as error:
        raise StoreError(f"{place_of(url)}: the database can't be opened ({error.strerror}); give another one with --db") from error
    if 0 < size < _SMALLEST_FILE:
        raise StoreError(f"{place_of(url)}: this file is not a database; give another one with --db, or move it away and a new one is made")
    return size > 0


def make_engine(url: sa.URL, *, foreign_keys: bool = True) -> sa.Engine:
    """An engine for *url*; take `reading` or `writing` of it for transactions.

    Migrations that rebuild a table turn *foreign_keys* off, as SQLite wants it.
    """
    engine = sa.create_engine(url)
    if engine.dialect.name == "sqlite":
        sa.event.listen(engine, "connect", _prepare(foreign_keys))
    sa.event.listen(engine, "begin", _begin)
    return engine


def writing(engine: sa.Engine) -> sa.Engine:
    """*engine* for writers: a transaction waits for its turn at its start, so it never fails half-way for a lock."""
    return engine.execution_options(lipdb_writes=True)


def reading(engine: sa.Engine) -> sa.Engine:
    """*engine* for readers: everything read in one transaction belongs to one state of the database."""
    # SQLite's transactions do that anyway. Writers must not: they take the state after they waited for their turn.
    return engine if engine.dialect.name == "sqlite" else engine.execution_options(isolation_level="REPEATABLE READ")


def _prepare(foreign_keys: bool) -> Any:
    def prepare(connection: sqlite3.Connection, _record: object) -> None:
        connection.isolation_level = None  # Python would begin transactions late, and as readers'; `_begin` does it.
        connection.execute(f"PRAGMA busy_timeout={BUSY_MILLISECONDS}")
        connection.execute(f"PRAGMA foreign_keys={'ON' if foreign_keys else 'OFF'}")

    return prepare


def _begin(connection: sa.Connection) -> None:
    writes = connection.get_execution_options().get("lipdb_writes", False)
    if connection.dialect.name == "sqlite":
        connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
    elif writes:
        connection.exec_driver_sql(f"SELECT pg_advisory_xact_lock({WRITER_LOCK})")


def description(engine: sa.Engine) -> str:
    """The kind of database and its version, for a person to read."""
    return f"SQLite {sqlite3.sqlite_version}" if engine.dialect.name == "sqlite" else "PostgreSQL"
