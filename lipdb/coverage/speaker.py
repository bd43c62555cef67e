"""A voice at work in one process: lines to codes of labels, and what there is to report of each line."""

from __future__ import annotations

import re
import sys
import unicodedata
from array import array
from collections.abc import Iterator, Sequence
from functools import cache
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
from lipdb.speech.phonemes import SWITCH
from lipdb.speech.text import LONGEST_WORD, check_script, cleaned_up, is_plain
from lipdb.speech.voice import Reading, Voice

REMEMBERED = 1 << 16
"""Lines that a process looks back on: one that it has met twice among them costs nothing."""
LONGEST_REMEMBERED = 512
LONGEST_PIECE = 2000
"""Characters that a voice is given at once: some need time by the square of them."""
_AT_ONCE = 256
_VOCABULARY = 1 << 17
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


@runtime_checkable
class Spells(Protocol):
    """A voice that tells its words as its engine spells them: they come again and again, and need be taken apart only once."""

    def spelled(self, text: str) -> list[str]:
        """The phrases of *text*, words between spaces, and `SWITCH` around those of another language."""

    def symbols_of(self, word: str) -> tuple[str, ...]:
        """The symbols of a word of `spelled`."""


class Speaker:
    """A voice at work in one process: it remembers words, and lines that it has said."""

    def __init__(self, voice: Voice) -> None:
        self.voice = voice
        # Asked once: Python takes as long for the question as a voice for a word.
        self._spells = voice if isinstance(voice, Spells) else None
        self._foreign = voice if isinstance(voice, ReadsForeign) else None
        self.labels = [SILENCE]
        self._code = {SILENCE: 0}
        self._words: dict[str | tuple[str, ...], array[int]] = {}
        self._lines: dict[str, Said] = {}
        self._met: set[int] = set()

    def say(self, text: str) -> Said:
        """*text* as the voice says it; no codes when it can't."""
        return next(self.say_all([text]))

    def say_all(self, texts: Sequence[str]) -> Iterator[Said]:
        """Each of *texts* as the voice says it.

        First the engine speaks, then its words are taken apart, some lines at once: in turn, each would push the other out
        of the processor's cache.
        """
        for start in range(0, len(texts), _AT_ONCE):
            some = texts[start : start + _AT_ONCE]
            asked = [self._lines.get(text) or self._ask(text) for text in some]
            yield from map(self._told, some, asked)

    def _ask(self, text: str) -> Said | list[str] | Reading:
        """What the engine makes of *text*, not taken apart yet; or all of it, where it is long or can't be said."""
        if len(text) > LONGEST_PIECE:
            return self._say_pieces(text)
        try:
            if self._spells:
                return self._spells.spelled(text)
            return self._foreign.read(text) if self._foreign else Reading(self.voice.phrases(text))
        except InputError:
            return Said(array("H"), (self._refused(text),))
        except LipdbError:
            raise  # The voice can't work at all.
        except Exception:  # noqa: BLE001  (a voice that fails on one line must not stop a corpus; the line is reported)
            return Said(array("H"), (FAILED,))

    def _told(self, text: str, asked: Said | list[str] | Reading) -> Said:
        """The codes of what the engine made of *text*."""
        if isinstance(asked, Said):
            return asked
        codes, foreign = self._spelled(asked) if isinstance(asked, list) else self._read(asked)
        said = Said(codes, _remarks(text, foreign)) if any(codes) else Said(array("H"), (NO_WORDS,))
        if len(text) <= LONGEST_REMEMBERED:
            self._remember(text, said)
        return said

    def _remember(self, text: str, said: Said) -> None:
        """Keep what comes a second time: most lines never do, and to keep them all costs more than it saves."""
        if len(self._met) >= REMEMBERED:
            self._met.clear()
            self._lines.clear()
        mark = hash(text)
        if mark in self._met:
            self._lines[text] = said
        self._met.add(mark)

    def _spelled(self, phrases: list[str]) -> tuple[array[int], int]:
        codes, switches, known = array("H", (0,)), 0, self._words.get
        for phrase in phrases:
            bare, found = SWITCH.subn("", phrase) if "(" in phrase else (phrase, 0)
            switches += found
            for word in bare.split():
                codes.extend(known(word) or self._learn(word))
            codes.append(0)
        return codes, switches

    def _read(self, reading: Reading) -> tuple[array[int], int]:
        codes = array("H", (0,))
        for phrase in reading.phrases:
            for word in phrase:
                codes.extend(self._words.get(word) or self._learn(word))
            codes.append(0)
        return codes, reading.foreign

    def _say_pieces(self, text: str) -> Said:
        """A long line in pieces that end where a sentence does, or else between words."""
        codes, reasons = array("H"), dict[str, None]()
        for sentence, rest in _PIECE.findall(text):
            said = self.say(sentence or rest)
            codes.extend(said.codes)
            reasons |= dict.fromkeys(reason for reason in said.reasons if reason != NO_WORDS)
            if rest.strip() and len(rest) > LONGEST_PIECE // 2:
                reasons[LONG_LINE] = None
        return Said(codes, tuple(reasons) if codes or reasons else (NO_WORDS,))

    def _learn(self, word: str | tuple[str, ...]) -> array[int]:
        """The codes of *word*, from now on without taking it apart."""
        if len(self._words) >= _VOCABULARY:
            self._words.clear()
        symbols = self._spells.symbols_of(word) if self._spells and isinstance(word, str) else tuple(word)
        self._words[word] = self._codes(symbols)
        return self._words[word]

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


def _remarks(text: str, foreign_words: int) -> tuple[str, ...]:
    """What of *text* was read in a way that a person may not expect."""
    foreign = (FOREIGN,) if foreign_words else ()
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
