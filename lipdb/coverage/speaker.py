"""A voice at work in one process: lines to codes of labels, and what there is to report of each line."""

from __future__ import annotations

import re
import sys
import unicodedata
from array import array
from collections.abc import Sequence
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
from lipdb.speech.phonemes import BREAK, SWITCH
from lipdb.speech.text import LONGEST_WORD, check_script, cleaned_up, is_plain
from lipdb.speech.voice import Reading, Voice

REMEMBERED = 1 << 16
"""Lines that a process looks back on: one that it has met twice among them costs nothing."""
LONGEST_REMEMBERED = 512
LONGEST_PIECE = 2000
"""Characters that a voice is given at once: some need time by the square of them."""
_AT_ONCE = 256
_VOCABULARY = 1 << 17
_END, _END_CODE = 2 * BREAK, b"\xff\xff"
"""The end of a line among words, and among their codes: no label has it."""
_BETWEEN = f" {BREAK} {_END} {BREAK} "
_PIECE = re.compile(
    rf"(.{{1,{LONGEST_PIECE}}}[.!?。！？…;；।؟])(?=\s|$)|(.{{1,{LONGEST_PIECE}}}(?=\s|$)|.{{1,{LONGEST_PIECE}}})", re.DOTALL
)


class Said(NamedTuple):
    """A line as it was said: codes of its labels in a phrase each, with ``_`` around them, and what there is to report."""

    codes: array[int]
    reasons: tuple[str, ...]


Row = tuple[bytes, tuple[str, ...]]
"""The same with the codes as bytes, two each."""


@runtime_checkable
class ReadsForeign(Protocol):
    """A voice that can tell which words it reads by the rules of another language."""

    def read(self, text: str) -> Reading:
        """As `Voice.phrases`, with the number of foreign words."""


@runtime_checkable
class Spells(Protocol):
    """A voice that tells its words as its engine spells them: they come again and again, and need be taken apart only once."""

    def checked(self, text: str) -> tuple[str, bool]:
        """*text* as the engine is to be given it, and whether it `is_ordinary`. Raises `InputError` where the voice can't read it."""

    def spelled(self, texts: Sequence[str]) -> list[str]:
        """Each of *texts*, words between spaces, `BREAK` between phrases and `SWITCH` around those of another language."""

    def symbols_of(self, word: str) -> tuple[str, ...]:
        """The symbols of a word of `spelled`."""


class Speaker:
    """A voice at work in one process: it remembers words, and lines that it has said."""

    def __init__(self, voice: Voice) -> None:
        self.voice = voice
        # Asked once: Python takes as long for the question as a voice for a word.
        self._spells = voice if isinstance(voice, Spells) else None
        self._foreign = voice if isinstance(voice, ReadsForeign) else None
        self._words = _Words(self._spells)
        self.labels = self._words.labels
        self._lines: dict[str, Row] = {}
        self._met: set[int] = set()

    def say(self, text: str) -> Said:
        """*text* as the voice says it; no codes when it can't."""
        [(codes, reasons)] = self.say_all([text])
        return Said(array("H", codes), reasons)

    def say_all(self, texts: Sequence[str]) -> list[Row]:
        """Each of *texts* as the voice says it.

        First the engine speaks, then its words are taken apart, some lines at once: in turn, each would push the other out
        of the processor's cache.
        """
        rows: list[Row] = []
        for start in range(0, len(texts), _AT_ONCE):
            some = texts[start : start + _AT_ONCE]
            asked = [self._lines.get(text) or self._ask(text) for text in some]
            heard = iter(self._heard([one for one, _ in asked if isinstance(one, str)]))
            rows += [_with(next(heard), reasons) if isinstance(one, str) else (one, reasons) for one, reasons in asked]
            self._remember(some, rows[start:])
        return rows

    def _ask(self, text: str) -> tuple[str | bytes, tuple[str, ...]]:
        """*text* as the engine is to be given it, or codes of what it says; and what there is to report."""
        if len(text) > LONGEST_PIECE:
            return self._say_pieces(text)
        try:
            if self._spells:
                checked, ordinary = self._spells.checked(text)
                return checked, () if ordinary else _remarks(text)
            return _with(self._read(text), _remarks(text))
        except InputError:
            return b"", (self._refused(text),)
        except LipdbError:
            raise  # The voice can't work at all.
        except Exception:  # noqa: BLE001  (a voice that fails on one line must not stop a corpus; the line is reported)
            return b"", (FAILED,)

    def _read(self, text: str) -> Row:
        """What a voice that does not spell says of *text*."""
        reading = self._foreign.read(text) if self._foreign else Reading(self.voice.phrases(text))
        words: list[str | tuple[str, ...]] = [BREAK]
        for phrase in reading.phrases:
            words += (*phrase, BREAK)
        return _row(self._codes(words), foreign=reading.foreign > 0)

    def _heard(self, texts: list[str]) -> list[Row]:
        """What the engine says of each of *texts*, and what that alone tells."""
        if not texts or not self._spells:
            return []
        try:
            spelled = self._spells.spelled(texts)
        except LipdbError:
            raise
        except Exception:  # noqa: BLE001  (as above)
            return [(b"", (FAILED,))] if len(texts) == 1 else [row for text in texts for row in self._heard([text])]
        foreign = {k for k, one in enumerate(spelled) if "(" in one and SWITCH.search(one)}
        for k in foreign:
            spelled[k] = SWITCH.sub("", spelled[k])
        words = f"{BREAK} {_BETWEEN.join(spelled)} {BREAK}".split()
        return [_row(row, foreign=k in foreign) for k, row in enumerate(self._codes(words).split(_END_CODE))]

    def _codes(self, words: Sequence[str | tuple[str, ...]]) -> bytes:
        return b"".join(map(self._words.__getitem__, words))

    def _say_pieces(self, text: str) -> Row:
        """A long line in pieces that end where a sentence does, or else between words."""
        codes, found = b"", dict[str, None]()
        for sentence, rest in _PIECE.findall(text):
            [(more, reasons)] = self.say_all([sentence or rest])
            codes += more
            found |= dict.fromkeys(reason for reason in reasons if reason != NO_WORDS)
            if rest.strip() and len(rest) > LONGEST_PIECE // 2:
                found[LONG_LINE] = None
        return codes, tuple(found) if codes or found else (NO_WORDS,)

    def _remember(self, texts: Sequence[str], rows: Sequence[Row]) -> None:
        """Keep what comes a second time: most lines never do, and to keep them all costs more than it saves."""
        if len(self._met) >= REMEMBERED:
            self._met.clear()
            self._lines.clear()
        marks = set(map(hash, texts))
        if not self._met.isdisjoint(marks):
            self._lines.update(
                (text, row) for text, row in zip(texts, rows, strict=True) if hash(text) in self._met and len(text) <= LONGEST_REMEMBERED
            )
        self._met |= marks

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


