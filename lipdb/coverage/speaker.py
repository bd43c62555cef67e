"""A voice at work in one process: lines to codes of labels, and what there is to report of each line."""

from __future__ import annotations

import re
import sys
import unicodedata
from array import array
from collections.abc import Callable
from functools import cache, lru_cache
from typing import NamedTuple, Protocol, runtime_checkable

from lipdb.coverage.findings import (
    CONTROLS,
    EMOJI,
    FAILED,
    FOREIGN,
    LONG_LINE,
    LONG_WORDS,
    NO_WORDS,
    NOT_SAID,
    NUMBERS,
    OTHER_SCRIPT,
    REASONS,
    SYMBOLS,
)
from lipdb.errors import InputError, LipdbError
from lipdb.schedule import SILENCE
from lipdb.speech.text import LONGEST_WORD, check_script, cleaned_up, is_plain
from lipdb.speech.voice import Reading, Voice

REMEMBERED = 1 << 16
"""Lines that a process remembers, so that one that comes again in another part costs nothing."""
LONGEST_REMEMBERED = 512
LONGEST_PIECE = 2000
"""Characters that a voice is given at once: some need time by the square of them."""
_PIECE = re.compile(
    rf"(.{{1,{LONGEST_PIECE}}}[.!?。！？…;；।؟])(?=\s|$)|(.{{1,{LONGEST_PIECE}}}(?=\s|$)|.{{1,{LONGEST_PIECE}}})", re.DOTALL
)


class Said(NamedTuple):
    """A line as it was said: codes of its labels in a phrase each, with ``_`` around them, and what there is to report."""

    codes: array[int]
    reasons: tuple[str, ...]


@runtime_checkable
class ReadsForeign(Protocol):
    """A voice that can tell which words it reads by the rules of another language."""

    def read(self, text: str) -> Reading:
        """As `Voice.phrases`, with the number of foreign words."""


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
        return self._say_piece(text) if len(text) <= LONGEST_PIECE else self._say_pieces(text)

    def _say_pieces(self, text: str) -> Said:
        """A long line in pieces that end where a sentence does, or else between words."""
        codes, reasons = array("H"), dict[str, None]()
        for sentence, rest in _PIECE.findall(text):
            said = self._say_piece(sentence or rest)
            codes.extend(said.codes)
            reasons |= dict.fromkeys(reason for reason in said.reasons if reason != NO_WORDS)
            if rest.strip() and len(rest) > LONGEST_PIECE // 2:
                reasons[LONG_LINE] = None
        return Said(codes, tuple(reasons) if codes or reasons else (NO_WORDS,))

    def _say_piece(self, text: str) -> Said:
        try:
            reading = self._read(text)
        except InputError:
            return Said(array("H"), (self._refused(text),))
        except LipdbError:
            raise  # The voice can't work at all.
        except Exception:  # noqa: BLE001  (a voice that fails on one line must not stop a corpus; the line is reported)
            return Said(array("H"), (FAILED,))
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


def _remarks(text: str, reading: Reading) -> tuple[str, ...]:
    """What of *text* was read in a way that a person may not expect."""
    foreign = (FOREIGN,) if reading.foreign else ()
    if not _named().search(text) and len(text) <= LONGEST_WORD and is_plain(text):
        return foreign
    cleaned = cleaned_up(text)
    named = _named().findall(cleaned.text)
    present = {
        EMOJI: cleaned.emoji,
        CONTROLS: cleaned.broken,
        LONG_WORDS: cleaned.long,
        NUMBERS: any(unicodedata.category(c)[0] == "N" for c in named),
        SYMBOLS: any(unicodedata.category(c)[0] != "N" for c in named),
    }
    return (*(reason for reason in REASONS if present.get(reason)), *foreign)


@cache
def _named() -> re.Pattern[str]:
    """Digits, and symbols that voices read by their names."""
    kinds = ("Nd", "Sc", "Sm")
    return re.compile(
        "["
        + re.escape("".join(c for c in map(chr, range(min(0x10000, sys.maxunicode))) if unicodedata.category(c) in kinds or c in "%&@#"))
        + "]"
    )
