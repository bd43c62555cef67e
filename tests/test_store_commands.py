"""``lipdb db``: every command, its JSON and its exit code."""

import json
import shutil
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest
from store_cases import CURVES, DATABASES, TEXT

from lipdb.curated.folder import read_folder, write_folder
from lipdb.store import Store


@pytest.fixture
def lipdb(invoke, tmp_path, monkeypatch):
    """Run ``lipdb db`` on a database in the test's folder: exit code, output, errors."""
    monkeypatch.setenv("LIPDB_AUTHOR", "anna")

    def run(*words: object, text: Path = TEXT) -> tuple[int, str, str]:
        return invoke("--db", tmp_path / "a.db", "--phonesets", text, "db", *words)

    return run


@pytest.fixture
def edited(lipdb, tmp_path):
    """The text of the database in which one curve was edited, loaded as revision 2."""
    records = read_folder(TEXT)
    records[CURVES]["aa", "bmp", "PBM"]["keys"] = "0:0 1:1"
    write_folder(records, tmp_path / "edited")
    assert lipdb("load", tmp_path / "edited", "--note", "Softer", "--json") == (
        0,
        json.dumps({"revision": 2, "added": 0, "changed": 1, "removed": 0}, indent=2) + "\n",
        "",
    )
    return tmp_path / "edited"


def test_init_makes_the_database_and_leaves_one_that_is_there(lipdb, tmp_path):
    first = lipdb("init")
    assert first == (0, f"{tmp_path / 'a.db'}: 17 rows, revision 1\n", "")
    assert lipdb("init") == first


def test_dump_and_load_are_inverse(lipdb, edited, tmp_path):
    assert lipdb("dump", tmp_path / "dump") == (0, f"{tmp_path / 'dump'}: revision 2\n", "")
    for file in edited.rglob("*.tsv"):
        assert (tmp_path / "dump" / file.relative_to(edited)).read_bytes() == file.read_bytes()
    assert lipdb("load", tmp_path / "dump") == (0, "nothing changed\n", "")


def test_load_says_what_it_changed_and_how_to_take_it_back(lipdb, edited):
    code, out, _ = lipdb("load", TEXT)
    assert (code, out) == (0, "revision 3: 0 rows added, 1 changed, 0 removed; to take it back: lipdb db undo 3\n")


def test_load_over_somebody_elses_newer_edit_ends_with_6(lipdb, edited, tmp_path):
    records = read_folder(edited)
    records[CURVES]["aa", "bmp", "PBM"]["keys"] = "0:0 1:0.5"
    write_folder(records, edited)
    code, out, err = lipdb("load", edited, "--since", 1)
    assert (code, out) == (6, "")
    assert err.startswith("lipdb: text not loaded: anna changed the same in revision 2")


def test_history_lists_revisions_and_the_changes_of_one(lipdb, edited):
    code, out, _ = lipdb("history", "--json")
    assert code == 0
    assert [(one["revision"], one["author"], one["note"], one["rows"]) for one in json.loads(out)] == [
        (2, "anna", "Softer", 1),
        (1, "lipdb", "Fill from the shipped text", 17),
    ]
    assert [one["revision"] for one in json.loads(lipdb("history", CURVES, "aa", "_", "open", "--json")[1])] == [1]
    assert [one["revision"] for one in json.loads(lipdb("history", "-n", "1", "--json")[1])] == [2]
    (change,) = json.loads(lipdb("history", "--revision", 2, "--json")[1])
    assert (change["path"], change["key"], change["after"]["keys"]) == (CURVES, ["aa", "bmp", "PBM"], "0:0 1:1")
    assert lipdb("history", "--revision", 2)[1] == (f"path\tkey\tbefore\tafter\n{CURVES}\taa bmp PBM\tkeys 0:0 0.5:0.9 1:1\tkeys 0:0 1:1\n")