class _Words(dict[str | tuple[str, ...], bytes]):
    """Words as the voice *spells* them, or their labels, to the codes of their *labels*; `BREAK` is ``_``.

    A word that is missing is taken apart: they come again and again.
    """

    def __init__(self, spells: Spells | None) -> None:
        self.labels = [SILENCE]
        self._spells, self._code = spells, {SILENCE: 0}

    def __missing__(self, word: str | tuple[str, ...]) -> bytes:
        if len(self) >= _VOCABULARY:
            self.clear()
        self[word] = _END_CODE if word == _END else array("H", map(self._code_of, self._labels_of(word))).tobytes()
        return self[word]

    def _labels_of(self, word: str | tuple[str, ...]) -> tuple[str, ...]:
        if word == BREAK:
            return (SILENCE,)
        return self._spells.symbols_of(word) if self._spells and isinstance(word, str) else tuple(word)

    def _code_of(self, label: str) -> int:
        if label not in self._code:
            self._code[label] = len(self.labels)
            self.labels.append(label)
        return self._code[label]


def _row(codes: bytes, *, foreign: bool) -> Row:
    """*codes*, none when they are all of silence, and what they tell of the line."""
    if not codes.strip(b"\0"):
        return b"", (NO_WORDS,)
    return codes, (FOREIGN,) if foreign else ()


def _with(row: Row, remarks: tuple[str, ...]) -> Row:
    """*row* with *remarks* on the text, where anything of it was said."""
    return (row[0], (*remarks, *row[1])) if remarks and row[0] else row


def _remarks(text: str) -> tuple[str, ...]:
    """What of *text* is read in a way that a person may not expect."""
    if not named_signs().search(text) and len(text) <= LONGEST_WORD and is_plain(text):
        return ()
    cleaned = cleaned_up(text)
    named = named_signs().findall(cleaned.text)
    present = {
        EMOJI: cleaned.emoji,
        CONTROLS: cleaned.broken,
        LONG_WORDS: cleaned.long,
        NUMBERS: any(unicodedata.category(c)[0] == "N" for c in named),
        SYMBOLS: any(unicodedata.category(c)[0] != "N" for c in named),
    }
    return tuple(reason for reason in REASONS if present.get(reason))


@cache
def named_signs() -> re.Pattern[str]:
    """Digits, and symbols that voices read by their names."""
    kinds = ("Nd", "Sc", "Sm")
    return re.compile(
        "["
        + re.escape("".join(c for c in map(chr, range(min(0x10000, sys.maxunicode))) if unicodedata.category(c) in kinds or c in "%&@#"))
        + "]"
    )
