"""What every command shares: the global options, the ways to print a listing, and how progress is shown."""

from __future__ import annotations

import getpass
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, TypeVar

import click

if TYPE_CHECKING:
    from rich.progress import TaskID

    from lipdb.database import Database

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True, slots=True)
class Options:
    """The global options; and whether the command is *alone* in its process, which ends with it."""

    db: str | None = None
    phonesets: str | None = None
    alone: bool = False

    def open(self, *, remind: bool = True) -> Database:
        """The database that the options name; *remind* says when newer curated text waits to be merged into it."""
        import lipdb

        database = lipdb.open(self.db, phonesets=self.phonesets)
        if remind and database.store.outdated:
            click.echo("lipdb: the curated text has changed since this database took it in; merge it with `lipdb db upgrade`", err=True)
        return database


class Group(click.Group):
    """A group that lists its commands in the order in which they are defined, each with its whole summary."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """The names, in the order in which people need them."""
        return list(self.commands)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands; click itself would cut what is longer than a line."""
        commands = [(name, self.get_command(ctx, name)) for name in self.list_commands(ctx)]
        with formatter.section("Commands"):
            formatter.write_dl([(name, command.get_short_help_str(200)) for name, command in commands if command])

    def resolve_command(self, ctx: click.Context, args: list[str]) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that *args* name; for a name that there is not, an error with the nearest one."""
        name, names = args[0], self.list_commands(ctx)
        if name not in names and not name.startswith("-") and not ctx.resilient_parsing:
            near = get_close_matches(name, names, 1)
            ctx.fail(f"no command {name!r}; " + (f"did you mean {near[0]!r}?" if near else f"there are {', '.join(names)}"))
        return super().resolve_command(ctx, args)


def author_option(command: F) -> F:
    """Add ``--author``."""
    return click.option("--author", default=_user, envvar="LIPDB_AUTHOR", show_default="you", help="Who stands in the history.")(command)


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return ""


def json_option(command: F) -> F:
    """Add ``--json``."""
    return click.option("--json", "as_json", is_flag=True, help="Print JSON.")(command)


@contextmanager
def progress_bar() -> Iterator[None]:
    """Show a bar on standard error while long work goes on; nothing into a pipe."""
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return
    from rich.console import Console
    from rich.progress import Progress

    from lipdb.progress import reported

    with Progress(console=Console(stderr=True), transient=True) as bar:
        tasks: dict[str, TaskID] = {}

        def report(what: str, done: int, total: int) -> None:
            if what not in tasks:
                tasks[what] = bar.add_task(what, total=total)
            bar.update(tasks[what], completed=done, total=total)

        with reported(report):
            yield


def print_notes(notes: Iterable[str]) -> None:
    """Print what a person should know of the result, a line each, on standard error."""
    for note in notes:
        click.echo(f"lipdb: {note}", err=True)


def print_json(data: Any) -> None:
    """Print *data* for a program to read."""
    click.echo(json.dumps(data, ensure_ascii=False, indent=2))


def print_listing(rows: Sequence[Mapping[str, Any]], *, as_json: bool, columns: Iterable[str] = ()) -> None:
    """Print *rows*: JSON when asked, a table to a person, tab-separated text into a pipe."""
    if as_json:
        print_json([dict(row) for row in rows])
        return
    names = list(columns) or list(rows[0] if rows else ())
    # There is no standard output when a shell closed it (`lipdb … >&-`).
    if sys.stdout is None or not sys.stdout.isatty():
        for row in [dict(zip(names, names, strict=True)), *rows]:
            click.echo("\t".join(_cell(row.get(name, "")) for name in names))
        return
    from rich import box
    from rich.console import Console
    from rich.table import Column, Table
    from rich.text import Text

    # Folded where there is no room: rich would cut a long word off.
    table = Table(*(Column(name, overflow="fold") for name in names), box=box.SIMPLE_HEAD, pad_edge=False)
    for row in rows:
        table.add_row(*(Text(_cell(row.get(name, ""))) for name in names))
    Console().print(table)


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.3f}".rstrip("0").rstrip(".")
    if isinstance(value, list | tuple):
        return " ".join(map(str, value))
    return str(value)
