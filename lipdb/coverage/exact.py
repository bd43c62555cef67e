"""The exact way of counting: every line as the voice says it, lines that are alike once."""

from __future__ import annotations

import re
import sys
import unicodedata
from array import array
from collections import Counter as Tally
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.counts import DOCUMENTS, FINDINGS, Counts, Lines, pair_table
from lipdb.coverage.cut import BLOCK
from lipdb.coverage.findings import (
    CONTROLS,
    EMOJI,
    FOREIGN,
    LONG_WORDS,
    NO_WORDS,
    NOT_SAID,
    NUMBERS,
    OTHER_SCRIPT,
    REASONS,
    SYMBOLS,
)
from lipdb.coverage.lines import shown
from lipdb.errors import InputError
from lipdb.schedule import SILENCE
from lipdb.speech.text import LONGEST_WORD, check_script, cleaned_up, is_plain
from lipdb.speech.voice import Reading, Voice

VERSION = 1
"""Change it with anything that changes counts of the same labels."""
REMEMBERED = 1 << 16
"""Lines that a process remembers, so that one that comes again in another part costs nothing."""
LONGEST_REMEMBERED = 512
_VOICES = 4


class Said(NamedTuple):
    """A line as it was said: codes of its labels in a phrase each, with ``_`` around them, and what there is to report."""

    codes: array[int]
    reasons: tuple[str, ...]


@runtime_checkable
class ReadsForeign(Protocol):
    """A voice that can tell which words it reads by the rules of another language."""

    def read(self, text: str) -> Reading:
        """As `Voice.phrases`, with the number of foreign words."""


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
        for (document, text), times in alike.items():
            said = speaker.say(text)
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


class Speaker:
    """A voice at work in one process: it remembers words, and lines that it has said."""

    def __init__(self, voice: Voice) -> None:
        self.voice = voice
        self.labels = [SILENCE]
        self._code = {SILENCE: 0}
        self._word = lru_cache(maxsize=1 << 17)(self._codes)
        self._read: Callable[[str], Reading] = voice.read if isinstance(voice, ReadsForeign) else lambda text: Reading(voice.phrases(text))
        self._remembered = lru_cache(maxsize=REMEMBERED)(self._say)

    def say(self, text: str) -> Said:
        """*text* as the voice says it; no codes when it can't."""
        return self._remembered(text) if len(text) <= LONGEST_REMEMBERED else self._say(text)

    def _say(self, text: str) -> Said:
        try:
            reading = self._read(text)
        except InputError:
            return Said(array("H"), (self._refused(text),))
        codes = array("H", (0,))
        for phrase in reading.phrases:
            for word in phrase:
                codes.extend(self._word(word))
            codes.append(0)
        return Said(codes if len(codes) > 1 else array("H"), _remarks(text, reading) if len(codes) > 1 else (NO_WORDS,))

    def _codes(self, word: tuple[str, ...]) -> array[int]:
        for label in word:
            if label not in self._code:
                self._code[label] = len(self.labels)
                self.labels.append(label)
        return array("H", [self._code[label] for label in word])

    def _refused(self, text: str) -> str:
        """Why the voice did not read *text*."""
        try:
            cleaned = cleaned_up(text).text
        except InputError:
            return NO_WORDS
        try:
            check_script(cleaned, self.voice.script, language=self.voice.language)
        except InputError:
            return OTHER_SCRIPT
        return NOT_SAID


def _speaker(voice: Voice) -> Speaker:
    """The speaker of *voice* in this process; of several voices, the last few."""
    key = f"{voice.language} {voice.name} {voice.version}"
    if key not in _SPEAKERS:
        while len(_SPEAKERS) >= _VOICES:
            del _SPEAKERS[next(iter(_SPEAKERS))]
        _SPEAKERS[key] = Speaker(voice)
    return _SPEAKERS[key]


def _remarks(text: str, reading: Reading) -> tuple[str, ...]:
    """What of *text* was read in a way that a person may not expect."""
    foreign = (FOREIGN,) if reading.foreign else ()
    named = _named().search(text)
    if not named and len(text) <= LONGEST_WORD and is_plain(text):
        return foreign
    cleaned = cleaned_up(text)
    present = {
        EMOJI: cleaned.emoji,
        CONTROLS: cleaned.broken,
        LONG_WORDS: cleaned.long,
        NUMBERS: named and any(unicodedata.category(c)[0] == "N" for c in text),
        SYMBOLS: named and any(unicodedata.category(c)[0] != "N" for c in _named().findall(text)),
    }
    return (*(reason for reason in REASONS if present.get(reason)), *foreign)


_SPEAKERS: dict[str, Speaker] = {}


@cache
def _named() -> re.Pattern[str]:
    """Digits, and symbols that voices read by their names."""
    kinds = ("Nd", "Sc", "Sm")
    return re.compile(
        "["
        + re.escape("".join(c for c in map(chr, range(min(0x10000, sys.maxunicode))) if unicodedata.category(c) in kinds or c in "%&@#"))
        + "]"
    )
