"""The exact way of counting: every line as the voice says it, lines that are alike once."""

from __future__ import annotations

from array import array
from collections import Counter as Tally
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
        alike = Tally(zip(lines.document.tolist(), lines.texts.to_pylist(), strict=True))
        codes, lengths, spoken = array("H"), [], np.zeros(len(lines.names), np.int64)
        findings: dict[tuple[int, str], tuple[int, str]] = {}
        said_all = speaker.say_all([text for _, text in alike])
        for ((document, text), times), said in zip(alike.items(), said_all, strict=True):
            codes.extend(said.codes)
            lengths.append(len(said.codes))
            if said.codes:
                spoken[document] += times
            for reason in said.reasons:
                before, example = findings.get((document, reason), (0, ""))
                findings[document, reason] = before + times, min(example, text) if before else text
        return Counts.of(
            pairs=_pairs(lines, alike, np.array(lengths, np.int64), np.asarray(codes), speaker.labels),
            findings=_findings(lines, findings),
            documents=_documents(lines, spoken),
        )


def _pairs(
    lines: Lines, alike: dict[tuple[int, str], int], lengths: NDArray[np.int64], codes: NDArray[np.uint16], labels: list[str]
) -> pa.Table:
    if not len(codes):
        return pair_table(lines, np.zeros(0, np.int64), codes, labels)
    document = np.repeat([document for document, _ in alike], lengths)
    times = np.fromiter(alike.values(), np.int64)
    return pair_table(lines, document, codes, labels, np.repeat(times, lengths) if times.max() > 1 else None)


def _findings(lines: Lines, found: dict[tuple[int, str], tuple[int, str]]) -> pa.Table:
    rows = [(lines.names[document], reason, count, shown(example)) for (document, reason), (count, example) in found.items()]
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
