"""A listing is a table to a person, tab-separated text in a pipe, and JSON when asked; it loses nothing in any of them."""

import io
import json
import re

import pytest

from lipdb.cli.options import print_listing

ROWS = [{"pose": "open", "weight": 0.25, "layers": ["common", "character:crab"], "comment": "[bold]as drawn[/bold]"}]


class Terminal(io.StringIO):
    """Standard output where a person looks on."""

    def isatty(self) -> bool:
        return True


def shown(*, columns: int, monkeypatch: pytest.MonkeyPatch) -> str:
    terminal = Terminal()
    monkeypatch.setenv("COLUMNS", str(columns))
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("sys.stdout", terminal)
    print_listing(ROWS, as_json=False)
    return re.sub(r"\x1b\[[\d;]*m", "", terminal.getvalue())


def letters(table: str) -> list[str]:
    return sorted(letter for letter in table if not letter.isspace() and letter != "─")


def test_a_person_sees_a_table(monkeypatch: pytest.MonkeyPatch) -> None:
    table = shown(columns=100, monkeypatch=monkeypatch)
    assert "open   0.25     common character:crab   [bold]as drawn[/bold]" in table


def test_in_a_narrow_terminal_long_words_are_folded_and_not_cut(monkeypatch: pytest.MonkeyPatch) -> None:
    table = shown(columns=34, monkeypatch=monkeypatch)
    assert "…" not in table
    assert max(map(len, table.splitlines())) <= 34
    assert letters(table) == letters(shown(columns=100, monkeypatch=monkeypatch))


def test_a_pipe_gets_tabs_and_a_program_json(capsys: pytest.CaptureFixture[str]) -> None:
    print_listing(ROWS, as_json=False, columns=("pose", "layers", "none"))
    assert capsys.readouterr().out == "pose\tlayers\tnone\nopen\tcommon character:crab\t\n"
    print_listing(ROWS, as_json=True)
    assert json.loads(capsys.readouterr().out) == ROWS
