"""Alembic runs this for every command: on the connection that lipdb hands over, or on the database at LIPDB_URL."""

from alembic import context

from lipdb.store.engines import database_url, make_engine, writing
from lipdb.store.tables import metadata


def run(connection):
    context.configure(
        connection=connection,
        target_metadata=metadata,
        render_as_batch=connection.dialect.name == "sqlite",
        transaction_per_migration=False,
        compare_type=True,
    )
    with context.begin_transaction():
        context.run_migrations()


if (given := context.config.attributes.get("connection")) is not None:
    run(given)
else:
    with writing(make_engine(database_url(), foreign_keys=False)).begin() as own:
        run(own)
