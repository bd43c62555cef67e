"""What goes wrong with a database gives one line that says what, where and what to do, and loses nothing."""

import os
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
from contextlib import closing, contextmanager
from pathlib import Path

import pytest
from store_cases import CURVES, TEXT

from lipdb.curated.folder import read_folder
from lipdb.errors import LipdbError, MissingToolError, OutputError, PhonesetError, StoreError
from lipdb.store import Store, engines

NOBODY = 65534


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "a.db"
    Store.open(file, TEXT).close()
    return file


@contextmanager
def one_line(error: type[LipdbError], *words: str):
    """Expect *error*, in one line that has all of *words*."""
    with pytest.raises(error) as caught:
        yield
    message = str(caught.value)
    assert "\n" not in message
    for word in words:
        assert word in message


def edit(store: Store, comment: str = "edited") -> None:
    with store.edit(author="anna") as staged:
        staged.put("sources.tsv", {"source": "studio", "title": "Our studio", "licence": "CC0-1.0", "comment": comment})


def test_a_locked_database_says_so_and_saves_nothing(file, monkeypatch):
    monkeypatch.setattr(engines, "BUSY_MILLISECONDS", 50)
    store = Store.open(file, TEXT)
    with closing(sqlite3.connect(file, isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        with one_line(StoreError, str(file), "locked by another program", "try again"):
            edit(store)
        with one_line(StoreError, "locked by another program"):
            store.records()
    edit(store)
    assert store.revision == 2
    store.close()


def test_readers_go_on_while_a_writer_works(file):
    store = Store.open(file, TEXT)
    with closing(sqlite3.connect(file, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        other.execute("DELETE FROM record")
        assert len(store.records()[CURVES]) == 6
        other.execute("ROLLBACK")
    store.close()


@pytest.mark.parametrize("content", [b"GIF89a" + bytes(5000), b"x", "curves\n".encode("utf-16") * 2000])
def test_a_file_that_is_no_database_is_left_as_it_is(tmp_path, content):
    file = tmp_path / "a.db"
    file.write_bytes(content)
    with one_line(StoreError, str(file), "not a database"):
        Store.open(file, TEXT)
    assert file.read_bytes() == content


def test_a_database_of_another_program_is_left_alone(tmp_path):
    file = tmp_path / "a.db"
    with closing(sqlite3.connect(file)) as connection:
        connection.execute("CREATE TABLE invoices (id INTEGER)")
    with one_line(StoreError, str(file), "not lipdb's", "invoices"):
        Store.open(file, TEXT)
    with one_line(StoreError, "not lipdb's"):
        Store.locate(file, TEXT).upgrade()


def test_a_damaged_database_is_an_error_and_the_check_says_so(file):
    with file.open("r+b") as stream:
        stream.seek(4096)
        stream.write(b"\xa5" * (file.stat().st_size - 4096))
    with one_line(StoreError, str(file), "damaged"):
        Store.open(file, TEXT).records()


def test_a_cut_off_database_is_an_error(file):
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 2])
    with one_line(StoreError, str(file), "damaged"):
        Store.open(file, TEXT).records()


@pytest.mark.parametrize("cells", ["substr(cells, 2)", "CAST(x'ff' AS TEXT)"], ids=["not JSON", "not UTF-8"])
def test_a_damaged_row_is_an_error(file, cells):
    with closing(sqlite3.connect(file)) as connection, connection:
        connection.execute(f"UPDATE record SET cells = {cells} WHERE id = 3")
    with closing(Store.open(file, TEXT)) as store:
        for use in (store.records, store.check, store.upgrade, lambda: store.at(0)):
            with one_line(StoreError, str(file), "damaged", "backup"):
                use()


def test_an_empty_file_becomes_a_database(tmp_path):
    file = tmp_path / "a.db"
    file.touch()
    with closing(Store.open(file, TEXT)) as store:
        assert store.revision == 1


def test_wrong_text_makes_no_database(tmp_path):
    text = tmp_path / "text"
    shutil.copytree(TEXT, text)
    (text / "nonsense.tsv").write_text("a\n")
    with pytest.raises(PhonesetError, match="no table has this name"):
        Store.open(tmp_path / "a.db", text)
    assert not (tmp_path / "a.db").exists()


def test_text_in_a_folder_that_can_not_be_read_is_not_taken_for_deleted(locked_folder):
    text = Path(tempfile.mkdtemp(prefix="lipdb-"))
    try:
        shutil.copytree(TEXT, text / "text")
        (text / "text" / "curves").chmod(0)
        with closing(Store.open(locked_folder / "a.db", text / "text")) as store:
            for use in (lambda: store.load(text / "text", author="anna"), lambda: store.outdated, store.upgrade):
                with one_line(PhonesetError, str(text / "text" / "curves"), "can't be read"):
                    use()
        (text / "text" / "curves").chmod(0o755)
    finally:
        shutil.rmtree(text)


def test_a_folder_of_text_that_is_not_there_is_named(file, tmp_path):
    with closing(Store.open(file, tmp_path / "nowhere")) as store, one_line(PhonesetError, str(tmp_path / "nowhere"), "--phonesets"):
        assert store.outdated


def test_the_folder_of_a_given_file_must_be_there(tmp_path):
    with one_line(StoreError, str(tmp_path / "no" / "a.db"), "is not there", "--db"):
        Store.open(tmp_path / "no" / "a.db", TEXT)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_is_no_database(tmp_path):
    with one_line(StoreError, str(tmp_path), "can't be opened"):
        Store.open(tmp_path, TEXT)


@pytest.mark.parametrize("address", ["nonsense://x", "oracle://x/y", "postgresql+nonsense://x/y"])
def test_an_address_of_no_known_database_is_an_error(address):
    with one_line(StoreError, "SQLite or PostgreSQL"):
        Store.open(address, TEXT)


@pytest.mark.parametrize("address", ["://", "postgresql://host:port:1/x"])
def test_an_address_that_can_not_be_read_is_an_error(address):
    with one_line(StoreError, "not the address of a database"):
        Store.open(address, TEXT)


def test_a_database_in_memory_is_refused():
    with one_line(StoreError, "give a file"):
        Store.open("sqlite://", TEXT)


def test_a_password_stands_in_no_message():
    try:
        Store.open("postgresql://anna:secret@127.0.0.1:1/x", TEXT)
    except (StoreError, MissingToolError) as error:
        assert "secret" not in str(error)
        assert "127.0.0.1" in str(error)
        assert "\n" not in str(error)
    else:
        pytest.fail("nothing listens on port 1")


@pytest.fixture
def locked_folder():
    """A folder that can be read and not written, also for root, who then works as nobody."""
    # Not in pytest's folder: nobody else may enter that.
    folder = Path(tempfile.mkdtemp(prefix="lipdb-"))
    file = folder / "a.db"
    Store.open(file, TEXT).close()
    file.chmod(0o444)
    folder.chmod(0o555)
    root = os.geteuid() == 0
    if root:
        os.seteuid(NOBODY)
    try:
        yield folder
    finally:
        if root:
            os.seteuid(0)
        folder.chmod(0o755)
        shutil.rmtree(folder)


def test_a_read_only_database_can_be_read_and_not_edited(locked_folder):
    store = Store.open(locked_folder / "a.db", TEXT)
    assert len(store.records()[CURVES]) == 6
    with one_line(StoreError, str(locked_folder / "a.db"), "read-only", "--db"):
        edit(store)
    assert store.revision == 1
    store.close()


def test_nothing_is_made_in_a_read_only_folder(locked_folder, monkeypatch):
    monkeypatch.setenv("LIPDB_HOME", str(locked_folder / "home"))
    with one_line(StoreError, str(locked_folder / "b.db"), "can't be opened"):
        Store.open(locked_folder / "b.db", TEXT)
    with one_line(StoreError, str(locked_folder / "home"), "can't make this folder"):
        Store.open(None, TEXT)
    with closing(Store.open(locked_folder / "a.db", TEXT)) as store:
        with one_line(OutputError, str(locked_folder / "dump")):
            store.dump(locked_folder / "dump")
        with one_line(OutputError, str(locked_folder / "b.db")):
            store.backup(locked_folder / "b.db")


@contextmanager
def disk_space(size: int):
    """No file can grow beyond *size* bytes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, before)


def test_a_full_disk_loses_the_edit_and_nothing_else(file):
    store = Store.open(file, TEXT)
    with disk_space(file.stat().st_size), one_line(StoreError, str(file), "nothing was saved", "free some space"):
        edit(store, comment="x" * 100_000)
    assert store.revision == 1
    assert store.check() == []
    edit(store)
    assert store.revision == 2
    store.close()


def test_a_full_disk_makes_no_half_database(tmp_path):
    file = tmp_path / "a.db"
    with disk_space(20_000), one_line(StoreError, str(file), "free some space"):
        Store.open(file, TEXT)
    with closing(Store.open(file, TEXT)) as store:
        assert store.check() == []


def test_a_full_disk_leaves_an_older_backup_as_it_was(file, tmp_path):
    (tmp_path / "backup.db").write_bytes(b"older")
    with closing(Store.open(file, TEXT)) as store, disk_space(20_000), one_line(LipdbError, "backup.db"):
        store.backup(tmp_path / "backup.db")
    assert (tmp_path / "backup.db").read_bytes() == b"older"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.db", "backup.db"]


def test_a_full_disk_leaves_an_older_dump_as_it_was(file, tmp_path):
    dump = tmp_path / "dump"
    with closing(Store.open(file, TEXT)) as store:
        store.dump(dump)
        older = {path: path.read_bytes() for path in dump.rglob("*") if path.is_file()}
        edit(store, comment="x" * 500)
        with store.edit(author="anna") as staged:
            staged.delete("common.tsv", ("bmp",))
        with disk_space(400), one_line(OutputError, "sources.tsv"):
            store.dump(dump)
    assert {path: path.read_bytes() for path in dump.rglob("*") if path.is_file()} == older


def test_a_program_that_dies_while_it_saves_leaves_everything_as_it_was(file):
    code = """
import os, sys
import sqlalchemy as sa
from lipdb.store import Store
from lipdb.store.tables import record
store = Store.open(*sys.argv[1:])
with store._writing() as connection:
    connection.execute(sa.delete(record))
    os._exit(9)
"""
    assert subprocess.run([sys.executable, "-c", code, str(file), str(TEXT)], check=False).returncode == 9
    with closing(Store.open(file, TEXT)) as store:
        assert store.records() == read_folder(TEXT)
        assert store.check() == []


class TestPlace:
    """Where the database is when nobody says."""

    def test_an_argument_goes_before_the_environment(self, tmp_path, monkeypatch):
        monkeypatch.setenv("LIPDB_URL", f"sqlite:///{tmp_path / 'b.db'}")
        assert Store.locate(tmp_path / "a.db", TEXT).where == str(tmp_path / "a.db")
        assert Store.locate(None, TEXT).where == str(tmp_path / "b.db")

    def test_it_is_made_in_the_users_data_folder(self, tmp_path, monkeypatch):
        monkeypatch.delenv("LIPDB_URL", raising=False)
        monkeypatch.delenv("LIPDB_HOME", raising=False)
        monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "share"))
        with closing(Store.open(None, TEXT)) as store:
            assert store.where == str(tmp_path / "share" / "lipdb" / "lipdb.db")
        monkeypatch.setenv("LIPDB_HOME", str(tmp_path / "home"))
        with closing(Store.open(None, TEXT)) as store:
            assert store.where == str(tmp_path / "home" / "lipdb.db")
            assert store.characters_folder == tmp_path / "home" / "characters"

    def test_a_file_may_have_any_name(self, tmp_path):
        file = tmp_path / "ü #1 50% off?x=y&z" / "a b:c.db"
        file.parent.mkdir()
        with closing(Store.open(file, TEXT)) as store:
            edit(store)
            store.backup(file.with_name("b%41.db"))
        assert sorted(path.name for path in file.parent.iterdir()) == ["a b:c.db", "b%41.db"]

    def test_the_text_that_fills_it_can_be_named_by_the_environment(self, tmp_path, monkeypatch):
        monkeypatch.setenv("LIPDB_PHONESETS", str(TEXT))
        with closing(Store.open(tmp_path / "a.db")) as store:
            assert store.records() == read_folder(TEXT)
