"""Languages and characters on the command line: the options and arguments that take one, which the shell completes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import click
from click.shell_completion import CompletionItem

from lipdb.cli.options import F, Options
from lipdb.errors import LipdbError

LANGUAGE, CHARACTER = "en", "robin"
"""Taken when none is given; written here as well so that help need not wait for `lipdb.database`."""
Completion = Callable[[click.Context, click.Parameter, str], Sequence[CompletionItem]]


def _completion(listing: str, key: str, title: str) -> Completion:
    """Offers column *key* of the database's *listing* (languages, characters), with column *title* beside it."""

    def complete(ctx: click.Context, _parameter: click.Parameter, typed: str) -> Sequence[CompletionItem]:
        given = ctx.find_root().params
        try:
            with Options(given.get("db"), given.get("phonesets")).open(remind=False) as database:
                rows = getattr(database, listing)()
        except (LipdbError, OSError):  # whoever presses the tab key is told nothing; the command itself will say it
            return []
        return [CompletionItem(row[key], help=row[title]) for row in rows if row[key].startswith(typed)]

    return complete


_languages = _completion("languages", "language", "name")
_characters = _completion("characters", "character", "title")


def language_option(text: str = "A language's code.", *, default: str | None = LANGUAGE) -> Callable[[F], F]:
    """Add ``--language``; *text* is its help."""
    return click.option("-l", "--language", default=default, show_default=True, help=text, shell_complete=_languages)


def character_option(text: str = "Whose curves.", *, default: str | None = CHARACTER) -> Callable[[F], F]:
    """Add ``--character``; *text* is its help."""
    return click.option("-c", "--character", default=default, show_default=True, help=text, shell_complete=_characters)


def language_argument() -> Callable[[F], F]:
    """Add the argument ``CODE`` of a language that there is."""
    return click.argument("code", shell_complete=_languages)


def character_argument() -> Callable[[F], F]:
    """Add the argument ``NAME`` of a character that there is."""
    return click.argument("name", shell_complete=_characters)
