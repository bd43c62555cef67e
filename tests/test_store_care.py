"""Text in and out while others edit, backups, and the check of everything."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from store_cases import CURVES, KEY, TEXT

from lipdb.curated.folder import read_folder, write_folder
from lipdb.errors import ConflictError, InputError, PhonesetError
from lipdb.store import Loaded, Store


def put(store: Store, pose: str, keys: str, *, author: str) -> None:
    with store.edit(author=author) as edit:
        edit.put(CURVES, {"left": "aa", "right": "bmp", "pose": pose, "keys": keys, "warp": "border"})


def rewritten(folder: Path, key: tuple[str, ...], keys: str) -> Path:
    """The text in *folder* with other keys for one curve, as with an editor."""
    records = read_folder(folder)
    records[CURVES][key]["keys"] = keys
    write_folder(records, folder)
    return folder


class TestLoad:
    """Text is loaded as one revision."""

    def test_the_rows_that_the_text_changed_make_one_revision(self, store, tmp_path):
        store.dump(tmp_path / "text")
        folder = rewritten(tmp_path / "text", KEY, "0:0 1:1")
        (folder / "constraints" / "facefx.tsv").unlink()
        assert store.load(folder, author="anna", note="Review") == Loaded(2, added=0, changed=1, removed=1)
        assert [(one.author, one.note, one.rows) for one in store.history(limit=1)] == [("anna", "Review", 2)]
        assert store.records() == read_folder(folder)

    def test_text_that_says_nothing_new_makes_no_revision(self, store):
        assert store.load(TEXT, author="anna") == Loaded(None, 0, 0, 0)
        assert store.revision == 1

    def test_later_edits_of_others_stay_when_the_text_says_since_when_it_is(self, store, tmp_path):
        since = store.dump(tmp_path / "text")
        put(store, "open", "0:0.1 1:0", author="bob")
        store.load(rewritten(tmp_path / "text", KEY, "0:0 1:1"), author="anna", since=since)
        rows = store.records()[CURVES]
        assert rows[KEY]["keys"] == "0:0 1:1"
        assert rows["aa", "bmp", "open"]["keys"] == "0:0.1 1:0"

    def test_a_row_that_both_changed_stops_the_load(self, store, tmp_path):
        since = store.dump(tmp_path / "text")
        put(store, "PBM", "0:0 1:0.5", author="bob")
        with pytest.raises(ConflictError, match="text not loaded: bob changed the same in revision 2") as caught:
            store.load(rewritten(tmp_path / "text", KEY, "0:0 1:1"), author="anna", since=since)
        assert (caught.value.mine["keys"], caught.value.theirs["keys"]) == ("0:0 1:1", "0:0 1:0.5")
        assert store.revision == 2

    def test_without_a_revision_the_text_wins(self, store, tmp_path):
        store.dump(tmp_path / "text")
        put(store, "open", "0:0.1 1:0", author="bob")
        store.load(tmp_path / "text", author="anna")
        assert store.records() == read_folder(TEXT)

    def test_a_revision_that_does_not_exist_is_an_error(self, store):
        with pytest.raises(InputError, match="no revision 9"):
            store.load(TEXT, author="anna", since=9)

    def test_wrong_text_changes_nothing(self, store, tmp_path):
        shutil.copytree(TEXT, tmp_path / "text")
        (tmp_path / "text" / CURVES).write_text("left\tright\n")
        with pytest.raises(PhonesetError, match=r"facefx\.tsv:1:1: the header must be"):
            store.load(tmp_path / "text", author="anna")
        assert store.revision == 1


class TestBackup:
    """A backup is a database of its own."""

    def test_a_backup_has_records_and_history_and_can_be_used(self, store, tmp_path):
        put(store, "PBM", "0:0 1:1", author="bob")
        store.backup(tmp_path / "b.db")
        put(store, "PBM", "", author="bob")
        with closing(Store.open(tmp_path / "b.db", TEXT)) as copy:
            assert copy.records() == store.at(2)
            assert copy.history() == store.history()[1:]
            assert copy.undo(2, author="anna") == 3
            assert copy.check() == []

    def test_a_backup_takes_the_place_of_an_older_one(self, store, tmp_path):
        store.backup(tmp_path / "b.db")
        put(store, "PBM", "0:0 1:1", author="bob")
        store.backup(tmp_path / "b.db")
        with closing(Store.open(tmp_path / "b.db", TEXT)) as copy:
            assert copy.revision == 2

    def test_a_store_is_not_its_own_backup(self, store, tmp_path):
        with pytest.raises(InputError, match="this is the database itself"):
            store.backup(tmp_path / "." / "a.db")
        assert store.check() == []


def cell(column: str, text: str) -> str:
    """SQL that writes *text* into a cell of the source `user`."""
    return f"UPDATE record SET cells = json_set(cells, '$.{column}', '{text}') WHERE key = '[\"user\"]'"


class TestCheck:
    """Everything that is wrong is found at once."""

    def test_a_new_store_is_in_order(self, store):
        assert store.check() == []

    @pytest.mark.parametrize(
        ("damage", "message"),
        [
            ("UPDATE record SET path = 'nonsense.tsv' WHERE path LIKE 'constraints%'", "nonsense.tsv:1:1: no table has this name"),
            (cell("licence", "two words"), "sources.tsv:3:1: column licence: 'two words' must be one word"),
            (cell("title", " x"), "sources.tsv:3:1: the row is not written in canonical form"),
            (cell("source", "me"), "sources.tsv:3:1: the row is stored under the name user"),
            (cell("title", "x"), "sources.tsv user is not what its newest revision made of it"),
            ("DELETE FROM record WHERE path = 'sources.tsv'", "sources.tsv user is not what its newest revision made of it"),
            (cell("licence", "").replace("user", "lipdb"), "sources.tsv:2:1: column licence is empty"),
            ("DELETE FROM revision", "row 1 of table record names a row of revision that is not there"),
            ("DROP INDEX ix_change_path_key", "the tables differ from lipdb's: add_index"),
            ("ALTER TABLE record ADD COLUMN colour TEXT", "the tables differ from lipdb's: remove_column"),
        ],
    )
    def test_what_is_wrong_is_found(self, store, tmp_path, damage, message):
        with closing(sqlite3.connect(tmp_path / "a.db", isolation_level=None)) as connection:
            connection.execute(damage)
        assert message in "\n".join(map(str, store.check()))

    def test_rows_that_do_not_fit_together_are_found(self, store):
        with store.edit(author="anna") as edit:
            edit.put(CURVES, {"left": "aa", "right": "bpm", "pose": "open", "keys": "", "warp": "border"})
        assert [str(finding) for finding in store.check()] == [
            "curves/facefx.tsv:6:4: common phone 'bpm' does not exist; did you mean 'bmp'?"
        ]
