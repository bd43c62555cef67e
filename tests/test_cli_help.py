"""Every command is documented, shows an example, and has an exit code for every error."""

from pathlib import Path

import click
import pytest
from click.shell_completion import ShellComplete
from click.testing import CliRunner

from lipdb import database, errors
from lipdb.cli import COMMANDS, cli, main, names

ROOT = Path(__file__).parent.parent


def leaves(command: click.Command, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    if not isinstance(command, click.Group):
        return [path]
    ctx = click.Context(command)
    return [leaf for name in command.list_commands(ctx) for leaf in leaves(command.get_command(ctx, name), (*path, name))]


@pytest.mark.parametrize("path", leaves(cli), ids=" ".join)
def test_help_shows_an_example_that_uses_the_command(path: tuple[str, ...]) -> None:
    result = CliRunner().invoke(cli, [*path, "--help"])
    assert result.exit_code == 0
    assert "Example" in result.output
    example = result.output.split("Example")[1].splitlines()
    assert any(line.strip().startswith("lipdb ") and f" {' '.join(path)}" in line for line in example)
    told = result.output.split("Options:")[0].splitlines()[2:]
    assert all(line.startswith("  ") for line in told if line), "a line break in an example spoils the whole text"


@pytest.mark.parametrize("path", [(), *sorted({leaf[:-1] for leaf in leaves(cli) if len(leaf) > 1})], ids=" ".join)
def test_help_of_a_group_shows_an_example_and_the_whole_summary_of_each_command(path: tuple[str, ...]) -> None:
    text = CliRunner().invoke(cli, [*path, "--help"]).output
    assert "Example" in text
    assert "..." not in text.split("Commands:")[1]


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("sya", "lipdb: no command 'sya'; did you mean 'say'? See `lipdb --help`"),
        ("db backpu", "lipdb: no command 'backpu'; did you mean 'backup'? See `lipdb db --help`"),
        ("character delete", "lipdb: no command 'delete'; there are list, show, add; see `lipdb character --help`"),
    ],
)
def test_a_command_that_there_is_not_ends_with_the_nearest_one(given, told, capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["lipdb", *given.split()])
    with pytest.raises(SystemExit) as end:
        main()
    assert (end.value.code, capsys.readouterr().err) == (2, f"{told}\n")


def test_whoever_edits_is_found_out_in_one_way() -> None:
    helped = [CliRunner().invoke(cli, [*path, "--help"]).output for path in leaves(cli)]
    told = {" ".join(text.split("--author")[1].split("\n  -")[0].split()) for text in helped if "--author" in text}
    told.remove("TEXT Who stands in the rows that change. [default: lipdb]")  # of the generated curves
    assert told == {"TEXT Who stands in the history. [default: (you)]"}


@pytest.mark.parametrize("path", leaves(cli), ids=" ".join)
def test_the_documentation_names_the_command(path: tuple[str, ...]) -> None:
    rows = [line for line in (ROOT / "docs" / "cli.md").read_text("utf-8").splitlines() if line.startswith(f"| `lipdb {path[0]}")]
    assert any(all(f"`{word}" in row or f" {word}" in row for word in path[1:]) for row in rows)


def test_the_short_help_of_a_command_is_the_one_in_the_list() -> None:
    for name, (_, short_help) in COMMANDS.items():
        command = cli.get_command(click.Context(cli), name)
        assert command is not None
        assert command.get_short_help_str(200) == short_help


def test_every_error_has_a_documented_exit_code_of_its_own_branch() -> None:
    kinds = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, errors.LipdbError)]
    documented = (ROOT / "docs" / "cli.md").read_text("utf-8")
    for kind in kinds:
        assert f"| {kind.exit_code} |" in documented
        assert kind.__name__ in (errors.LipdbError.__doc__ or "")


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_prints_a_script_for_the_shell(shell: str) -> None:
    result = CliRunner().invoke(cli, ["completion", shell])
    assert result.exit_code == 0
    assert "_LIPDB_COMPLETE" in result.output


@pytest.mark.parametrize(
    ("words", "typed", "offered"),
    [
        (["say", "Hello", "--language"], "c", ["cmn"]),
        (["--db", "BROKEN", "say", "Hello", "--language"], "c", []),
        (["pairs", "Hello", "--character"], "", ["crab", "flat", "robin"]),
        (["language", "show"], "cm", ["cmn"]),
        (["character", "show"], "r", ["robin"]),
    ],
    ids=" ".join,
)
def test_the_shell_completes_languages_and_characters(words: list[str], typed: str, offered: list[str], tmp_path: Path) -> None:
    (tmp_path / "broken.db").write_bytes(b"no database")
    words = [word.replace("BROKEN", str(tmp_path / "broken.db")) for word in words]
    found = ShellComplete(cli, {}, "lipdb", "_LIPDB_COMPLETE").get_completions(words, typed)
    assert [item.value for item in found] == offered


def test_a_command_takes_the_language_and_the_character_that_the_library_takes() -> None:
    assert (names.LANGUAGE, names.CHARACTER) == (database.DEFAULT_LANGUAGE, database.DEFAULT_CHARACTER)
