"""``lipdb coverage report``, ``gaps``, ``select`` and ``compare``: what counts of real text say."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from lipdb.cli.names import LANGUAGE, character_option, language_option
from lipdb.cli.options import Options, json_option, print_json, print_listing, progress_bar

if TYPE_CHECKING:
    from lipdb.coverage.reports.frequency import Frequency
    from lipdb.database import Database

OF_SCAN = language_option(f"A language's code; that of SCAN if not given, or {LANGUAGE}.", default=None)
TABLE_TWO = 21
Command = TypeVar("Command", bound=Callable[..., Any])


def _top(pairs: int) -> Callable[[Command], Command]:
    """The option ``--top``, *pairs* by default."""
    number = click.IntRange(min=0)
    return click.option("--top", type=number, default=pairs, show_default=True, metavar="N", help="How many pairs to list; 0 lists all.")


@click.command(short_help="Show how often each pair occurs, and how many pairs cover how much.")
@click.argument("scan", required=False)
@OF_SCAN
@character_option()
@_top(TABLE_TWO)
@click.option("--silence/--no-silence", default=False, show_default=True, help="Count pairs with silence too.")
@click.option("--plot", type=click.Path(path_type=Path), metavar="FILE", help="Draw the curve into a .png, .svg or .pdf.")
@json_option
@click.pass_obj
def report(
    options: Options, /, scan: str | None, language: str | None, character: str, top: int, silence: bool, plot: Path | None, as_json: bool
) -> None:
    """Show how often each pair of common phones occurs in SCAN, and how many pairs cover how much of it.

    SCAN is a scan's file, its number in `lipdb coverage list`, or a table of counts (.csv, .tsv); without it the newest scan
    of the language is taken. The table is the paper's Table 2, the plot its Figure 2.

    \b
    Examples:
      lipdb coverage report
      lipdb coverage report stories.parquet --top 0 --json
      lipdb coverage report stories.parquet --plot figure2.png
    """
    from lipdb.coverage.reports import report as reports

    with options.open() as db:
        name, language, frequency = _frequency(db, scan, language, silence=silence)
        common = {phone for mapped in db.phoneset(language) for phone in mapped.common}
        summary = reports.Summary.of(frequency, len(common | frequency.phones)).to_json()
        rows = [row.to_row() for row in reports.ranked(frequency, top or None)]
        curves = reports.by_curve(db.uses(frequency.counts, language=language, character=character))
    if plot:
        reports.plot(frequency, plot, title=Path(name).stem)
    if as_json:
        print_json({"scan": name, "language": language, **summary, **{f"by_{what}": part for what, part in curves.items()}, "pairs": rows})
        return
    print_listing(rows, as_json=False)
    click.echo(
        f"{name}: {summary['total']:,.0f} pairs, {summary['seen']} of {summary['possible']} kinds; "
        + ", ".join(f"{count} cover {level} %" for level, count in summary["covering"].items()),
        err=True,
    )
    for what, parts in curves.items():
        click.echo(f"by {what}: " + ", ".join(f"{part[what]} {part['percent']:.1f} % ({part['pairs']} pairs)" for part in parts), err=True)


@click.command(short_help="Show which pairs to author next.")
@click.argument("scan", required=False)
@OF_SCAN
@character_option()
@_top(20)
@click.option("--silence/--no-silence", default=True, show_default=True, help="Count pairs with silence too.")
@click.option("--minutes", type=click.FloatRange(min=0), default=5.0, show_default=True, help="What one pair takes an artist.")
@json_option
@click.pass_obj
def gaps(
    options: Options, /, scan: str | None, language: str | None, character: str, top: int, silence: bool, minutes: float, as_json: bool
) -> None:
    """List the pairs whose curves nobody has drawn or fitted yet, the most needed first.

    For each pair: its part of running text, what is covered by hand once it and all before it are done, the hours until
    then, and the origin and layer of the curve that it uses today. SCAN is as for `lipdb coverage report`.

    \b
    Example:
      lipdb coverage gaps stories.parquet --character crab --top 10
    """
    from lipdb.coverage.reports.gaps import gaps as find_gaps

    with options.open() as db:
        name, language, frequency = _frequency(db, scan, language, silence=silence)
        uses = db.uses(frequency.counts, language=language, character=character)
        found = find_gaps(uses, minutes=minutes)
    rows = [gap.to_row() for gap in found]
    print_listing(rows[: top or None], as_json=as_json)
    if not as_json:
        open_share = sum(gap.percent for gap in found)
        click.echo(
            f"{name}: {len(found)} of {len(uses)} pairs are open, {open_share:.1f} % of running text, "
            f"{len(found) * minutes / 60:.1f} hours at {minutes:g} minutes a pair",
            err=True,
        )


@click.command(short_help="Choose the fewest sentences that hold every pair.")
@click.argument("corpus", nargs=-1, required=True)
@language_option()
@click.option("--sentences", "most", type=click.IntRange(min=0), metavar="N", help="At most so many; all that are needed if not given.")
@click.option("--silence/--no-silence", default=True, show_default=True, help="Cover pairs with silence too.")
@json_option
@click.pass_obj
def select(options: Options, /, corpus: tuple[str, ...], language: str, most: int | None, silence: bool, as_json: bool) -> None:
    """Choose sentences (lines) of CORPUS that between them hold every pair of common phones: a script to record or to test with.

    \b
    Example:
      lipdb coverage select stories.txt --sentences 50 > script.txt
    """
    from lipdb.coverage.reports.select import select as choose
    from lipdb.coverage.reports.sentences import sentences_of

    with options.open() as db, progress_bar():
        sentences = sentences_of(corpus, db.voice(language), db.phoneset(language), silence=silence)
    chosen = choose(sentences, most=most)
    every = len({pair for _, pairs in sentences for pair in pairs})
    if as_json:
        print_json([choice.to_row() for choice in chosen])
    else:
        for choice in chosen:
            click.echo(choice.sentence)
    covered = chosen[-1].covered if chosen else 0
    click.echo(f"lipdb: {len(chosen)} of {len(sentences)} sentences hold {covered} of the corpus' {every} pairs", err=True)


@click.command(short_help="Show how two counts differ.")
@click.argument("first")
@click.argument("second")
@_top(20)
@click.option("--silence/--no-silence", default=False, show_default=True, help="Count pairs with silence too.")
@json_option
@click.pass_obj
def compare(options: Options, /, first: str, second: str, top: int, silence: bool, as_json: bool) -> None:
    """Show how far FIRST and SECOND are apart, and which pairs make the difference.

    Each is a scan's file or number, a table of counts (.csv or .tsv with left, right and count), or the name of published
    frequencies, such as xu2013 (Table 2 of the paper).

    \b
    Examples:
      lipdb coverage compare stories.parquet xu2013
      lipdb coverage compare monday.parquet tuesday.parquet --json
    """
    from lipdb.coverage.reports.compare import compare as differ
    from lipdb.coverage.reports.named import named_frequency

    with options.open() as db:
        told = differ(*(named_frequency(db, name, silence=silence) for name in (first, second))).to_json()
    rows: list[dict[str, Any]] = told["differences"][: top or None]
    if as_json:
        print_json({"first": first, "second": second, **told, "differences": rows})
        return
    print_listing(rows, as_json=False)
    rank, distance = told["rank_correlation"], told["total_variation"]
    click.echo(
        f"{told['pairs']} pairs compared: rank correlation {'unknown' if rank is None else f'{rank:.3f}'}, "
        + ("" if distance is None else f"total variation distance {distance:.4f}, ")
        + f"{len(told['only_first'])} pairs only in {first}, {len(told['only_second'])} only in {second}",
        err=True,
    )


def _frequency(db: Database, scan: str | None, language: str | None, *, silence: bool) -> tuple[str, str, Frequency]:
    """What *scan* is called, or else the newest scan of *language*; its language where none is given; and how often its pairs occur."""
    from lipdb.coverage.reports.named import language_of, named_frequency, newest_scan

    if language:
        db.language(language)
    name = scan or newest_scan(db, language or LANGUAGE)
    return name, language or language_of(db, name) or LANGUAGE, named_frequency(db, name, silence=silence)
