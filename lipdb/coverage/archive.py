"""Counts of parts, kept between scans: so that resuming, appending and doing it again cost only what is new.

A part's counts are a file named by the digests of its text and by the counter's key. Beside them stands, for each file of a
corpus, which digests its parts had when it was last read; a file that has not changed since is not even opened.
"""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import pyarrow.parquet as pq

from lipdb.coverage.corpus import Source
from lipdb.coverage.counts import Counts
from lipdb.errors import OutputError
from lipdb.files import whole_file
from lipdb.speech.cache import cache_folder

FORMAT = 1
_SETTLED = 2_000_000_000
"""Nanoseconds. A file that was changed so shortly before it was read may change again without a new time."""

Digests = tuple[str, ...]


def coverage_folder() -> Path:
    """Where counts are kept, unless a scan is told otherwise."""
    return cache_folder() / "coverage"


def part_key(counter: str, digests: Sequence[str]) -> str:
    """The name of the counts of a part: by *counter*'s key, and the part's digests."""
    return hashlib.sha256(json.dumps([FORMAT, counter, list(digests)]).encode()).hexdigest()[:32]


class Remembered(NamedTuple):
    """The digests of a file's *parts*, whether each names its documents, and whether the file is still the same."""

    parts: tuple[Digests, ...]
    named: bool
    unchanged: bool


@dataclass(frozen=True, slots=True)
class Archive:
    """What is kept below *folder*. May be pickled: workers that see the same folder look there first."""

    folder: Path

    def has(self, key: str) -> bool:
        """Whether the counts named *key* are there."""
        return self._file(key).is_file()

    def write(self, key: str, counts: Counts) -> None:
        """Keep *counts*. Raises `OutputError`."""
        file = self._file(key)
        _make(file.parent)
        counts.write(file)

    def read(self, key: str) -> Counts:
        """The counts named *key*. Raises `OSError` or `ValueError` when they are not there or damaged; they are deleted then."""
        file = self._file(key)
        try:
            return Counts.read(file)
        except (OSError, ValueError):
            file.unlink(missing_ok=True)
            raise

    def rows(self, key: str) -> int:
        """How many rows of pairs the counts named *key* have."""
        return int(pq.read_metadata(self._file(key)).num_rows)

    def remember(self, source: Source, size: int, parts: Sequence[Digests], *, named: bool) -> None:
        """Remember the digests of the *parts* of *size* bytes of *source*, a file that was read just now."""
        if not source.modified or time.time_ns() - source.modified < _SETTLED:
            return
        file = self._index(source, size)
        _make(file.parent)
        told = {"size": source.size, "modified": source.modified, "named": named, "parts": [list(part) for part in parts]}
        with whole_file(file) as temporary:
            temporary.write_text(json.dumps(told))

    def recall(self, source: Source, size: int) -> Remembered:
        """What is remembered of *source*; nothing when it was never read."""
        try:
            told = json.loads(self._index(source, size).read_text())
            same = bool(source.modified) and (told["size"], told["modified"]) == (source.size, source.modified)
            return Remembered(tuple(tuple(map(str, part)) for part in told["parts"]), bool(told["named"]), same)
        except (OSError, ValueError, KeyError, TypeError):
            return Remembered((), False, False)

    def _file(self, key: str) -> Path:
        return self.folder / "parts" / key[:2] / f"{key}.parquet"

    def _index(self, source: Source, size: int) -> Path:
        place = f"{source.path.absolute()}\n{size}\n{source.kind}".encode(errors="surrogateescape")
        return self.folder / "files" / f"{hashlib.sha256(place).hexdigest()[:32]}.json"


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: can't make this folder ({error.strerror}); choose another cache with LIPDB_CACHE") from error
