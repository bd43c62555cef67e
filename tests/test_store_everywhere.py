"""The same story on every kind of database: SQLite always, PostgreSQL when LIPDB_TEST_PG names a server.

LIPDB_TEST_PG is an address such as ``postgresql://postgres@localhost/postgres`` whose user may make databases: every
test makes one of its own and drops it.
"""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from uuid import uuid4

import pytest
import sqlalchemy as sa
from alembic import command
from store_cases import CURVES, KEY, TEXT

from lipdb.curated.folder import read_folder, write_folder
from lipdb.errors import ConflictError, SchemaVersionError, StoreError
from lipdb.store import Store
from lipdb.store.engines import database_url, make_engine, writing
from lipdb.store.migrate import alembic_config, schema_findings

SERVER = os.environ.get("LIPDB_TEST_PG")


@pytest.fixture(params=["sqlite", *(["postgresql"] if SERVER else [])])
def place(request, tmp_path) -> Iterator[str]:
    if request.param == "sqlite":
        yield str(tmp_path / "a.db")
        return
    name = f"lipdb_test_{uuid4().hex}"
    server = sa.create_engine(database_url(SERVER), isolation_level="AUTOCOMMIT")
    with server.connect() as connection:
        connection.execute(sa.text(f"CREATE DATABASE {name}"))
    try:
        yield database_url(SERVER).set(database=name).render_as_string(hide_password=False)
    finally:
        with server.connect() as connection:
            connection.execute(sa.text(f"DROP DATABASE {name} WITH (FORCE)"))
        server.dispose()


def curve(**cells: str) -> dict[str, str]:
    return {"left": "aa", "right": "bmp", "pose": "PBM", "keys": "0:0 1:1", "warp": "border", **cells}


def test_a_database_is_made_filled_edited_undone_dumped_and_loaded(place, tmp_path):
    with closing(Store.open(place, TEXT)) as store:
        assert store.records() == read_folder(TEXT)
        with store.edit(author="anna", note="ü 你好") as edit:
            edit.put(CURVES, curve(comment="ü 你好"))
            edit.put(CURVES, curve(pose="FV"))
            edit.delete(CURVES, ("aa", "_", "open"))
        assert [(one.number, one.author, one.note, one.rows) for one in store.history(limit=1)] == [(2, "anna", "ü 你好", 3)]
        assert [one.number for one in store.history(CURVES, KEY)] == [2, 1]
        assert len(store.diff(1, 2)) == 3
        with pytest.raises(ConflictError) as caught, store.edit(author="bob") as edit:
            edit.put(CURVES, curve(keys=""), expected_revision=1)
        assert caught.value.theirs["comment"] == "ü 你好"
        store.dump(tmp_path / "dump")
        assert store.undo(2, author="bob") == 3
        assert store.records() == store.at(1) == read_folder(TEXT)
        assert store.load(tmp_path / "dump", author="bob").revision == 4
        assert store.records() == store.at(2)
        assert store.check() == []


def test_a_database_that_is_there_is_opened_again(place):
    Store.open(place, TEXT).close()
    with closing(Store.open(place, TEXT)) as store:
        assert store.revision == 1


def test_newer_text_is_merged(place, tmp_path):
    records = read_folder(TEXT)
    records[CURVES][KEY]["keys"] = "0:0 1:0.8"
    records[CURVES]["bmp", "aa", "PBM"]["keys"] = "0:1 1:0"
    write_folder(records, tmp_path / "newer")
    with closing(Store.open(place, TEXT)) as store, store.edit(author="anna") as edit:
        edit.put(CURVES, curve())
    with closing(Store.open(place, tmp_path / "newer")) as store:
        assert store.outdated
        done = store.upgrade()
        assert [key for _, key in done.merge.followed] == [("bmp", "aa", "PBM")]
        assert [one.key for one in done.merge.conflicts] == [KEY]
        assert not store.outdated


def test_the_migrations_go_up_and_down_and_keep_the_rows(place):
    with closing(Store.open(place, TEXT)) as store, store.edit(author="anna") as edit:
        edit.put(CURVES, curve())
    engine = make_engine(database_url(place), foreign_keys=False)
    with writing(engine).begin() as connection:
        assert schema_findings(connection) == []
        command.downgrade(alembic_config(connection), "0001")
    engine.dispose()
    with pytest.raises(SchemaVersionError):
        Store.open(place, TEXT)
    with closing(Store.locate(place, TEXT)) as store:
        done = store.upgrade()
        assert (done.schema_before, [one.key for one in done.merge.kept]) == ("0001", [KEY])
        assert store.check() == []


def test_a_backup_is_a_sqlite_file_with_everything(place, tmp_path):
    with closing(Store.open(place, TEXT)) as store:
        with store.edit(author="anna") as edit:
            edit.put(CURVES, curve())
        store.backup(tmp_path / "backup.db")
        with closing(Store.open(tmp_path / "backup.db", TEXT)) as copy:
            assert copy.records() == store.records()
            assert copy.history() == store.history()
            assert copy.check() == []
            assert copy.undo(2, author="bob") == 3


def test_a_database_of_another_program_is_left_alone(place):
    engine = sa.create_engine(database_url(place))
    with engine.begin() as connection:
        connection.execute(sa.text("CREATE TABLE invoices (id INTEGER)"))
    engine.dispose()
    with pytest.raises(StoreError, match="not lipdb's"):
        Store.open(place, TEXT)


def test_colliding_writers_lose_nothing(place):
    def work(who: int) -> None:
        for i in range(5):
            while True:
                seen = store.record(CURVES, KEY)
                try:
                    with store.edit(author=f"worker{who}") as edit:
                        edit.put(CURVES, {**seen.row, "comment": f"{seen.row['comment']} {who}.{i}"}, expected_revision=seen.revision)
                    break
                except ConflictError:
                    pass

    with closing(Store.open(place, TEXT)) as store, ThreadPoolExecutor(8) as pool:
        list(pool.map(work, range(8)))
        words = store.record(CURVES, KEY).row["comment"].split()
        assert sorted(words) == sorted(f"{who}.{i}" for who in range(8) for i in range(5))
        assert store.revision == 41
        assert store.check() == []


def test_first_users_at_the_same_time_make_it_once(place):
    with ThreadPoolExecutor(4) as pool:
        stores = list(pool.map(lambda _: Store.open(place, TEXT), range(4)))
    assert [store.revision for store in stores] == [1] * 4
    for store in stores:
        store.close()
