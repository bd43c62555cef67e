"""Newer shipped text is merged three ways; databases of every older schema are upgraded and work."""

import shutil
import sys
from contextlib import closing
from pathlib import Path

import pytest
import sqlalchemy as sa
from alembic import command
from alembic.script import ScriptDirectory
from hypothesis import given
from hypothesis import strategies as st
from store_cases import CURVES, DATABASES, TEXT

from lipdb.curated.folder import read_folder, write_folder
from lipdb.curated.schema import TABLES
from lipdb.errors import SchemaVersionError
from lipdb.store import Store
from lipdb.store.engines import database_url, make_engine, writing
from lipdb.store.merge import merge
from lipdb.store.migrate import alembic_config, schema_findings
from lipdb.store.tables import OLDER_SCHEMAS, SCHEMA


def changed(tmp_path: Path, *rows: tuple[tuple[str, ...], str | None]) -> Path:
    """The text in a new folder, in which the curves of *rows* have other keys, or are gone."""
    records = read_folder(TEXT)
    for key, keys in rows:
        if keys is None:
            del records[CURVES][key]
        else:
            records[CURVES][key] = {
                **records[CURVES][("aa", "bmp", "PBM")],
                **dict(zip(("left", "right", "pose"), key, strict=True)),
                "keys": keys,
            }
    folder = tmp_path / "newer"
    write_folder(records, folder)
    return folder


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "a.db"
    store = Store.open(file, TEXT)
    with store.edit(author="anna") as edit:
        edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": "PBM", "keys": "0:0 1:1", "warp": "border"})
        edit.delete(CURVES, ("aa", "_", "open"))
        edit.put(CURVES, {"left": "aa", "right": "aa", "pose": "open", "keys": "0:1 1:1", "warp": "border"})
    store.close()
    return file


def upgraded(file: Path, folder: Path):
    store = Store.open(file, folder)
    return store, store.upgrade()


def test_rows_that_nobody_edited_follow_newer_text(file, tmp_path):
    newer = changed(tmp_path, (("bmp", "aa", "PBM"), "0:1 1:0"), (("bmp", "aa", "open"), None), (("_", "aa", "W"), "0:0 1:0.1"))
    store, done = upgraded(file, newer)
    assert {key for _, key in done.merge.followed} == {("bmp", "aa", "PBM"), ("bmp", "aa", "open"), ("_", "aa", "W")}
    assert done.merge.conflicts == ()
    rows = store.records()[CURVES]
    assert rows["bmp", "aa", "PBM"]["keys"] == "0:1 1:0"
    assert ("bmp", "aa", "open") not in rows
    assert ("_", "aa", "W") in rows
    assert (store.history(limit=1)[0].author, done.revision) == ("lipdb", store.revision)
    assert store.check() == []
    store.close()


def test_edited_added_and_deleted_rows_stay(file, tmp_path):
    store, done = upgraded(file, changed(tmp_path, (("bmp", "aa", "PBM"), "0:1 1:0")))
    assert [one.key for one in done.merge.kept] == [("aa", "_", "open"), ("aa", "aa", "open"), ("aa", "bmp", "PBM")]
    rows = store.records()[CURVES]
    assert rows["aa", "bmp", "PBM"]["author"] == "anna"
    assert ("aa", "aa", "open") in rows
    assert ("aa", "_", "open") not in rows
    store.close()


def test_rows_that_both_sides_changed_stay_and_are_listed_with_both_versions(file, tmp_path):
    newer = changed(tmp_path, (("aa", "bmp", "PBM"), "0:0 1:0.8"), (("aa", "_", "open"), "0:1 1:0"), (("aa", "aa", "open"), "0:1 1:0.5"))
    store, done = upgraded(file, newer)
    sides = {one.key: (one.mine and one.mine["keys"], one.theirs and one.theirs["keys"]) for one in done.merge.conflicts}
    assert sides == {
        ("aa", "bmp", "PBM"): ("0:0 1:1", "0:0 1:0.8"),
        ("aa", "_", "open"): (None, "0:1 1:0"),
        ("aa", "aa", "open"): ("0:1 1:1", "0:1 1:0.5"),
    }
    assert done.revision is None
    assert store.records()[CURVES]["aa", "bmp", "PBM"]["keys"] == "0:0 1:1"
    store.close()


def test_an_edited_row_that_the_newer_text_drops_is_a_conflict(file, tmp_path):
    store, done = upgraded(file, changed(tmp_path, (("aa", "bmp", "PBM"), None)))
    assert [(one.key, one.theirs) for one in done.merge.conflicts] == [(("aa", "bmp", "PBM"), None)]
    store.close()


