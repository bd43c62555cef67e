"""A voice's answers, kept between scans: Parquet files that several processes may write at once.

Each process adds files of its own, whole or not at all, named by what is in them. Every scan joins them into one before it
begins: the new file is there before the old ones go, so nothing is lost, and an answer that is there twice is the same
answer. A file that can't be read is done without, and so is a folder that can't be written.
"""

from __future__ import annotations

import contextlib
import hashlib
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from lipdb.coverage.fast.lexicon import ANSWERS, Lexicon
from lipdb.errors import OutputError
from lipdb.files import whole_file
from lipdb.speech.cache import cache_folder
from lipdb.speech.voice import Voice

FORMAT = 1
MOST = 2_000_000
"""Words. A lexicon that has more is given up for an empty one, so memory is bounded whatever people write."""
KEPT = MOST // 2
"""Words that are kept between scans: fewer, so that a scan that opens them has room."""
_WORTH_ANSWERS = 2000  # Answers: fewer are sooner asked for again than opened.
_MANY = 3
_SUFFIX = ".parquet"


def lexicon_folder(voice: Voice) -> Path:
    """Where the answers of this version of *voice* are kept, in the user's cache."""
    version = f"{FORMAT} {voice.language} {voice.name} {voice.version}"
    return cache_folder() / "lexicon" / f"{voice.language}-{hashlib.sha256(version.encode()).hexdigest()[:16]}"


def open_lexicon(voice: Voice, folder: Path | None) -> Lexicon:
    """The lexicon of *voice* with what *folder* has."""
    lexicon = Lexicon(voice)
    if folder is not None:
        found = _tables(folder)
        lexicon.learn(_once([table for _, table in found]).slice(0, KEPT))
        lexicon.files = {file.name for file, _ in found}
    return lexicon


def join_files(folder: Path) -> None:
    """Make one file of many, so that those who open the lexicon need not."""
    if len(answer_files(folder)) <= _MANY:
        return
    found = _tables(folder)
    if joined := _write(_once([table for _, table in found]).slice(0, KEPT), folder):
        for file, _ in found:
            if file != joined:
                file.unlink(missing_ok=True)


def share(lexicon: Lexicon, folder: Path | None) -> None:
    """Keep what *lexicon* asked since the last time, if it is worth a file, and take over what others have kept since."""
    if folder is None or not len(lexicon.asked):
        return
    if len(lexicon.asked) >= _WORTH_ANSWERS:
        if len(lexicon) <= KEPT and (file := _write(lexicon.asked, folder)):
            lexicon.files.add(file.name)
        lexicon.asked = ANSWERS.empty_table()
    if len(lexicon) <= KEPT and (new := [file for file in answer_files(folder) if file.name not in lexicon.files]):
        lexicon.files.update(file.name for file in new)
        lexicon.learn(_once([table for file in new if (table := _read(file)) is not None]).slice(0, KEPT))


def answer_files(folder: Path) -> list[Path]:
    """The files of *folder*, by name."""
    try:
        return sorted(folder.glob(f"[!.]*{_SUFFIX}"))
    except OSError:
        return []


def _tables(folder: Path) -> list[tuple[Path, pa.Table]]:
    """The files of *folder* that can be read, and what is in them; the oldest first.

    So words stand, and are numbered, about as they were first met: those that come often are together in memory, as they are used.
    """
    return [(file, table) for file in sorted(answer_files(folder), key=_time) if (table := _read(file)) is not None]


def _time(file: Path) -> float:
    try:
        return file.stat().st_mtime
    except OSError:  # Another process joined it with others.
        return 0


def _once(tables: list[pa.Table]) -> pa.Table:
    """All *tables* together, each word once."""
    answers = pa.concat_tables([ANSWERS.empty_table(), *tables])
    if len(tables) < 2:
        return answers
    once = answers.group_by("word", use_threads=False).aggregate([("reading", "min"), ("remarks", "min")])
    return once.rename_columns(ANSWERS.names)


def _read(file: Path) -> pa.Table | None:
    try:
        with pq.ParquetFile(file) as opened:  # pq.read_table would load pandas
            table = opened.read()
    except (OSError, ValueError):  # Another process joined it with others, or it is damaged.
        return None
    return table.replace_schema_metadata() if table.schema.equals(ANSWERS) else None


def _write(table: pa.Table, folder: Path) -> Path | None:
    """Write *table* into *folder*; the file, if it could be done."""
    words = table["word"].combine_chunks()
    digest = hashlib.sha256(b"".join(bytes(buffer) for buffer in words.buffers() if buffer))
    with contextlib.suppress(OSError, OutputError):
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / f"{digest.hexdigest()[:16]}{_SUFFIX}"
        with whole_file(file) as temporary:
            pq.write_table(table.cast(ANSWERS), temporary, compression="zstd")
        return file
    return None
