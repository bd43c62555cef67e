"""The schema of the database: which one it has, and the way to the newest. Alembic is imported only where it works."""

from __future__ import annotations

from typing import TYPE_CHECKING

import sqlalchemy as sa

from lipdb.errors import SchemaVersionError, StoreError
from lipdb.paths import data_dir
from lipdb.store.tables import OLDER_SCHEMAS, SCHEMA, metadata, version

if TYPE_CHECKING:
    from alembic.config import Config


def schema_of(connection: sa.Connection, where: str) -> str:
    """The schema that the database has; empty for a database without any table.

    Raises `StoreError` for a database that is not lipdb's.
    """
    tables = sa.inspect(connection).get_table_names()
    if not tables:
        return ""
    if version.name not in tables or "record" not in tables:
        raise StoreError(f"{where}: this database is not lipdb's (it holds {', '.join(sorted(tables)[:3])}); give another one with --db")
    return str(connection.scalar(sa.select(version.c.version_num)))


def require_current(schema: str, where: str) -> None:
    """Raise `SchemaVersionError` unless *schema* is this program's, `StoreError` when there is none."""
    if not schema:
        raise StoreError(f"{where}: there is no database yet; run: lipdb db init")
    if schema in OLDER_SCHEMAS:
        raise SchemaVersionError(f"{where}: the database has schema {schema}, this lipdb needs {SCHEMA}; run: lipdb db upgrade")
    if schema != SCHEMA:
        raise SchemaVersionError(f"{where}: the database has schema {schema}, newer than this lipdb's {SCHEMA}; install a newer lipdb")


def upgrade_schema(connection: sa.Connection) -> None:
    """Bring the tables to this program's schema, within the transaction of *connection*."""
    from alembic import command

    command.upgrade(alembic_config(connection), SCHEMA)


def schema_findings(connection: sa.Connection) -> list[str]:
    """How the tables of the database differ from this program's, a sentence each."""
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    context = MigrationContext.configure(connection, opts={"compare_type": True})
    return [f"the tables differ from lipdb's: {' '.join(map(str, difference))}" for difference in compare_metadata(context, metadata)]


def alembic_config(connection: sa.Connection) -> Config:
    """What Alembic's commands need to work on *connection*."""
    from alembic.config import Config

    config = Config()
    # A percent sign in the folder's name would be read as a variable.
    config.set_main_option("script_location", str(data_dir("migrations")).replace("%", "%%"))
    config.attributes["connection"] = connection
    return config
