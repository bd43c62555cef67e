"""``lipdb curves``: make the shared curves again from their parameters."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import UTC, datetime
from typing import TYPE_CHECKING

import click

from lipdb.cli.options import Group, Options

if TYPE_CHECKING:
    from lipdb.curated.tsv import Key, Row


@click.group(cls=Group)
def curves() -> None:
    """Make the shared curves again from their parameters (targets/ and timing/).

    \b
    Example:
      lipdb curves generate --check
    """


@curves.command()
@click.option("--check", is_flag=True, help="Write nothing; exit with 3 when a table differs from what its targets give.")
@click.option("--author", default="lipdb", show_default=True, help="Who stands in the rows that change.")
@click.option("--table", metavar="PATH", help="A table that is to hold more pairs, such as characters/crab/curves/crab.tsv.")
@click.option("--pair", "pairs", multiple=True, metavar="LEFT-RIGHT", help="A pair of common phones for --table; may be repeated.")
@click.pass_obj
def generate(options: Options, check: bool, author: str, table: str | None, pairs: tuple[str, ...]) -> None:
    """Generate the curves of the curated text again, in the folder that --phonesets names.

    Curves that a person or a recording made stay as they are; a curve that comes out the same keeps its row.

    \b
    Examples:
      lipdb curves generate
      lipdb curves generate --check
      lipdb curves generate --table characters/crab/curves/crab.tsv --pair _-h --pair h-eh
    """
    from lipdb.curated.folder import read_folder, write_folder
    from lipdb.curves.remake import remake
    from lipdb.errors import CurveError
    from lipdb.paths import phonesets_dir

    if bool(table) != bool(pairs):
        raise click.UsageError("--table and --pair go together")
    folder = phonesets_dir(options.phonesets)
    records = read_folder(folder)
    now = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    made = remake(records, author=author, time=now, more={table: [_pair(pair) for pair in pairs]} if table else None)
    changed = {path: _differing(records.get(path, {}), rows) for path, rows in made.items()}
    for path, count in changed.items():
        click.echo(f"{path}: {len(made[path])} curves, {count} {'differ' if check else 'changed'}", err=True)
    if not check:
        write_folder(made, folder)
    elif any(changed.values()):
        raise CurveError("the curves are not what their targets give; run `lipdb curves generate` and review the rows that change")


def _differing(old: Mapping[Key, Row], new: Mapping[Key, Row]) -> int:
    """How many curves are new, gone or not the same."""
    return sum(old.get(key) != new.get(key) for key in {*old, *new})


def _pair(text: str) -> tuple[str, str]:
    left, dash, right = text.partition("-")
    if not (left and dash and right):
        raise click.BadParameter(f"{text!r} is not LEFT-RIGHT, for example h-eh", param_hint="--pair")
    return left, right
