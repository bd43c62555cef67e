"""A corpus in parts, each counted once in its life, by workers, wherever they are."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import groupby
from typing import NamedTuple

import pyarrow as pa

from lipdb.coverage.archive import Archive, Digests, part_key
from lipdb.coverage.corpus import ALIGNED, Source, parts, sources
from lipdb.coverage.counts import Counter, Counts
from lipdb.coverage.executors import Workers
from lipdb.coverage.findings import CRASHED, CUT_OFF
from lipdb.coverage.lines import finding
from lipdb.coverage.parts import Part
from lipdb.progress import report

ALIGNMENTS = "alignments 1"
"""In place of a counter's key for parts that no voice reads: change it with anything that changes their counts."""
SECONDS, SECONDS_A_MEGABYTE = 30, 240
"""How much of a processor's time a part may take before it is given up: ten times what the slowest voice needs."""


class Place(NamedTuple):
    """Where the counts named *key* belong: to a part of the file *source*. *document* is empty if the counts name theirs."""

    source: int
    part: int
    document: str
    aligned: bool
    key: str
    digests: Digests


class Task(NamedTuple):
    """A part of a file; *kept* are the digests that it had when it was last read, if its counts are kept."""

    source: int
    number: int
    part: Part
    key: str
    kept: Digests = ()


class Outcome(NamedTuple):
    """What became of a part: its digests, and its counts unless they are kept. Without digests the counts say what is wrong."""

    digests: Digests
    counts: Counts | None


@dataclass
class Counted:
    """A corpus whose every part is in the archive.

    *places* are sorted; *apart* are counts that belong to no part: what could not be read. Of all parts, *fresh* ones were
    counted now; the rest was kept.
    """

    places: list[Place] = field(default_factory=list)
    apart: Counts = field(default_factory=Counts.of)
    fresh: int = 0

    @property
    def content(self) -> str:
        """A digest of all that was read, with the names of its documents."""
        digest = hashlib.sha256()
        for document, places in groupby(self.places, key=lambda place: place.document):
            digest.update(f"{document}\n".encode())
            for place in places:
                digest.update("".join(place.digests).encode())
        return digest.hexdigest()[:32]


def count_corpus(paths: Sequence[str], counter: Counter, workers: Workers, archive: Archive) -> Counted:
    """Count what is new in the corpus at *paths*, and keep it in *archive*.

    What can't be read is reported, and stops nothing. Raises `InputError` for a path that is not there.
    """
    return _Run(paths, counter, workers, archive).run()


class _Run:
    """One run of `count_corpus`."""

    def __init__(self, paths: Sequence[str], counter: Counter, workers: Workers, archive: Archive) -> None:
        self.counter, self.workers, self.archive = counter, workers, archive
        self.counted = Counted()
        self.sources: list[Source] = []
        for one in sources(paths):
            if isinstance(one, Source):
                self.sources.append(one)
            else:
                self.counted.apart += one
        self.total, self.done = sum(source.size for source in self.sources), 0
        self.incomplete: set[int] = set()
        """Files of which something could not be read: they are read again next time."""
        self.named: set[int] = set()
        """Files whose counts name their documents."""

    def run(self) -> Counted:
        work = partial(count_part, self.counter, self.archive)
        for task, outcome in self.workers.map(work, self._tasks()):
            self._enter(task, outcome or self._give_up(task))
        self.counted.places.sort()
        for number, places in groupby(self.counted.places, key=lambda place: place.source):
            if number not in self.incomplete:
                digests = [place.digests for place in places]
                self.archive.remember(self.sources[number], self.counter.size, digests, named=number in self.named)
        return self.counted

    def _tasks(self) -> Iterator[Task]:
        """The parts that have to be read; files that have not changed are entered at once."""
        for number, source in enumerate(self.sources):
            key = ALIGNMENTS if source.kind == ALIGNED else self.counter.key
            known = self.archive.recall(source, self.counter.size)
            kept = [digests if self.archive.has(part_key(key, digests)) else () for digests in known.parts]
            if known.unchanged and kept and all(kept):
                self._recall(number, source, kept, known.named)
                continue
            for k, part in enumerate(parts(source, self.counter.size)):
                if isinstance(part, Counts):
                    self.counted.apart += part
                    self.incomplete.add(number)
                else:
                    yield Task(number, k, part, key, kept[k] if k < len(kept) else ())

    def _recall(self, number: int, source: Source, parts: Sequence[Digests], named: bool) -> None:
        if named:
            self.named.add(number)
        for k, digests in enumerate(parts):
            self._place(number, k, source, digests)
        self._report(source.size)

    def _enter(self, task: Task, outcome: Outcome) -> None:
        """Keep what a worker found."""
        source = self.sources[task.source]
        if task.part.named:
            self.named.add(task.source)
        if not outcome.digests:
            if outcome.counts is not None and len(outcome.counts.findings):
                self.counted.apart += outcome.counts.named(source.document)
                self.incomplete.add(task.source)
        else:
            if outcome.counts is not None:
                self.counted.fresh += 1
                self.archive.write(part_key(task.key, outcome.digests), outcome.counts)
            self._place(task.source, task.number, source, outcome.digests)
        self._report(task.part.weight)

    def _place(self, number: int, part: int, source: Source, digests: Digests) -> None:
        document = "" if number in self.named else source.document
        aligned = source.kind == ALIGNED
        key = part_key(ALIGNMENTS if aligned else self.counter.key, digests)
        self.counted.places.append(Place(number, part, document, aligned, key, digests))

    def _report(self, size: int) -> None:
        self.done += size
        report("counting", min(self.done, self.total) if self.total else self.done, max(self.total, 1))

    def _give_up(self, task: Task) -> Outcome:
        """The outcome of a part that ends its workers: that of its halves, down to the piece that does it, which is left out."""
        digests = task.part.read().digests
        halves = task.part.halves()
        if not halves:
            return Outcome(digests, finding("", CRASHED, f"{task.part.weight} bytes of {self.sources[task.source].document}"))
        work = partial(count_part, self.counter, None)
        pieces = [task._replace(part=half) for half in halves]
        found = [self.workers.alone(work, piece) or self._give_up(piece) for piece in pieces]
        return Outcome(digests, Counts.sum(half.counts for half in found if half.counts is not None))


def count_part(counter: Counter, archive: Archive | None, task: Task) -> Outcome:
    """Count one part, unless its counts are kept. This is what workers do."""
    try:
        content = task.part.read()
        if not content.digests:
            return Outcome((), None)
        if archive and (content.digests == task.kept or archive.has(part_key(task.key, content.digests))):
            return Outcome(content.digests, None)
        return Outcome(content.digests, content.counted(counter))
    except (OSError, pa.ArrowException) as error:
        return Outcome((), finding("", CUT_OFF, str(error)))


def seconds(task: Task) -> float:
    """How much of a processor's time *task* may take."""
    return SECONDS + SECONDS_A_MEGABYTE * task.part.weight / 1e6
