"""``lipdb coverage``: count which phone pairs real text needs, list what was counted, and say what the counts tell."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lipdb.cli.coverage_report import compare, gaps, report, select
from lipdb.cli.names import language_option
from lipdb.cli.options import Group, Options, json_option, print_json, print_listing, progress_bar
from lipdb.errors import InputError

if TYPE_CHECKING:
    from lipdb.coverage.register import Scanned


@click.group(cls=Group, short_help="Count which phone pairs real text needs.")
def coverage() -> None:
    """Count which phone pairs real text needs.

    \b
    Examples:
      lipdb coverage scan stories/ --language en
      lipdb coverage report
      lipdb coverage gaps --top 10
    """


@coverage.command()
@click.argument("corpus", nargs=-1, required=True)
@language_option()
@click.option("--mode", type=click.Choice(["exact", "fast"]), default="exact", show_default=True, help="Every line, or every word once.")
@click.option("-o", "--output", type=click.Path(dir_okay=False, path_type=Path), metavar="FILE", help="The result, a .parquet file.")
@click.option("--workers", type=click.IntRange(min=1), metavar="N", help="How many count side by side; one a core by default.")
@click.option(
    "--scheduler", default="", metavar="ADDRESS", help="Count on Dask (tcp://host:port, or local for a cluster of its own), or in threads."
)
@json_option
@click.pass_obj
def scan(
    options: Options,
    /,
    corpus: tuple[str, ...],
    language: str,
    mode: str,
    output: Path | None,
    workers: int | None,
    scheduler: str,
    as_json: bool,
) -> None:
    """Count the phone pairs of CORPUS: texts (plain, gzip, zstd, bz2, Parquet), alignments (.TextGrid), folders of these, or -.

    What was counted before is not counted again: a scan that was stopped goes on, a text that grew costs what is new. Lines
    and files that can't be counted are reported and stop nothing.

    \b
    Examples:
      lipdb coverage scan stories.txt --language en
      lipdb coverage scan wiki/ --language de --mode fast -o wiki.parquet
      zcat crawl.gz | lipdb coverage scan - --language en
    """
    if options.alone and not scheduler:
        from lipdb.coverage.processes import make_ready

        make_ready(language)  # before the imports that take longest
        from lipdb.coverage.plain_arrow import without_pandas

        without_pandas()
    from lipdb.coverage.register import scan as run

    with options.open() as db:
        db.language(language)
        with progress_bar():
            done = run(db, corpus, language=language, mode=mode, output=output, workers=workers or 0, scheduler=scheduler)
    if as_json:
        print_json(done.to_json())
    _report(done)
    if not as_json:
        click.echo(done.scan.path)
    if not done.scan.totals["pairs"]:
        raise InputError(f"{' '.join(corpus)}: holds nothing that can be counted; give text in the --language")


def _report(done: Scanned) -> None:
    """Say on standard error what was counted, what was left out or read otherwise, and why."""
    totals = done.scan.totals
    for row in done.told["findings"]:
        what = "left out" if row["left_out"] else "read so"
        example = f" (as in {row['example']!r})" if row["example"] else ""
        count = f"{row['count']:,} {row['unit']}{'s' if row['count'] != 1 else ''}"
        click.echo(f"  {what}: {count} in {row['documents']:,} document(s): {row['reason']}: {row['meaning']}{example}", err=True)
    if done.repeated:
        click.echo(f"scanned already at {done.scan.time}; nothing was counted again", err=True)
    else:
        click.echo(f"{done.fresh} of {done.parts} parts counted now, the others were kept from earlier scans", err=True)
    click.echo(
        f"{totals['pairs']:,} pairs in {totals['spoken']:,} of {totals['lines']:,} lines of {totals['documents']:,} document(s)", err=True
    )
    if "error" in totals:
        wrong = totals["error"]
        click.echo(
            f"fast mode: total variation distance from exact {wrong['total_variation']:.4f} ± {wrong['spread']:.4f}, "
            f"measured on {wrong['pairs']:,} pairs counted both ways",
            err=True,
        )


@coverage.command("list")
@language_option("Only those of this language.", default=None)
@json_option
@click.pass_obj
def list_scans(options: Options, language: str | None, as_json: bool) -> None:
    """List the scans, newest first; stale are those whose language has another mapping now.

    Scanning again then costs no voice: the counts of labels are kept.

    \b
    Example:
      lipdb coverage list --json
    """
    from lipdb.coverage.register import state_of

    with options.open() as db:
        if language:
            db.language(language)
        rows: list[dict[str, Any]] = [{**one.to_json(), "state": state_of(db, one)} for one in db.store.scans(language)]
    columns = ("id", "time", "language", "mode", "state", "pairs", "lines", "revision", "corpus", "path")
    print_listing(rows, as_json=as_json, columns=columns)


for command in (report, gaps, select, compare):
    coverage.add_command(command)