def test_an_edit_that_the_newer_text_makes_too_is_settled(file, tmp_path):
    store = Store.open(file, TEXT)
    records = store.records()
    write_folder(records, tmp_path / "newer")
    store.close()
    store, done = upgraded(file, tmp_path / "newer")
    assert (done.merge.followed, done.merge.kept, done.merge.conflicts) == ({}, (), ())
    store.close()


def test_a_second_upgrade_finds_nothing_more_to_do(file, tmp_path):
    newer = changed(tmp_path, (("aa", "bmp", "PBM"), "0:0 1:0.8"), (("bmp", "aa", "PBM"), "0:1 1:0"))
    store, _ = upgraded(file, newer)
    revision = store.revision
    again = store.upgrade()
    assert (again.revision, again.merge.followed, again.merge.conflicts) == (None, {}, ())
    assert store.revision == revision
    store.close()


def test_a_store_knows_whether_newer_text_waits_to_be_merged(file, tmp_path):
    store = Store.open(file, TEXT)
    assert not store.outdated
    store.close()
    store = Store.open(file, changed(tmp_path, (("bmp", "aa", "PBM"), "0:1 1:0")))
    assert store.outdated
    store.upgrade()
    assert not store.outdated
    store.close()


def test_text_that_was_loaded_does_not_wait_to_be_merged(file, tmp_path):
    newer = changed(tmp_path, (("bmp", "aa", "PBM"), "0:1 1:0"))
    store = Store.open(file, newer)
    loaded = store.load(newer, author="anna")
    assert not store.outdated
    store.undo(loaded.revision, author="anna")
    again = store.upgrade()
    assert (again.revision, again.merge.conflicts) == (None, ())
    assert ("bmp", "aa", "PBM") in [one.key for one in again.merge.kept]  # taken back on purpose
    store.close()


def test_text_of_another_folder_that_was_loaded_is_not_the_one_to_merge(file, tmp_path):
    store = Store.open(file, changed(tmp_path, (("bmp", "aa", "PBM"), "0:1 1:0")))
    store.load(TEXT, author="anna")
    assert store.outdated
    store.close()


VALUES = st.none() | st.sampled_from(["0:0 1:1", "0:1 1:0", ""])


@given(st.lists(st.tuples(VALUES, VALUES, VALUES), max_size=6))
def test_a_merge_never_changes_an_edited_row_nor_holds_back_an_unedited_one(sides):
    base, text, mine = (
        {("a.tsv", (str(i),)): {"keys": row[side]} for i, row in enumerate(sides) if row[side] is not None} for side in range(3)
    )
    outcome = merge(base, text, mine)
    merged = {place: row for place, row in {**mine, **outcome.followed}.items() if row is not None}
    for i in range(len(sides)):
        place = ("a.tsv", (str(i),))
        if mine.get(place) == base.get(place):
            assert merged.get(place) == text.get(place)
        else:
            assert merged.get(place) == mine.get(place)
    listed = {(one.path, one.key) for one in (*outcome.kept, *outcome.conflicts)}
    assert listed == {place for place in mine.keys() | text.keys() if merged.get(place) != text.get(place)}


