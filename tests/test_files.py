"""Files are written whole or not at all, and text is read from a file or a pipe."""

import io
import os
from pathlib import Path

import pytest

from lipdb.errors import InputError, OutputError
from lipdb.files import read_text, whole_file


def test_the_file_appears_when_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    with whole_file(target) as temporary:
        assert temporary.suffix == ".txt"
        temporary.write_text("new")
        assert not target.exists()
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


def test_an_error_leaves_the_old_file_and_no_other(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    target.write_text("old")
    with pytest.raises(ZeroDivisionError), whole_file(target) as temporary:
        temporary.write_text("half")
        raise ZeroDivisionError
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.parametrize("name", ["missing/a.txt", "."])
def test_a_folder_that_cannot_take_the_file_is_named(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError, match=str(tmp_path)), whole_file(tmp_path / name):
        pass


def test_what_is_no_file_is_not_replaced(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(OutputError, match="this is no file"), whole_file(pipe) as temporary:
        temporary.write_text("new")
    assert pipe.is_fifo()


def test_a_file_has_the_rights_of_any_other_new_file(tmp_path: Path) -> None:
    (tmp_path / "plain.txt").touch()
    with whole_file(tmp_path / "a.txt") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "a.txt").stat().st_mode == (tmp_path / "plain.txt").stat().st_mode


def test_a_full_disk_is_an_output_error_and_leaves_nothing(tmp_path: Path) -> None:
    full = Path("/dev/full")
    with pytest.raises(OutputError, match="No space"), whole_file(tmp_path / "a.txt"), full.open("w") as file:
        file.write("x" * 100_000)
    assert list(tmp_path.iterdir()) == []


def test_text_is_read_from_a_file_or_standard_input_without_its_mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").write_bytes("\ufeffcafé".encode())
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO("\ufeff你好".encode())))
    assert (read_text(tmp_path / "a.txt"), read_text(Path("-"))) == ("café", "你好")


def test_text_that_can_not_be_read_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.txt").write_bytes("café".encode("latin-1"))
    for file, message in (("a.txt", "a.txt: no UTF-8 text .byte 4.; save it as UTF-8"), ("b.txt", "b.txt: can't be read")):
        with pytest.raises(InputError, match=message):
            read_text(tmp_path / file)
    monkeypatch.setattr("sys.stdin", None)
    with pytest.raises(InputError, match="standard input is closed; pipe a text in"):
        read_text(Path("-"))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_is_read_as_its_first_bytes_say(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "a.txt").write_text("ʃ łąka", encoding)
    assert read_text(tmp_path / "a.txt") == "ʃ łąka"
