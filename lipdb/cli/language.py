"""``lipdb language``: what languages there are, and what their phones map to."""

from __future__ import annotations

import click

from lipdb.cli.options import Options, json_option, print_json, print_listing


@click.group(short_help="List and show languages.")
def language() -> None:
    """List and show languages."""


@language.command("list")
@json_option
@click.pass_obj
def list_languages(options: Options, as_json: bool) -> None:
    """List the languages.

    \b
    Example:
      lipdb language list --json
    """
    with options.open() as db:
        print_listing(db.languages(), as_json=as_json, columns=("language", "name", "notation", "speech", "voice", "source"))


@language.command("show")
@click.argument("code")
@click.option("-c", "--character", help="Show the phones as this character says them.")
@json_option
@click.pass_obj
def show_language(options: Options, code: str, character: str | None, as_json: bool) -> None:
    """Show the phones of language CODE, the common phones they map to, and the layer each mapping comes from.

    \b
    Example:
      lipdb language show cmn
    """
    with options.open() as db:
        if character is not None:
            db.character(character)
        phoneset = db.phoneset(code, character=character)
        rows = [mapped.to_row() for mapped in phoneset]
        if as_json:
            print_json({"language": db.language(code), "phones": rows})
        else:
            print_listing(rows, as_json=False)