class TestSchema:
    """Alembic's migrations and the program's idea of them."""

    @pytest.fixture
    def engine(self, tmp_path):
        engine = make_engine(database_url(tmp_path / "a.db"), foreign_keys=False)
        yield engine
        engine.dispose()

    def test_the_program_needs_the_newest_migration_and_knows_every_older_one(self, engine):
        with engine.connect() as connection:
            scripts = ScriptDirectory.from_config(alembic_config(connection))
        assert scripts.get_current_head() == SCHEMA
        assert [script.revision for script in scripts.walk_revisions()] == [SCHEMA, *reversed(OLDER_SCHEMAS)]

    def test_the_migrations_make_the_tables_of_the_program_and_take_them_back(self, engine):
        with writing(engine).begin() as connection:
            config = alembic_config(connection)
            for _ in range(2):
                command.upgrade(config, "head")
                assert schema_findings(connection) == []
                command.downgrade(config, "base")
                assert sa.inspect(connection).get_table_names() == ["alembic_version"]

    def test_a_database_of_every_schema_is_kept(self):
        assert sorted(file.stem for file in DATABASES.glob("*.db")) == [*OLDER_SCHEMAS, SCHEMA]

    @pytest.mark.parametrize("schema", OLDER_SCHEMAS)
    def test_an_older_database_names_the_command_that_upgrades_it(self, tmp_path, schema):
        shutil.copy(DATABASES / f"{schema}.db", tmp_path / "a.db")
        with pytest.raises(SchemaVersionError, match=f"schema {schema}, this lipdb needs {SCHEMA}; run: lipdb db upgrade"):
            Store.open(tmp_path / "a.db", TEXT)

    def test_a_newer_database_names_its_schema_and_asks_for_a_newer_program(self, tmp_path, engine):
        Store.open(tmp_path / "a.db", TEXT).close()
        with engine.begin() as connection:
            connection.exec_driver_sql("UPDATE alembic_version SET version_num = '0999'")
        for use in (Store.open, lambda *place: Store.locate(*place).upgrade(), lambda *place: Store.locate(*place).check()):
            with pytest.raises(SchemaVersionError, match=f"schema 0999, newer than this lipdb's {SCHEMA}; install a newer lipdb"):
                use(tmp_path / "a.db", TEXT)

    @pytest.mark.parametrize("schema", [*OLDER_SCHEMAS, SCHEMA])
    def test_a_database_of_every_schema_is_upgraded_and_works(self, tmp_path, schema):
        shutil.copy(DATABASES / f"{schema}.db", tmp_path / "a.db")
        done = Store.locate(tmp_path / "a.db", TEXT).upgrade()
        store = Store.open(tmp_path / "a.db", TEXT)
        assert (done.schema_before, done.schema) == (schema, SCHEMA)
        assert [one.note for one in store.history("curves/")][-4:] == [
            "Close by itself",
            "Softer release",
            "Less open before the lips close",
            "Fill from the shipped text",
        ]
        assert store.record(CURVES, ("aa", "bmp", "open")).row["keys"] == "0:0.6 0.4:0.2 1:0"
        assert store.check() == []

        with store.edit(author="bob") as edit:
            edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": "FV", "keys": "0:0 1:1", "warp": "border"})
        edited = store.records()
        store.undo(store.undo(edit.revision, author="bob"), author="bob")
        assert store.records() == edited
        store.undo(3, author="bob")
        assert store.record(CURVES, ("bmp", "aa", "PBM")).row["origin"] == "generated"
        store.dump(tmp_path / "dump")
        store.load(TEXT, author="bob")
        store.load(tmp_path / "dump", author="bob")
        assert store.records() == read_folder(tmp_path / "dump")
        assert store.check() == []
        store.close()

    def test_the_oldest_database_follows_the_text_from_which_it_was_filled(self, tmp_path):
        shutil.copy(DATABASES / "0001.db", tmp_path / "a.db")
        done = Store.locate(tmp_path / "a.db", TEXT).upgrade().merge
        assert set(done.followed) == {
            (CURVES, ("aa", "bmp", "PBM")),
            (CURVES, ("bmp", "bmp", "open")),
            ("constraints/facefx.tsv", ("open", "PBM")),
            ("sources.tsv", ("user",)),
        }
        assert {one.key for one in done.kept} == {("aa", "bmp", "open"), ("aa", "_", "open")}
        assert {one.key for one in done.conflicts} == {("bmp", "aa", "PBM")}


def test_opening_an_up_to_date_database_does_not_import_alembic(file, monkeypatch):
    for name in [name for name in sys.modules if name.split(".")[0] == "alembic"]:
        monkeypatch.delitem(sys.modules, name)
    store = Store.open(file, TEXT)
    assert store.records()
    store.close()
    assert "alembic" not in sys.modules


def test_opening_and_reading_asks_no_more_questions_of_five_thousand_rows_than_of_a_few(tmp_path):
    file = tmp_path / "a.db"
    asked: list[str] = []

    def count(_connection, _cursor, statement, *_others) -> None:
        asked.append(statement)

    def questions() -> int:
        asked.clear()
        with closing(Store.open(file, TEXT)) as store:
            store.records()
        return len(asked)

    sa.event.listen(sa.Engine, "before_cursor_execute", count)
    try:
        Store.open(file, TEXT).close()
        few = questions()
        with closing(Store.open(file, TEXT)) as store, store.edit(author="anna") as edit:
            for i in range(5000):
                edit.put(CURVES, {"left": f"a{i}", "right": "bmp", "pose": "PBM", "keys": "0:0 0.25:0.5 0.5:0.9 1:1", "warp": "border"})
        assert questions() == few > 0
    finally:
        sa.event.remove(sa.Engine, "before_cursor_execute", count)


def test_a_change_of_columns_comes_with_a_migration():
    """The store keeps rows as they were written: a table with other columns needs a migration of the stored cells.

    After it is written (and before the first release without one): write ``columns.tsv`` again, from `columns_now`.
    """
    assert (DATABASES / "columns.tsv").read_text() == columns_now()


def columns_now() -> str:
    lines = [f"{table.pattern}\t{' '.join(table.names)}\t{' '.join(table.key)}" for table in TABLES]
    return "\n".join([f"schema\t{SCHEMA}\t", *sorted(lines)]) + "\n"
