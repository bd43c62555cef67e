"""``lipdb say`` and ``lipdb sync``: from text or a recording to a moving face."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lipdb.cli.names import character_option, language_option
from lipdb.cli.options import F, Options, json_option, print_json, print_listing, print_notes, progress_bar

if TYPE_CHECKING:
    from lipdb.database import Database
    from lipdb.line import Line
    from lipdb.schedule import Schedule


def _face_options(command: F) -> F:
    """The options that say and sync share."""
    options: list[Callable[[Any], Any]] = [
        language_option("A language's code; see `lipdb language list`."),
        character_option("Whose face; see `lipdb character list`."),
        click.option("--fps", default=60.0, show_default=True, type=click.FloatRange(1, 1000), help="Frames a second."),
        click.option(
            "-o",
            "--output",
            "outputs",
            multiple=True,
            type=click.Path(path_type=Path),
            help="A file to write: .csv .parquet .json .glb .mp4 .webp .wav and more; may be given several times.",
        ),
        click.option("--allow-unknown", is_flag=True, help="Map unknown phone symbols by articulation instead of stopping."),
        json_option,
    ]
    for option in reversed(options):
        command = option(command)
    return command


@click.command(short_help="Speak a sentence and write the moving face.")
@click.argument("text")
@click.option(
    "--voice", default="", metavar="NAME", help="Another voice than the language's own, such as en-us+f2; a wrong name lists all."
)
@_face_options
@click.pass_obj
def say(options: Options, /, text: str, voice: str, language: str, allow_unknown: bool, **face: Any) -> None:
    """Speak TEXT (`-` reads it from standard input) and write the moving face; without -o, show the schedule.

    \b
    Examples:
      lipdb say "Hello world" --character crab -o hello.mp4
      lipdb say "你好，世界" --language cmn -o hello.csv -o hello.glb
      lipdb say "Hello" --voice en-us+f2 -o hello.wav
    """
    if text == "-":
        from lipdb.files import read_text

        text = read_text(Path(text))
    with options.open() as db:
        _check(db, **face)
        line = db.say(text, language=language, voice=voice, allow_unknown=allow_unknown)
        _deliver(db, line, **face)


@click.command(short_help="Move a face to a recording that was aligned already.")
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--audio", type=click.Path(path_type=Path), help="The recording, a WAV file.")
@click.option("--tier", help="The tier of phones in a TextGrid; found by its name when not given.")
@click.option("--notation", default="", help="The notation of the symbols; found by what it knows when not given.")
@_face_options
@click.pass_obj
def sync(
    options: Options, /, file: Path, audio: Path | None, tier: str | None, notation: str, language: str, allow_unknown: bool, **face: Any
) -> None:
    """Move a face to FILE: a Praat TextGrid, or a line's .json (with the edits that you made to it).

    \b
    Example:
      lipdb sync talk.TextGrid --audio talk.wav --language en -o talk.csv
    """
    with options.open() as db:
        _check(db, **face)
        line = db.sync(file, audio=audio, language=language, tier=tier, notation=notation, allow_unknown=allow_unknown)
        _deliver(db, line, **face)


def _check(db: Database, *, character: str, outputs: tuple[Path, ...], **_: Any) -> None:
    """Find out before the work that the character is known and that there is an exporter for every output."""
    from lipdb import plugins

    db.character(character)
    exporters = plugins.exporters()
    for path in outputs:
        plugins.by_suffix(exporters, path, "exporter")


def _deliver(db: Database, line: Line, *, character: str, fps: float, outputs: tuple[Path, ...], as_json: bool) -> None:
    """Say what is to be known of the line, then write every output, or show the schedule when there is none."""
    print_notes(line.notes)
    if not outputs:
        _show(line.schedule, as_json=as_json)
        return
    take = db.animate(line, character=character, fps=fps)
    for path in outputs:
        with progress_bar():
            take.save(path)
        if not as_json:
            click.echo(f"wrote {path}")
    if as_json:
        frames, poses = take.track.weights.shape
        print_json({"written": [str(path) for path in outputs], "seconds": line.schedule.duration, "frames": frames, "poses": poses})


def _show(schedule: Schedule, *, as_json: bool) -> None:
    if as_json:
        print_json(schedule.to_json())
        return
    rows = [
        {**row, "word": schedule.words[row["word"]] if row["word"] >= 0 else "", "common": row["common"]}
        for row in schedule.to_json()["phones"]
    ]
    print_listing(rows, as_json=False, columns=("start", "end", "symbol", "common", "layer", "word"))
