"""A view of the store for those who may only look, and a program that is older than the database that it has open."""

import sqlite3
from contextlib import closing

import pytest
from store_cases import TEXT

import lipdb
from lipdb.errors import SchemaVersionError, StoreError
from lipdb.store import Store


@pytest.fixture
def store(tmp_path):
    with closing(Store.open(tmp_path / "a.db", TEXT)) as store:
        with store.edit(author="anna") as edit:
            edit.put("sources.tsv", {"source": "x", "title": "X", "licence": "CC0-1.0"})
        yield store


def test_a_view_reads_everything_and_every_way_to_write_is_refused(store, tmp_path):
    view = store.read_only()
    assert view.records() == store.records()
    assert view.history() == store.history()
    ways = {
        "edit": lambda: _edit(view),
        "undo": lambda: view.undo(2, author="eve"),
        "load": lambda: view.load(TEXT, author="eve"),
        "upgrade": view.upgrade,
        "scan": lambda: view.add_scan(None),
    }
    for name, way in ways.items():
        with pytest.raises(StoreError, match="for looking only"):
            way()
        assert view.revision == 2, name
    _edit(store)
    assert view.revision == 3


def _edit(store):
    with store.edit(author="eve") as edit:
        edit.delete("sources.tsv", ("x",))


def test_a_view_of_a_database_adds_no_character_and_copies_no_file(store, tmp_path):
    view = lipdb.Database(store).read_only()
    (tmp_path / "pictures").mkdir()
    with pytest.raises(StoreError, match="for looking only"):
        view.add_character(tmp_path / "pictures", name="eve", author="eve")
    with pytest.raises(StoreError, match="for looking only"), view.edit(author="eve") as edit:
        edit.delete("sources.tsv", ("x",))
    with pytest.raises(StoreError, match="for looking only"), view.at(2).edit(author="eve") as edit:
        edit.delete("sources.tsv", ("x",))
    assert not store.characters_folder.exists()


def test_nothing_is_written_into_a_database_that_was_upgraded_meanwhile(store):
    store.require_current()
    with closing(sqlite3.connect(store.where)) as newer:
        newer.execute("UPDATE alembic_version SET version_num = '9999'")
        newer.commit()
    with pytest.raises(SchemaVersionError, match="newer than this lipdb's"):
        store.require_current()
    with pytest.raises(SchemaVersionError, match="newer than this lipdb's"):
        _edit(store)
    assert store.revision == 2
