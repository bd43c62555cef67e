"""``lipdb phones``, ``pairs`` and ``explain``: what decides the result, before and after."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from lipdb.cli.names import character_option, language_option
from lipdb.cli.options import Options, json_option, print_json, print_listing, print_notes
from lipdb.errors import InputError, UnknownSymbolError


@click.command(short_help="Show the phones of a text and the common phones they map to.")
@click.argument("text", required=False)
@language_option()
@character_option("Show the phones as this character says them.", default=None)
@click.option("--ipa", is_flag=True, help="Read IPA segments from standard input, one a line, and propose common phones for each.")
@click.option("--common", is_flag=True, help="List the common phones: who uses each, and what its pairs cost.")
@json_option
@click.pass_obj
def phones(options: Options, /, text: str | None, language: str, character: str | None, ipa: bool, common: bool, as_json: bool) -> None:
    """Show the phones of TEXT, the common phones they map to, and the layer that each mapping comes from.

    With --ipa: what each IPA segment on standard input maps to, in any language, how sure that is, and why. Lines that are no
    IPA are listed too, and end with exit code 5.

    With --common: the languages that use each common phone, its pairs with their phones, how many of them have curves of their
    own, and how many inherit those of the coarser phone that it was split from (kind_of).

    \b
    Examples:
      lipdb phones "你好" --language cmn
      printf 'ʁ\\nt͡ɕʰ\\nkʷ\\n' | lipdb phones --ipa --json
    """
    if [text is not None, ipa, common].count(True) != 1:
        raise click.UsageError("give a TEXT, or --ipa (IPA segments on standard input), or --common, and only one of them")
    if ipa:
        _propose(options, as_json)
        return
    if common:
        _list_common(options, as_json)
        return
    assert text is not None
    with options.open() as db:
        if character is not None:
            db.character(character)
        line = db.say(text, language=language, allow_unknown=True)
        schedule, _ = db.phoneset(language, character=character).resolve(line.schedule, allow_unknown=True)
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
        print_notes(line.notes)


def _list_common(options: Options, as_json: bool) -> None:
    """Print the common phones."""
    from lipdb.languages.inventory import inventory

    with options.open() as db:
        print_listing([phone.to_row() for phone in inventory(db.records)], as_json=as_json)


def _propose(options: Options, as_json: bool) -> None:
    """Print what the IPA segments on standard input map to."""
    from lipdb.files import encoding_of
    from lipdb.phones.phoneset import shortened
    from lipdb.phones.proposal import propose

    if sys.stdin is None:
        raise InputError("standard input is closed; pipe IPA segments in, one a line")
    raw = sys.stdin.buffer.read()
    lines = raw.decode(encoding_of(raw), errors="replace").splitlines()
    with options.open() as db:
        rows = db.records.get("ipa.tsv", {})
        found = [propose(line.strip(), rows) for line in lines if line.strip()]
    print_listing([proposal.to_row() for proposal in found], as_json=as_json)
    strange = [proposal.ipa for proposal in found if not proposal.common]
    if strange:
        shown = ", ".join(repr(shortened(line)) for line in strange[:5]) + (", …" if len(strange) > 5 else "")
        raise UnknownSymbolError(f"{len(strange)} of {len(found)} lines are no IPA segments: {shown}; see the reason beside each")


@click.command(short_help="Show the phone pairs of a text and where their curves come from.")
@click.argument("text")
@language_option()
@character_option()
@json_option
@click.pass_obj
def pairs(options: Options, /, text: str, language: str, character: str, as_json: bool) -> None:
    """Show each phone pair of TEXT, where its curves come from (origin and layer), and the poses that have none.

    \b
    Example:
      lipdb pairs "Hello world"
    """
    with options.open() as db:
        line = db.say(text, language=language, allow_unknown=True)
        uses = db.pairs(line, character=character)
        print_listing([use.to_row() for use in uses], as_json=as_json)
        print_notes(line.notes)
        missing, gaps = sum(bool(use.missing) for use in uses), sum(use.gap for use in uses)
        click.echo(
            f"{len(uses)} pairs: {missing} without a curve in any table, {gaps} whose curves nobody has drawn or fitted yet", err=True
        )


@click.command(short_help="Show what made each weight at one instant.")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--at", type=float, required=True, metavar="SECONDS", help="The instant; the frame nearest to it is explained.")
@character_option("Whose face; the one that the file was made for when not given.", default=None)
@json_option
@click.pass_obj
def explain(options: Options, /, file: Path, at: float, character: str | None, as_json: bool) -> None:
    """Show which pair, curve, origin, layer and stage gave each weight of the line in FILE (a .json of `lipdb say`).

    \b
    Example:
      lipdb explain hello.json --at 0.42
    """
    from lipdb.database import DEFAULT_CHARACTER, DEFAULT_FPS
    from lipdb.export.json import made_for

    with options.open() as db:
        who, fps = made_for(file)
        line = db.sync(file)
        causes = db.explain(line, at=at, character=character or who or DEFAULT_CHARACTER, fps=fps or DEFAULT_FPS)
        if as_json:
            print_json([cause.to_json() for cause in causes])
        else:
            print_listing([cause.to_row() for cause in causes], as_json=False)
