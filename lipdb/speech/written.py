"""A voice for languages that no program speaks: text is read letter by letter as the language's own phones, in even time.

There is no sound, so the face moves in silence. Invented languages and those without a synthesis are tried out with it.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from lipdb.curated.tsv import Records
from lipdb.errors import InputError
from lipdb.phones.symbols import Symbols
from lipdb.schedule import SILENCE, Phone
from lipdb.sound import Sound
from lipdb.speech.espeak import language_row
from lipdb.speech.text import clean
from lipdb.speech.voice import Phrases, Spoken, lay_out

NAME = "none"
"""What stands in the column *voice* of such a language."""
VOWEL, CONSONANT, PAUSE = 0.11, 0.08, 0.25
"""Seconds. Hand-checked English has 78 and 80 ms a phone; slower is easier to look at."""
RATE = 16_000
_PHRASES = re.compile(r"[.,;:!?¡¿…。！？、，؟،؛।\n]+|\s[–—-]+\s")
_EDGES = re.compile(r"^[^\w]+|[^\wːˑʰʲʷˠˤʼ]+$")
_SKIPPED = "ˈˌːˑ.'’-‿͡"


def written_voice(records: Records, language: str) -> WrittenVoice:
    """The voice of *language*, whose row names its notation. Raises `PhonesetError` when that is missing."""
    row = language_row(records, language)
    symbols = Symbols.from_records(records, language, row["notation"])
    table = {symbol: parts for symbol, parts in symbols.aliases[symbols.own].items() if symbol != SILENCE}
    vowels = frozenset(one["phone"] for one in records.get(f"{language}/phones.tsv", {}).values() if one["kind"] == "vowel")
    readings = {word: one["reading"] for (word,), one in records.get(f"{language}/readings.tsv", {}).items()}
    return WrittenVoice(row["voice"], language, row["script"], symbols.own, table, vowels, readings)


@dataclass(frozen=True, slots=True)
class WrittenVoice:
    """Reads words by the longest of the *table*'s spellings (phones and aliases), or as *readings* say; see `Voice`."""

    name: str
    language: str
    script: str
    notation: str
    table: Mapping[str, tuple[str, ...]] = field(hash=False)
    vowels: frozenset[str]
    readings: Mapping[str, str] = field(default_factory=dict, hash=False)

    @property
    def version(self) -> str:
        """The tables that decide what is read, and the times."""
        told = sorted(self.table.items()), sorted(self.readings.items()), sorted(self.vowels), VOWEL, CONSONANT, PAUSE
        return f"written 1; tables {hashlib.sha256(repr(told).encode()).hexdigest()[:16]}"

    def raw(self) -> WrittenVoice:
        """Itself: its symbols are the language's own."""
        return self

    def phrases(self, text: str) -> Phrases:
        """The phones of every word; phrases end at punctuation and at the end of a line."""
        return tuple(tuple(self._phones(word) for word in words) for words in self._words(text))

    def speak(self, text: str) -> Spoken:
        """Speak *text*, in silence."""
        phones, seconds = [Phone(SILENCE)], [PAUSE]
        words: list[str] = []
        for phrase in self._words(text):
            for word in phrase:
                said = self._phones(word)
                phones += [Phone(phone, word=len(words)) for phone in said]
                seconds += [VOWEL if phone in self.vowels else CONSONANT for phone in said]
                words.append(word)
            phones.append(Phone(SILENCE))
            seconds.append(PAUSE)
        edges = np.concatenate([[0.0], np.cumsum(seconds)])
        schedule = lay_out(edges, phones, language=self.language, notation=self.notation, words=tuple(words))
        sound = Sound(np.zeros(round(edges[-1] * RATE), np.int16), RATE)
        return Spoken(schedule, sound, (f"text: {self.language} has no voice; the face moves in silence", *clean(text).notes))

    def _words(self, text: str) -> list[list[str]]:
        lines = [clean(line).text for line in text.splitlines() if any(c.isalnum() for c in line)] or [clean(text).text]
        phrases = [[word for one in phrase.split() if (word := _EDGES.sub("", one))] for line in lines for phrase in _PHRASES.split(line)]
        found = [words for words in phrases if words]
        if not found:
            raise InputError("text: there is no word in it; write at least one")
        return found

    def _phones(self, word: str) -> tuple[str, ...]:
        """The phones of *word*; capitals count only where the language tells them apart. Raises `InputError`."""
        rest = self.readings.get(word.lower(), word)
        found: list[str] = []
        while rest := rest.lstrip(_SKIPPED):
            starts = [(size, form) for size in range(len(rest), 0, -1) for form in (rest[:size], rest[:size].lower())]
            size, form = next((one for one in starts if one[1] in self.table), (0, ""))
            if not size:
                raise InputError(
                    f"text: {rest[0]!r} in {word!r} is no phone of {self.language} and no spelling of one; "
                    f"give it a row in {self.language}/phones.tsv or aliases.tsv"
                )
            found += self.table[form]
            rest = rest[size:]
        return tuple(found)
