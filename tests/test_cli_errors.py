"""Every mistake on the command line ends with one line on standard error and a documented code, and leaves nothing behind."""

import functools
import json
import sys
from pathlib import Path

import pytest
from command_line import Run

import lipdb


@pytest.fixture
def run(invoke: Run, db: lipdb.Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command in a folder of its own: exit code, standard output, standard error."""
    monkeypatch.chdir(tmp_path)
    return functools.partial(invoke, "--db", db.store.where)


@pytest.mark.parametrize(
    ("args", "code", "complaint"),
    [
        (["say", ""], 4, "at least one word"),
        (["say", "?!..."], 4, "at least one word"),
        (["say", "\U0001f600"], 4, "at least one word"),
        (["say", "Привет"], 4, "Cyrillic"),
        (["say", "你好"], 4, "Chinese characters"),
        (["say", "Hello", "-l", "cmn"], 4, "neither Chinese nor pinyin"),
        (["say", "hi", "-l", "eng"], 4, "did you mean 'en'"),
        (["say", "hi", "--voice", "en-us+f9"], 4, "did you mean 'en-us+f"),
        (["say", "hi", "--voice", "zzz"], 4, "no voice of en 'zzz'; there are en-us, en-us+Andy, "),
        (["say", "hi", "-c", "crabb"], 4, "did you mean 'crab'"),
        (["say", "hi", "-c", "../crab"], 4, "no character"),
        (["say", "hi", "-o", "x"], 4, ".mp4"),
        (["say", "hi", "-o", "x.csv", "-o", "x.xyz"], 4, "x.xyz"),
        (["say", "hi", "-o", "no/x.csv"], 9, "does not exist"),
        (["say", "hi", "-o", "folder.csv"], 9, "folder"),
        (["say", "hi", "-o", f"{'x' * 300}.csv"], 9, "too long"),
        (["say", "hi", "--fps", "nan", "-o", "x.csv"], 4, "frames a second"),
        (["say", "hi", "--fps", "0"], 2, "`lipdb say --help`"),
        (["say", "hi", "--fps", "1e9"], 2, "--fps"),
        (["say", "hi", "there"], 2, "there"),
        (["say", "--nope", "hi"], 2, "--nope"),
        (["say"], 2, "TEXT"),
        (["sya", "hi"], 2, "sya"),
        (["db", "undo", "first"], 2, "`lipdb db undo --help`"),
        (["db", "undo", "99"], 4, "99"),
        (["db", "load", "no"], 3, "no such folder"),
        (["db", "load", "folder.csv"], 3, "no curated data"),
        (["db", "dump", "text.txt"], 2, "text.txt"),
        (["db", "backup", "no/x.db"], 9, "does not exist"),
        (["sync", "no.TextGrid"], 4, "no.TextGrid"),
        (["sync", "folder.csv"], 4, ".textgrid"),
        (["sync", "text.txt", "-o", "x.csv"], 4, ".textgrid"),
        (["phones", "", "--json"], 4, "at least one word"),
        (["pairs", "hi", "-c", "robyn"], 4, "did you mean 'robin'"),
        (["explain", "no.json", "--at", "0.4"], 4, "no.json"),
        (["explain", "text.txt", "--at", "0.4"], 4, "give a file that `lipdb say -o` wrote"),
        (["language", "show", "cnm"], 4, "did you mean 'cmn'"),
        (["language", "show", "en", "-c", "nobody"], 4, "nobody"),
        (["character", "show", "krab"], 4, "did you mean 'crab'"),
        (["character", "add", "no.glb", "--name", "bob"], 4, "no.glb"),
        (["character", "add", "text.txt", "--name", "../bob"], 4, "small letters"),
        (["character", "add", "text.txt", "--name", "robin"], 4, "already"),
        (["completion", "tcsh"], 2, "tcsh"),
    ],
)
def test_a_mistake_is_one_line_with_its_exit_code(run: Run, tmp_path: Path, args: list[str], code: int, complaint: str) -> None:
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "text.txt").write_text("hello\n", "utf-8")
    before = sorted(tmp_path.rglob("*"))
    ended, out, err = run(*args)
    assert (ended, out) == (code, "")
    assert err.startswith("lipdb: ")
    assert err.endswith("\n")
    assert err.count("\n") == 1
    assert complaint in err
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(
    ("stdin", "code", "said"),
    [
        (b"Hello\r\nworld\n", 0, ""),
        (b"\xef\xbb\xbfHello", 0, ""),
        (b"a\0b\0c", 0, "2 characters that are no text"),
        (b"", 4, "at least one word"),
        (b"caf\xe9", 4, "no UTF-8 text"),
        (bytes(range(256)) * 1000, 4, "no UTF-8 text"),
    ],
)
def test_text_comes_from_standard_input(run: Run, stdin: bytes, code: int, said: str) -> None:
    ended, out, err = run("say", "-", stdin=stdin)
    assert ended == code
    assert bool(out) == (code == 0)
    assert said in err
    assert err.count("\n") <= 1


def test_ten_thousand_words_are_a_line_like_any_other(run: Run, tmp_path: Path) -> None:
    ended, _, err = run("say", "-", "-o", "long.csv", "--fps", "10", stdin=b"We go on and on. " * 2000)
    assert (ended, err) == (0, "")
    assert (tmp_path / "long.csv").read_text("utf-8").count("\n") > 10_000


@pytest.mark.parametrize("command", ["say", "phones", "pairs"])
def test_notes_go_to_standard_error_and_data_to_standard_output(run: Run, command: str) -> None:
    ended, out, err = run(command, "\U0001f916 hello", "--json")
    assert ended == 0
    assert json.loads(out)
    assert err.splitlines()[0] == "lipdb: text: 1 emoji or pictogram is not read"


def test_a_package_that_is_not_installed_is_named(run: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    ended, _, err = run("say", "hi", "-c", "flat", "-o", "x.png")
    assert (ended, err) == (8, "lipdb: the package resvg_py is not installed; `lipdb doctor` says how to mend that\n")
    assert not list(tmp_path.iterdir())


def test_more_memory_than_there_is_is_an_error_like_any_other(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def animate(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(lipdb.Database, "animate", animate)
    ended, _, err = run("say", "hi", "-o", "x.csv")
    assert ended == 1
    assert err.count("\n") == 1
    assert "memory" in err


@pytest.mark.parametrize(
    "args",
    [
        ["say", "hi"],
        ["say", "hi", "-o", "hi.json", "-o", "hi.csv"],
        ["phones", "hi"],
        ["pairs", "hi"],
        ["explain", "hello.json", "--at", "0.4"],
        ["sync", "hello.json"],
        ["language", "list"],
        ["language", "show", "cmn"],
        ["character", "list"],
        ["character", "show", "crab"],
        ["db", "check"],
        ["db", "history"],
        ["db", "history", "--since", "0"],
        ["db", "history", "nothing/has/this/name"],
    ],
    ids=" ".join,
)
def test_every_listing_can_be_json(run: Run, args: list[str]) -> None:
    if "hello.json" in args:
        assert run("say", "Hello", "-o", "hello.json")[0] == 0
    ended, out, _ = run(*args, "--json")
    assert ended == 0
    assert isinstance(json.loads(out), dict | list)


@pytest.mark.parametrize(
    "args", [["language", "list"], ["language", "show", "en"], ["character", "list"], ["phones", "hi"], ["pairs", "hi"]]
)
def test_a_listing_in_a_pipe_has_tabs_and_every_row_as_many_cells_as_the_header(run: Run, args: list[str]) -> None:
    _, out, _ = run(*args)
    lines = out.splitlines()
    assert len(lines) > 1
    assert {line.count("\t") for line in lines} == {lines[0].count("\t")}
