"""Make a store, and bring an older one's tables up to date: each in one transaction, whoever comes second waits."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import sqlalchemy as sa

from lipdb.curated.folder import read_checked_folder
from lipdb.errors import StoreError
from lipdb.paths import home
from lipdb.store.engines import is_file, make_engine, place_of, writing
from lipdb.store.failures import plain_errors
from lipdb.store.migrate import require_current, schema_of, upgrade_schema
from lipdb.store.shipped import fill, text_digest
from lipdb.store.tables import OLDER_SCHEMAS


def create(url: sa.URL, phonesets: Path, *, time: str) -> None:
    """Make the tables at *url* and fill them from *phonesets*. Does nothing when another program did it meanwhile."""
    records, digest = read_checked_folder(phonesets), text_digest(phonesets)
    _make_room(url)
    with _migrating(url) as connection:
        if not schema_of(connection, place_of(url)):
            upgrade_schema(connection)
            fill(connection, records, digest, time=time)


def upgrade_tables(url: sa.URL) -> None:
    """Bring the tables of the store at *url* to this program's schema.

    Raises `SchemaVersionError` when they are newer than that.
    """
    with _migrating(url) as connection:
        schema = schema_of(connection, place_of(url))
        if schema in OLDER_SCHEMAS:
            upgrade_schema(connection)
        else:
            require_current(schema, place_of(url))


def _make_room(url: sa.URL) -> None:
    """Make the user's data folder when the database goes there; any other folder must be there."""
    if not is_file(url):
        return
    folder = Path(place_of(url)).parent
    try:
        if folder == home().absolute():
            folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(f"{folder}: can't make this folder ({error.strerror}); choose another place with --db") from error
    if not folder.is_dir():
        raise StoreError(f"{place_of(url)}: the folder {folder} is not there; make it first, or choose another place with --db")


@contextmanager
def _migrating(url: sa.URL) -> Iterator[sa.Connection]:
    import alembic.command  # noqa: F401  (slow to import: not while others wait for the lock)

    with plain_errors(place_of(url)):
        engine = make_engine(url, foreign_keys=False)
        try:
            with writing(engine).begin() as connection:
                yield connection
        finally:
            # SQLite takes its journal away when the connection closes: after a full disk, too.
            engine.dispose()
