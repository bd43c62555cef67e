"""Every line of a corpus with the pairs of common phones that it holds: what sentences are chosen from."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from lipdb.coverage.corpus import ALIGNED, Source, parts, sources
from lipdb.coverage.counts import Counts, Lines
from lipdb.coverage.cut import BLOCK
from lipdb.coverage.reports.frequency import Pair
from lipdb.coverage.resolve import units_of
from lipdb.coverage.speaker import Speaker
from lipdb.errors import InputError
from lipdb.phones.phoneset import PhoneSet
from lipdb.progress import report
from lipdb.schedule import SILENCE
from lipdb.speech.voice import Voice


def sentences_of(paths: Sequence[str], voice: Voice, phoneset: PhoneSet, *, silence: bool = True) -> list[tuple[str, frozenset[Pair]]]:
    """The lines of the corpus at *paths* that the voice can say, each once, with their pairs; those with ``_`` only with *silence*.

    Memory grows with the lines. Raises `InputError` for a path that is not there, and when no line can be said.
    """
    found = _Collector(voice.raw())
    files = [one for one in sources(paths) if isinstance(one, Source) and one.kind != ALIGNED]
    total, done = max(sum(file.size for file in files), 1), 0
    for file in files:
        for part in parts(file, found.size):
            if not isinstance(part, Counts):
                part.read().counted(found)
                done += part.weight
                report("reading", min(done, total), total)
    if not found.codes:
        raise InputError(f"{', '.join(paths)}: holds no line that {phoneset.language} can say; give text in the language")
    units, _ = units_of(found.speaker.labels, phoneset, voice.notation)
    common = [tuple(name for _, name in row) for row in units]
    return [(text, _pairs(codes, common, silence)) for text, codes in found.codes.items()]


def pairs_in(codes: Sequence[int], common: Sequence[tuple[str, ...]]) -> list[Pair]:
    """The pairs of common phones that follow each other in a line of *codes* of labels, in order; *common* is by code."""
    phones = [name for code in codes for name in common[code]]
    return [pair for pair in pairwise(phones) if pair != (SILENCE, SILENCE)]


def _pairs(codes: Sequence[int], common: Sequence[tuple[str, ...]], silence: bool) -> frozenset[Pair]:
    return frozenset(pair for pair in pairs_in(codes, common) if silence or SILENCE not in pair)


class _Collector:
    """A counter that counts nothing, but keeps what each line says."""

    size, threads = BLOCK, False
    key = mode = ""

    def __init__(self, voice: Voice) -> None:
        self.notation = voice.notation
        self.speaker = Speaker(voice)
        self.codes: dict[str, Sequence[int]] = {}

    def count(self, lines: Lines) -> Counts:
        for text in lines.texts.to_pylist():
            if text not in self.codes and (codes := self.speaker.say(text).codes):
                self.codes[text] = codes
        return Counts.of()
