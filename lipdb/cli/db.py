"""``lipdb db``: look after the database."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lipdb.cli.options import Group, Options, author_option, json_option, print_json, print_listing
from lipdb.errors import ConflictError, DataError

if TYPE_CHECKING:
    from lipdb.store import Store

_FOLDER = click.Path(file_okay=False, path_type=Path)
_Command = Callable[..., Any]


def _signed(command: _Command) -> _Command:
    """Add ``--author`` and ``--note``."""
    return author_option(click.option("--note", default="", help="Why; it stands in the history.")(command))


def _open(options: Options) -> Store:
    from lipdb.store import Store

    return Store.open(options.db, options.phonesets)


def _located(options: Options) -> Store:
    from lipdb.store import Store

    return Store.locate(options.db, options.phonesets)


@click.group(cls=Group, short_help="Look after the database: history, undo, text in and out.")
def db() -> None:
    """Look after the database: history, undo, text in and out.

    \b
    Examples:
      lipdb db dump review/          edit the text, review it with git, then
      lipdb db load review/
      lipdb db history curves/facefx.tsv
      lipdb db undo 12
    """


@db.command()
@click.pass_obj
def init(options: Options) -> None:
    """Make the database and fill it from the curated text. One that is there already stays as it is.

    \b
    Example:
      lipdb --db team.db db init
    """
    store = _open(options)
    rows = sum(map(len, store.records().values()))
    click.echo(f"{store.where}: {rows} rows, revision {store.revision}")


@db.command()
@json_option
@click.pass_obj
def upgrade(options: Options, as_json: bool) -> None:
    """Bring an older database up to date, and merge newer shipped text: rows nobody edited follow, edited rows stay.

    Rows that both sides changed stay too, and are listed; then the exit code is 6.

    \b
    Example:
      lipdb db upgrade --json
    """
    store = _located(options)
    done = store.upgrade()
    merged = done.merge
    if as_json:
        print_json(done.to_json())
    else:
        for one in merged.conflicts:
            click.echo(f"{one.path}\t{' '.join(one.key)}\t{one.sides}")
        click.echo(
            f"{store.where}: schema {done.schema}, {len(merged.followed)} rows followed, {len(merged.kept)} edited rows kept, "
            f"{len(merged.conflicts)} in conflict"
        )
    if merged.conflicts:
        raise ConflictError(f"{store.where}: rows were changed by both sides; yours stay: {merged.conflicts[0]}")


@db.command()
@json_option
@click.pass_obj
def check(options: Options, as_json: bool) -> None:
    """Check the file, its tables, its history and every row. Exit code 3 when anything is wrong.

    \b
    Example:
      lipdb db check
    """
    store = _located(options)
    found = store.check()
    if as_json:
        print_json([{"file": one.file, "line": one.line, "column": one.column, "message": one.message} for one in found])
    else:
        for one in found:
            click.echo(str(one))
    if found:
        raise DataError(f"{store.where}: not in order; mend the rows (lipdb db dump, lipdb db load) or put a backup in its place")
    click.echo(f"{store.describe()}: all is well", err=True)


@db.command()
@click.argument("folder", type=_FOLDER)
@click.option("-r", "--revision", type=int, help="The state at this revision instead of the newest.")
@click.pass_obj
def dump(options: Options, folder: Path, revision: int | None) -> None:
    """Write the records as canonical text into FOLDER, to be read, reviewed and merged like code.

    Tables that the database does not have are removed from FOLDER.

    \b
    Examples:
      lipdb db dump review/
      lipdb db dump monday/ --revision 12
    """
    click.echo(f"{folder}: revision {_open(options).dump(folder, revision)}")


@db.command()
@click.argument("folder", type=_FOLDER)
@click.option("--since", type=int, metavar="REVISION", help="The revision that FOLDER was dumped from: later edits of others stay.")
@_signed
@json_option
@click.pass_obj
def load(options: Options, folder: Path, since: int | None, author: str, note: str, as_json: bool) -> None:
    """Make the records what the text in FOLDER says, as one revision.

    Without --since the text wins everywhere. With it, rows that others changed later stay, and a row that both changed
    stops everything with exit code 6.

    \b
    Example:
      lipdb db load review/ --since 11 --note "softer b and p"
    """
    from lipdb.curated.folder import read_checked_folder

    store = _open(options)
    read_checked_folder(folder)  # the store takes whatever is canonical; a person means names that are there
    loaded = store.load(folder, author=author, note=note, since=since)
    if as_json:
        print_json(loaded.to_json())
    elif loaded.revision is None:
        click.echo("nothing changed")
    else:
        click.echo(
            f"revision {loaded.revision}: {loaded.added} rows added, {loaded.changed} changed, {loaded.removed} removed; "
            f"to take it back: lipdb db undo {loaded.revision}"
        )


@db.command()
@click.argument("path", required=False)
@click.argument("key", nargs=-1)
@click.option("-n", "--limit", type=click.IntRange(min=1), default=20, show_default=True, help="How many revisions.")
@click.option("-r", "--revision", type=int, help="Show the rows that this revision changed.")
@click.option("--since", type=int, metavar="REVISION", help="Show the rows that differ between this revision and now (or --revision).")
@json_option
@click.pass_obj
def history(
    options: Options, path: str | None, key: tuple[str, ...], limit: int, revision: int | None, since: int | None, as_json: bool
) -> None:
    """List the revisions, newest first: all, those of the tables whose path begins with PATH, or of the row with KEY.

    \b
    Examples:
      lipdb db history
      lipdb db history curves/facefx.tsv ao bmp open
      lipdb db history --revision 12
      lipdb db history cmn/ --since 12
    """
    store = _open(options)
    if revision is None and since is None:
        rows = [one.to_json() for one in store.history(path, key or None, limit=limit)]
        print_listing(rows, as_json=as_json, columns=("revision", "time", "author", "rows", "note"))
        return
    newest = store.revision if revision is None else revision
    changes = store.changes(newest, path) if since is None else store.diff(since, newest, path)
    if key:
        changes = [one for one in changes if one.key == key]
    if as_json:
        print_json([one.to_json() for one in changes])
    else:
        print_listing([one.to_row() for one in changes], as_json=False, columns=("path", "key", "before", "after"))


@db.command()
@click.argument("revision", type=int)
@_signed
@json_option
@click.pass_obj
def undo(options: Options, revision: int, author: str, note: str, as_json: bool) -> None:
    """Take back what REVISION changed, as a new revision; it can be undone too.

    Refused with exit code 6 when one of its rows was changed again since: undo the newer revision first.

    \b
    Example:
      lipdb db undo 12
    """
    made = _open(options).undo(revision, author=author, note=note)
    if as_json:
        print_json({"revision": made, "undone": revision})
    else:
        click.echo(f"revision {made} takes back revision {revision}" if made else f"nothing of revision {revision} is left to undo")


@db.command()
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@click.pass_obj
def backup(options: Options, file: Path) -> None:
    """Copy the database with its history into FILE (SQLite), while others may go on working.

    \b
    Example:
      lipdb db backup friday.db
    """
    _open(options).backup(file)
    click.echo(f"{file}: written")
