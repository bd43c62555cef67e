"""The exact way of counting: every line as the voice says it, lines that are alike once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.counts import DOCUMENTS, FINDINGS, Counts, Lines, pair_table
from lipdb.coverage.cut import BLOCK
from lipdb.coverage.lines import shown
from lipdb.coverage.speaker import Speaker
from lipdb.speech.voice import Voice

VERSION = 1
"""Change it with anything that changes counts of the same labels."""
_VOICES = 4


@dataclass(frozen=True)
class ExactCounter:
    """Counts what *voice* says of every line; see `lipdb.coverage.counts.Counter`. Give it `Voice.raw`."""

    voice: Voice

    @property
    def key(self) -> str:
        """The way of counting and the voice."""
        return f"exact {VERSION}; {self.voice.language} {self.voice.name}; {self.voice.version}"

    @property
    def mode(self) -> str:
        """Always ``exact``."""
        return "exact"

    @property
    def notation(self) -> str:
        """That of the voice."""
        return self.voice.notation

    @property
    def size(self) -> int:
        """A quarter of a megabyte, about half a second: short enough that two processes end together."""
        return BLOCK

    @property
    def threads(self) -> bool:
        """A process has one espeak."""
        return False

    def count(self, lines: Lines) -> Counts:
        """The pairs of every line, a pause wherever the voice makes one."""
        speaker = _speaker(self.voice)
        different = lines.texts.dictionary_encode()
        texts: list[str] = different.dictionary.to_pylist()
        said = speaker.say_all(texts)
        # What is alike in a document is counted once, as often as it comes.
        alike, times = np.unique(lines.document.astype(np.int64) * len(texts) + different.indices.to_numpy(), return_counts=True)
        document, line = np.divmod(alike, max(len(texts), 1))
        spoken = np.bincount(document, times * np.array([bool(codes) for codes, _ in said], bool)[line], len(lines.names))
        return Counts.of(
            pairs=_pairs(lines, document, times, [said[k][0] for k in line.tolist()], speaker.labels),
            findings=_findings(lines, document, times, [(texts[k], said[k][1]) for k in line.tolist()]),
            documents=_documents(lines, spoken.astype(np.int64)),
        )


def _pairs(lines: Lines, document: NDArray[np.int64], times: NDArray[np.int64], said: Sequence[bytes], labels: list[str]) -> pa.Table:
    codes = np.frombuffer(b"".join(said), np.uint16)
    lengths = np.fromiter(map(len, said), np.int64) // codes.itemsize
    weights = np.repeat(times, lengths) if len(times) and times.max() > 1 else None
    return pair_table(lines, np.repeat(document, lengths), codes, labels, weights)


def _findings(lines: Lines, document: NDArray[np.int64], times: NDArray[np.int64], told: Sequence[tuple[str, tuple[str, ...]]]) -> pa.Table:
    found: dict[tuple[int, str], tuple[int, str]] = {}
    for place, (text, reasons) in enumerate(told):
        for reason in reasons:
            key = int(document[place]), reason
            before, example = found.get(key, (0, text))
            found[key] = before + int(times[place]), min(example, text)
    rows = [(lines.names[of], reason, count, shown(example)) for (of, reason), (count, example) in found.items()]
    return pa.table([list(column) for column in zip(*rows, strict=True)] if rows else [[]] * 4, schema=FINDINGS)


def _documents(lines: Lines, spoken: NDArray[np.int64]) -> pa.Table:
    given = np.bincount(lines.document, minlength=len(lines.names))
    return pa.table([pa.array(lines.names, pa.string()), given.astype(np.int64), spoken], schema=DOCUMENTS)


def _speaker(voice: Voice) -> Speaker:
    """The speaker of *voice* in this process; of several voices, the last few."""
    key = f"{voice.language} {voice.name} {voice.version}"
    if key not in _SPEAKERS:
        while len(_SPEAKERS) >= _VOICES:
            del _SPEAKERS[next(iter(_SPEAKERS))]
        _SPEAKERS[key] = Speaker(voice)
    return _SPEAKERS[key]


_SPEAKERS: dict[str, Speaker] = {}
