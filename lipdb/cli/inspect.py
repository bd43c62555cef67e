"""``lipdb phones``, ``pairs`` and ``explain``: what decides the result, before and after."""

from __future__ import annotations

import click

from lipdb.cli.options import Options, json_option, print_listing

LANGUAGE = click.option("-l", "--language", default="en", show_default=True, help="A language's code.")


@click.command(short_help="Show the phones of a text and the common phones they map to.")
@click.argument("text")
@LANGUAGE
@click.option("-c", "--character", help="Show the phones as this character says them.")
@json_option
@click.pass_obj
def phones(options: Options, text: str, language: str, character: str | None, as_json: bool) -> None:
    """Show the phones of TEXT, the common phones they map to, and the layer that each mapping comes from.

    \b
    Example:
      lipdb phones "你好" --language cmn
    """
    with options.open() as db:
        if character is not None:
            db.character(character)
        line = db.say(text, language=language, allow_unknown=True)
        schedule, unknown = db.phoneset(language, character=character).resolve(line.schedule, allow_unknown=True)
        rows = [
            {
                "word": schedule.words[phone.word] if phone.word >= 0 else "",
                "symbol": phone.symbol,
                "common": list(phone.common),
                "layer": phone.layer,
                "tone": phone.tone or "",
                "stress": phone.stress or "",
            }
            for phone in schedule.phones
        ]
        print_listing(rows, as_json=as_json)
        for symbol in unknown:
            click.echo(f"lipdb: {symbol}", err=True)


@click.command(short_help="Show the phone pairs of a text and where their curves come from.")
@click.argument("text")
@LANGUAGE
@click.option("-c", "--character", default="robin", show_default=True, help="Whose curves.")
@json_option
@click.pass_obj
def pairs(options: Options, /, text: str, language: str, character: str, as_json: bool) -> None:
    """Show each phone pair of TEXT, where its curves come from (origin and layer), and the poses that have none.

    \b
    Example:
      lipdb pairs "Hello world"
    """
    with options.open() as db:
        uses = db.pairs(db.say(text, language=language, allow_unknown=True), character=character)
        print_listing([use.to_row() for use in uses], as_json=as_json)
        missing, gaps = sum(bool(use.missing) for use in uses), sum(use.gap for use in uses)
        click.echo(
            f"{len(uses)} pairs: {missing} without a curve in any table, {gaps} whose curves nobody has drawn or fitted yet", err=True
        )
