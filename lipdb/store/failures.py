"""What databases say when something goes wrong, as one line that says what to do."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager

import sqlalchemy as sa

from lipdb.errors import MissingToolError, StoreError

_DAMAGED = "the database is damaged; put a backup in its place, or move it away and a new one is made"
_SQLITE = {
    "SQLITE_BUSY": "the database is locked by another program; close it or try again in a moment",
    "SQLITE_LOCKED": "the database is locked by another program; close it or try again in a moment",
    "SQLITE_NOTADB": "this file is not a database; give another one with --db, or move it away and a new one is made",
    "SQLITE_CORRUPT": _DAMAGED,
    "SQLITE_READONLY": "the database can't be written (file or folder is read-only); choose another place with --db",
    "SQLITE_PERM": "the database can't be written (file or folder is read-only); choose another place with --db",
    "SQLITE_CANTOPEN": "the database can't be opened (no such folder, or no right to it); give another place with --db",
    "SQLITE_FULL": "there is no space left for the database; nothing was saved, free some space and try again",
    "SQLITE_IOERR": "the disk did not take or give the data (full, or removed); nothing was saved, free some space and try again",
}


def _sentence(error: BaseException) -> str:
    name = getattr(error, "sqlite_errorname", None)
    if isinstance(name, str):
        # Extended codes begin with the plain one: SQLITE_IOERR_WRITE, SQLITE_READONLY_DBMOVED.
        plain = "_".join(name.split("_")[:2])
        if plain in _SQLITE:
            return _SQLITE[plain]
    if "decode to UTF-8" in str(error):
        return _DAMAGED
    return f"the database says: {' '.join(str(error).split())}"


@contextmanager
def plain_errors(where: str) -> Iterator[None]:
    """Turn the database's errors into `StoreError` with one line; *where* names the database, without a password."""
    try:
        yield
    except sa.exc.DBAPIError as error:
        raise StoreError(f"{where}: {_sentence(error.orig or error)}") from error
    except sqlite3.Error as error:
        raise StoreError(f"{where}: {_sentence(error)}") from error
    except json.JSONDecodeError as error:  # keys and cells are JSON; see `lipdb.store.cells`
        raise StoreError(f"{where}: {_DAMAGED}") from error
    except ModuleNotFoundError as error:
        if error.name != "psycopg":
            raise
        raise MissingToolError(f"{where}: PostgreSQL needs one more package; run: pip install 'lipdb[postgres]'") from error
