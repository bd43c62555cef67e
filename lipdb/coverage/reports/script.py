"""A script: lines that somebody will speak, and which pairs of common phones each of them needs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lipdb.coverage.findings import REASONS
from lipdb.coverage.reports.frequency import Frequency, Pair
from lipdb.coverage.reports.sentences import pairs_in
from lipdb.coverage.resolve import units_of
from lipdb.coverage.speaker import Speaker
from lipdb.errors import InputError
from lipdb.files import encoding_of
from lipdb.progress import report

if TYPE_CHECKING:
    from lipdb.phones.phoneset import PhoneSet
    from lipdb.speech.voice import Voice

_STEP = 100
"""Lines from one report to the next."""


@dataclass(frozen=True, slots=True)
class ScriptLine:
    """A line, numbered from 1 as an editor numbers it, with how often it needs each pair; or why it is *left_out*."""

    number: int
    text: str
    pairs: Mapping[Pair, int]
    left_out: str = ""


@dataclass(frozen=True, slots=True)
class Script:
    """The *lines* of a script that are not blank, as a language's voice says them; *unknown* says which labels no table knows."""

    lines: tuple[ScriptLine, ...]
    unknown: tuple[str, ...] = ()

    def frequency(self, *, silence: bool = True) -> Frequency:
        """How often the script needs each pair; those with ``_`` only with *silence*."""
        return Frequency.of(((*pair, count) for line in self.lines for pair, count in line.pairs.items()), silence=silence)

    def needing(self, pair: Pair) -> list[ScriptLine]:
        """The lines that need *pair*."""
        return [line for line in self.lines if pair in line.pairs]

    @property
    def left_out(self) -> list[ScriptLine]:
        """The lines that the voice can't say."""
        return [line for line in self.lines if line.left_out]


def read_script(text: str, voice: Voice, phoneset: PhoneSet) -> Script:
    """The script *text*, a sentence or more on each line. Raises `InputError` when the voice can say none of its lines."""
    numbered = [(number, line.strip()) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    raw = voice.raw()
    speaker, said = Speaker(raw), []
    for done, (_, line) in enumerate(numbered, 1):
        said.append(speaker.say(line))
        if not done % _STEP or done == len(numbered):
            report("reading", done, len(numbered))
    units, unknown = units_of(speaker.labels, phoneset, raw.notation)
    common = [tuple(name for _, name in row) for row in units]
    lines = [
        ScriptLine(number, line, Counter(pairs_in(one.codes, common)), "" if one.codes else _why(one.reasons))
        for (number, line), one in zip(numbered, said, strict=True)
    ]
    if not any(line.pairs for line in lines):
        why = f"; line {lines[0].number}: {lines[0].left_out}" if lines else ""
        raise InputError(f"there is no line that {phoneset.language} can say{why}; give text in the language")
    return Script(tuple(lines), tuple(unknown.values()))


def decoded(raw: bytes) -> str:
    """The text in *raw*: UTF-8, or UTF-16 with its mark. Raises `InputError` for anything else."""
    try:
        text = raw.decode(encoding_of(raw))
    except UnicodeDecodeError as error:
        raise InputError(f"this is no text in UTF-8 (byte {error.start:,}); save it as plain text in UTF-8") from error
    if "\0" in text:
        raise InputError("this is no text: it has zero bytes; save it as plain text in UTF-8")
    return text


def _why(reasons: Sequence[str]) -> str:
    return "; ".join(REASONS[reason].meaning for reason in reasons)
