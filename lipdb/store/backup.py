"""A copy of a store as one SQLite file, with its history. Works while others edit."""

from __future__ import annotations

from pathlib import Path

import sqlalchemy as sa

from lipdb.files import whole_file
from lipdb.store.engines import make_engine
from lipdb.store.failures import plain_errors
from lipdb.store.migrate import upgrade_schema
from lipdb.store.tables import metadata

_ROWS = 10_000


def back_up(source: sa.Connection, file: Path) -> None:
    """Copy the whole store of *source* to the SQLite file *file*, in place of an older one.

    Raises `OutputError` when the folder can't be written; *file* is then as it was before.
    """
    with whole_file(file) as temporary, plain_errors(str(file)):
        engine = make_engine(sa.URL.create("sqlite", database=str(temporary)), foreign_keys=False)
        try:
            if source.dialect.name == "sqlite":
                _copy_pages(source, engine)
            else:
                _copy_rows(source, engine)
        finally:
            engine.dispose()
            Path(f"{temporary}-journal").unlink(missing_ok=True)  # of a copy that a full disk cut off


def _copy_pages(source: sa.Connection, target: sa.Engine) -> None:
    copy = target.raw_connection()
    try:
        source.connection.driver_connection.backup(copy.driver_connection)  # type: ignore[union-attr]
    finally:
        copy.close()


def _copy_rows(source: sa.Connection, target: sa.Engine) -> None:
    with target.begin() as copy:
        upgrade_schema(copy)
        for table in metadata.sorted_tables:
            for rows in source.execute(sa.select(table)).mappings().partitions(_ROWS):
                copy.execute(sa.insert(table), [dict(row) for row in rows])