def test_history_compares_two_revisions(lipdb, edited):
    lipdb("undo", 2)
    assert json.loads(lipdb("history", "--since", 1, "--json")[1]) == []
    (change,) = json.loads(lipdb("history", "--since", 3, "--revision", 2, "--json")[1])
    assert (change["before"]["keys"], change["after"]["keys"]) == ("0:0 0.5:0.9 1:1", "0:0 1:1")
    assert lipdb("history", "constraints/", "--since", 1, "--revision", 2)[1] == "path\tkey\tbefore\tafter\n"


def test_an_old_state_can_be_dumped(lipdb, edited, tmp_path):
    assert lipdb("dump", tmp_path / "old", "--revision", 1) == (0, f"{tmp_path / 'old'}: revision 1\n", "")
    assert read_folder(tmp_path / "old") == read_folder(TEXT)


def test_undo_takes_a_revision_back_once(lipdb, edited):
    assert lipdb("undo", 2) == (0, "revision 3 takes back revision 2\n", "")
    assert lipdb("undo", 2, "--json") == (0, json.dumps({"revision": None, "undone": 2}, indent=2) + "\n", "")
    assert lipdb("undo", 9) == (4, "", "lipdb: there is no revision 9; the newest is 3\n")


def test_check_ends_with_3_and_names_every_finding(lipdb, tmp_path):
    assert lipdb("check") == (7, "", f"lipdb: {tmp_path / 'a.db'}: there is no database yet; run: lipdb db init\n")
    lipdb("init")
    assert lipdb("check", "--json")[:2] == (0, "[]\n")
    with closing(Store.open(tmp_path / "a.db", TEXT)) as store, store.edit(author="anna") as edit:
        edit.put(CURVES, {"left": "aa", "right": "bpm", "pose": "open", "keys": "", "warp": "border"})
    code, out, err = lipdb("check")
    assert (code, out) == (3, "curves/facefx.tsv:6:4: common phone 'bpm' does not exist; did you mean 'bmp'?\n")
    assert "not in order" in err
    assert json.loads(lipdb("check", "--json")[1])[0]["line"] == 6


def test_upgrade_lists_conflicts_and_ends_with_6(lipdb, tmp_path):
    shutil.copy(DATABASES / "0001.db", tmp_path / "a.db")
    code, out, err = lipdb("history")
    assert (code, out) == (7, "")
    assert "run: lipdb db upgrade" in err
    code, out, err = lipdb("upgrade")
    assert code == 6
    assert out == (
        "curves/facefx.tsv\tbmp aa PBM\ttheirs keys 0:1 0.5:0.8 1:0, yours keys 0:1 0.5:0.5 1:0\n"
        f"{tmp_path / 'a.db'}: schema 0003, 4 rows followed, 2 edited rows kept, 1 in conflict\n"
    )
    assert "rows were changed by both sides; yours stay: curves/facefx.tsv bmp aa PBM: theirs keys" in err
    code, out, _ = lipdb("upgrade", "--json")
    assert code == 0
    assert json.loads(out)["conflicts"] == []


def test_backup_writes_a_database(lipdb, edited, tmp_path):
    assert lipdb("backup", tmp_path / "b.db") == (0, f"{tmp_path / 'b.db'}: written\n", "")
    with closing(Store.open(tmp_path / "b.db", TEXT)) as copy:
        assert copy.revision == 2


def test_an_edit_without_an_author_is_refused(lipdb, edited):
    code, _, err = lipdb("load", TEXT, "--author", " ")
    assert code == 4
    assert "author" in err


@pytest.mark.parametrize("command", ["init", "upgrade", "check", "dump", "load", "history", "undo", "backup"])
def test_every_command_has_help_with_an_example(lipdb, command):
    code, out, _ = lipdb(command, "--help")
    assert code == 0
    assert "Example" in out
    assert "lipdb " in out.split("Example")[1]


def test_help_imports_no_database():
    code = "import sys, lipdb.cli.db; print(any(name.split('.')[0] in ('sqlalchemy', 'alembic') for name in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"
