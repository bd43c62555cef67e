"""Scans and the store: do one, register it, find it again, and tell when its mapping is no longer the present one."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lipdb.coverage.archive import Archive, coverage_folder
from lipdb.coverage.corpus import Source, printable, sources
from lipdb.coverage.counts import Counter
from lipdb.coverage.executors import Workers
from lipdb.coverage.resolve import mapping_digest
from lipdb.coverage.result import read_result, write_result
from lipdb.coverage.scan import Counted, count_corpus, seconds
from lipdb.curated.schema import TIME_FORMAT
from lipdb.errors import InputError, OutputError
from lipdb.store.scans import Scan

if TYPE_CHECKING:
    import pyarrow as pa

    from lipdb.database import Database

EXACT, FAST = "exact", "fast"
MODES = (EXACT, FAST)
CURRENT, STALE, MISSING = "current", "stale", "missing"
_MEND = 3  # Times that counts found damaged in the cache are counted again before giving up.


@dataclass(frozen=True)
class Scanned:
    """A scan that was done, or had been done already (*repeated*); *told* is what its file says beside the table.

    Of its *parts*, *fresh* ones were counted now; the counts of the others were kept from earlier scans.
    """

    scan: Scan
    told: Mapping[str, Any]
    parts: int
    fresh: int
    repeated: bool = False

    def to_json(self) -> dict[str, Any]:
        """Plain data for a program."""
        findings = {name: self.told[name] for name in ("findings", "findings_by_document")}
        return {**self.scan.to_json(), "parts": self.parts, "fresh": self.fresh, "repeated": self.repeated, **findings}


def scan(
    db: Database,
    paths: Sequence[str],
    *,
    language: str,
    mode: str = EXACT,
    output: Path | None = None,
    workers: int = 0,
    scheduler: str = "",
    folder: Path | None = None,
    title: str = "",
) -> Scanned:
    """Count the phone pairs of the corpus at *paths* as *language* says it, write the result and register it.

    *mode* is ``exact`` or ``fast``; *workers* how many count side by side (0: one a core), *scheduler* the address of a Dask
    scheduler, ``local`` for a cluster of our own, or ``threads`` of this process; *output* the result's file, else one in the
    store's folder of scans; *folder* where counts of parts are kept; *title* what people call the corpus, if not by the
    names of its paths. Raises `InputError` for a path that is not there, and `OutputError`.
    """
    if output and printable(str(output)) != str(output):
        raise OutputError(f"{printable(str(output))}: this name is no text, so the list of scans can't keep it; choose another")
    archive = Archive(folder or coverage_folder())
    counter = counter_of(db, language, mode, paths)
    mapping = mapping_digest(db.records, language)
    with Workers(workers, threads=counter.threads, scheduler=scheduler, seconds=seconds) as crew:
        for _ in range(_MEND):
            counted = count_corpus(paths, counter, crew, archive)
            before = _same(db, counted, counter, mapping, language, output)
            if before is not None:
                return Scanned(before, read_result(Path(before.path)), len(counted.places), counted.fresh, repeated=True)
            try:
                return _written(db, paths, counted, counter, archive, language, mapping, output, title)
            except (OSError, ValueError):
                continue  # The damaged counts are gone now.
    raise OutputError(
        f"{archive.folder}: kept counts are damaged again and again; look after the disk, or set LIPDB_CACHE to another folder"
    )


def _written(
    db: Database,
    paths: Sequence[str],
    counted: Counted,
    counter: Counter,
    archive: Archive,
    language: str,
    mapping: str,
    output: Path | None,
    title: str,
) -> Scanned:
    phoneset = db.phoneset(language)
    named = tuple(map(printable, paths))
    path = (output or _default_path(db, paths, counted, counter, language)).absolute()
    time = datetime.now(UTC).strftime(TIME_FORMAT)
    metadata = {
        "program": _program(),
        "time": time,
        "language": language,
        "mode": counter.mode,
        "corpus": list(named),
        "title": title or ", ".join(Path(name).name for name in named),
        "content": counted.content,
        "counter": counter.key,
        "mapping": mapping,
        "revision": db.store.revision,
    }

    def error(sample: pa.Table) -> dict[str, Any]:
        from lipdb.coverage.fast.error import distance

        found = distance(sample, phoneset, counter.notation)
        return {"error": {"total_variation": found.value, "spread": found.spread, "pairs": found.pairs}} if found else {}

    summary = write_result(counted, archive, phoneset, counter.notation, path, metadata, error=error)
    totals = {"documents": summary.documents, "lines": summary.lines, "spoken": summary.spoken, "pairs": summary.pairs, **summary.error}
    one = Scan(time, language, counter.mode, named, counted.content, counter.key, mapping, str(path), totals)
    return Scanned(db.store.add_scan(one), read_result(path), len(counted.places), counted.fresh)


def counter_of(db: Database, language: str, mode: str, paths: Sequence[str] = ()) -> Counter:
    """The counter of *mode* for *language*'s voice. Raises `InputError` for a mode that there is not."""
    from lipdb.coverage.exact import ExactCounter

    voice = db.voice(language).raw()
    if mode == EXACT:
        return ExactCounter(voice)
    if mode != FAST:
        raise InputError(f"there is no mode {mode!r} of counting; there are {', '.join(MODES)}")
    from lipdb.coverage.fast.counter import fast_counter
    from lipdb.coverage.fast.lexicon_files import lexicon_folder

    sentences = [row["sentence"] for row in db.records.get(f"{language}/sentences.tsv", {}).values()]
    size = sum(one.size for one in sources(paths) if isinstance(one, Source))
    return fast_counter(voice, sentences, size=size, folder=lexicon_folder(voice))


def state_of(db: Database, one: Scan) -> str:
    """Whether the result of a scan is there, and of the present mapping."""
    if not Path(one.path).is_file():
        return MISSING
    return CURRENT if one.mapping == mapping_digest(db.records, one.language) else STALE


def _same(db: Database, counted: Counted, counter: Counter, mapping: str, language: str, output: Path | None) -> Scan | None:
    """An earlier scan that found the very same, and whose result is still there."""
    for one in db.store.scans(language):
        alike = (one.content, one.counter, one.mapping) == (counted.content, counter.key, mapping)
        if alike and (output is None or str(output.absolute()) == one.path) and Path(one.path).is_file() and counted.places:
            return one
    return None


def _default_path(db: Database, paths: Sequence[str], counted: Counted, counter: Counter, language: str) -> Path:
    folder = db.store.scans_folder
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: can't make this folder ({error.strerror}); name the result with -o") from error
    stem = re.sub(r"[^\w.-]+", "-", Path(paths[0]).name.split(".")[0]).strip("-.")[:40] or "corpus"
    return folder / f"{stem}-{language}-{counter.mode}-{counted.content[:8]}.parquet"


def _program() -> str:
    from importlib.metadata import version

    return f"lipdb {version('lipdb')}"
