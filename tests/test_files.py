"""Files are written whole or not at all."""

from pathlib import Path

import pytest

from lipdb.errors import OutputError
from lipdb.files import whole_file


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


def test_a_full_disk_is_an_output_error_and_leaves_nothing(tmp_path: Path) -> None:
    full = Path("/dev/full")
    with pytest.raises(OutputError, match="No space"), whole_file(tmp_path / "a.txt"), full.open("w") as file:
        file.write("x" * 100_000)
    assert list(tmp_path.iterdir()) == []
