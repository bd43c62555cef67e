"""``lipdb language``: what languages there are, what their phones map to; new ones, and whether they are in order."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click

from lipdb.cli.names import character_option, language_argument
from lipdb.cli.options import Group, Options, author_option, json_option, print_json, print_listing, print_notes, progress_bar
from lipdb.errors import DataError
from lipdb.words import counted


@click.group(cls=Group, short_help="List, show, make and check languages.")
def language() -> None:
    """List, show, make and check languages.

    \b
    Examples:
      lipdb language show cmn
      lipdb language new pl --from-espeak pl --text polish.txt --source user
      lipdb language check pl
    """


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
@language_argument()
@character_option("Show the phones as this character says them.", default=None)
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


@language.command("new")
@click.argument("code")
@click.option("--from-espeak", "voice", required=True, metavar="VOICE", help="The voice of espeak-ng that speaks it, such as pl.")
@click.option("--text", type=click.Path(path_type=Path, allow_dash=True), help="A text of the language in UTF-8; - reads standard input.")
@click.option("--source", default="", help="Whose text it is: a row of sources.tsv; user for your own work.")
@click.option("--name", default="", help="The language's English name; espeak's by default.")
@click.option("--script", default="", help="Its script (ISO 15924), such as Latn; that of the text by default.")
@author_option
@click.option("-o", "--output", type=click.Path(path_type=Path, file_okay=False), help="Where to make it; by default in --phonesets.")
@json_option
@click.pass_obj
def new_language(
    options: Options,
    /,
    code: str,
    voice: str,
    text: Path | None,
    source: str,
    name: str,
    script: str,
    author: str,
    output: Path | None,
    as_json: bool,
) -> None:
    """Make the folder of a further language, CODE, with proposals for a person to review.

    The voice reads the text. Each phone that it says is mapped to common phones by articulation; what the second opinion doubts,
    and what was heard only once or twice, is marked `review:`. A line of the text is a sentence or several; up to 200 that have
    most pairs become sentences.tsv. Without a text the voice reads numbers and letters, which is not all of a language.

    \b
    Examples:
      lipdb language new pl --from-espeak pl --text polish.txt --source user
      lipdb language new ka --from-espeak ka --text - --source user -o ~/lipdb < georgian.txt
    """
    from lipdb.curated.folder import read_folder
    from lipdb.files import read_text
    from lipdb.languages.new import new_language
    from lipdb.paths import phonesets_dir, workspace_dir

    if text is not None and not source:
        raise click.UsageError("whose text is it? Name a row of sources.tsv with --source (user: your own work)")
    folder = output or workspace_dir(options.phonesets)
    if not output and not folder.is_dir():
        with options.open(remind=False) as db:
            revision = db.store.dump(folder)
        click.echo(f"lipdb: {folder}: made from revision {revision} of the database, for you to edit", err=True)
    whole = (folder / "common.tsv").is_file()
    with progress_bar():
        made = new_language(
            code,
            folder,
            records=read_folder(folder if whole else phonesets_dir(options.phonesets)),
            voice=voice,
            author=author,
            name=name,
            script=script,
            text=None if text is None else read_text(text),
            source=source,
        )
    rows = [phone.to_row() for phone in made.phones]
    if as_json:
        print_json({"language": code, "folder": str(made.folder), "phones": rows, "sentences": made.sentences, "notes": made.notes})
    else:
        print_listing(rows, as_json=False)
    print_notes(made.notes)
    review = sum(bool(phone.review) for phone in made.phones)
    click.echo(f"{made.folder}: {len(rows)} phones ({review} to review), {made.sentences} sentences", err=True)
    load = f"lipdb db load {folder}" if whole else f"copy {made.folder} into your folder of curated text"
    click.echo(f"next: edit {made.folder / 'phones.tsv'}; lipdb language check {code} {folder}; {load}", err=True)


@language.command("check")
@language_argument()
@click.argument("folder", required=False, type=click.Path(path_type=Path))
@click.option("--tidy", is_flag=True, help="First write the language's text in canonical form: sorted rows, LF.")
@json_option
@click.pass_obj
def check_language(options: Options, code: str, folder: Path | None, tidy: bool, as_json: bool) -> None:
    """Check that language CODE keeps what every language promises. Exit code 3 when anything is wrong.

    FOLDER is a folder of curated text, one that holds CODE only, or CODE's own; by default the one of --phonesets. Every phone
    has a mapping, a source with its licence, and an example; the voice says nothing unknown in sentences.tsv; text and labels come
    back as they were; no symbol means two things; every phone occurs. Notes are for a person to look at, and no errors.

    \b
    Examples:
      lipdb language check en
      lipdb language check pl ~/pl --json
    """
    from lipdb.languages.conformance import check_language, tidy_language
    from lipdb.paths import phonesets_dir, workspace_dir

    base = phonesets_dir(options.phonesets)
    workspace = workspace_dir(options.phonesets)
    place = folder or (workspace if workspace.is_dir() else base)
    if tidy:
        for file in tidy_language(code, place):
            click.echo(f"{file}: written", err=True)
    report = check_language(code, place, base=base)
    if as_json:
        print_json(report.to_json())
    else:
        here = Path.cwd()
        root = report.root.relative_to(here) if report.root.is_relative_to(here) else report.root
        for finding in (*report.errors, *(replace(note, message=f"note: {note.message}") for note in report.notes)):
            click.echo(root / str(finding))
    if report.coverage and not as_json:
        click.echo(f"{code}: {report.coverage}", err=True)
    if report.errors:
        count = len(report.errors)
        what = f"{counted(count, 'finding')}; mend {'it' if count == 1 else 'them'}, or see docs/languages.md"
        raise DataError(f"{report.root / code}: {what}")
    click.echo(f"{code}: all is well; {counted(len(report.notes), 'note')}", err=True)


@language.command("reuse")
@language_argument()
@click.option("--from", "donors", multiple=True, default=("en",), show_default=True, help="A language to take pairs from; may be repeated.")
@click.option(
    "--corpus",
    "corpora",
    multiple=True,
    type=click.Path(path_type=Path),
    help="A scan's .parquet, a .csv or .tsv of pairs, or a text; may be repeated. By default the language's sample sentences.",
)
@click.option("--pairs", is_flag=True, help="List every pair: where it comes from and what part of the texts it is.")
@json_option
@click.pass_obj
def show_reuse(options: Options, /, code: str, donors: tuple[str, ...], corpora: tuple[Path, ...], pairs: bool, as_json: bool) -> None:
    """Show which pairs language CODE takes over from others, which only it has, and how much of real text each part carries.

    Pairs with silence are counted apart. "inherited" are new pairs that begin with the curves of a coarser phone (kind_of).

    \b
    Examples:
      lipdb language reuse cmn --from en
      lipdb language reuse de --from en --from cmn --corpus scan.parquet --json
    """
    from lipdb.languages.reuse import reuse
    from lipdb.languages.reuse_text import frequency_of

    with options.open() as db:
        for name in (code, *donors):
            db.language(name)
        texts = {}
        for corpus in corpora or (None,):
            text = frequency_of(db, code, corpus)
            if text.frequency.counts:
                texts[text.name] = text.frequency
            print_notes(f"{text.name}: {note}" for note in text.notes)
        found = reuse(db.records, code, tuple(dict.fromkeys(donors)), texts)
    if pairs:
        print_listing([pair.to_row() for pair in found.pairs], as_json=as_json)
        return
    if as_json:
        print_json(found.to_json())
        return
    print_listing([part.to_row() for part in found.parts], as_json=False)
    if found.own:
        click.echo(f"only {code} has: {' '.join(found.own)}", err=True)
    if found.new.counts:
        often = ", ".join(f"{left}-{right}" for left, right in found.new.pairs[:10])
        click.echo(f"new pairs in the text, most frequent first: {often}{', …' if len(found.new) > 10 else ''}", err=True)
