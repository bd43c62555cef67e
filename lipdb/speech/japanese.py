"""Japanese: text to timed phones with length, with sound from espeak-ng.

Open JTalk's dictionary (the package pyopenjtalk-plus, extra ``ja``) cuts text into words and says how each is read, in
kana; without it, kana are still read. The phones come from the kana. espeak is given phonemes, so what it plays is known
phone by phone; its own reading of kana is not used (it says hp for っぱ and rao for りょ).
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as package_version
from typing import TYPE_CHECKING

from lipdb.errors import InputError
from lipdb.phones.syllables import Syllables
from lipdb.speech import libespeak, sounds
from lipdb.speech.espeak import SETTINGS, language_row
from lipdb.speech.japanese_words import PACKAGE, JapaneseReader, Pause, Token, Word
from lipdb.speech.kana import LENGTH, NASAL, Mora, morae, sounds_of
from lipdb.speech.sounds import Breath
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Phrases, Spoken

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records

NOTATION = "romaji"
# Morae. A person breathes sooner or later, and espeak cuts a clause of 800 characters anywhere.
LONGEST_BREATH = 60


def kana_voice(records: Records, language: str) -> KanaVoice:
    """The voice of *language* as its tables say. Raises `PhonesetError` when ``language.tsv`` is missing."""
    row = language_row(records, language)
    syllables = Syllables.from_rows(records.get(f"{language}/syllables.tsv", {}).values())
    readings = {word: reading["reading"] for (word,), reading in records.get(f"{language}/readings.tsv", {}).items()}
    return KanaVoice(row["voice"], language, row["script"], syllables, JapaneseReader(readings))


@dataclass(frozen=True)
class KanaVoice:
    """A voice that reads Japanese; see `lipdb.speech.voice.Voice`. *syllables* are the kana and their phones."""

    name: str
    language: str
    script: str
    syllables: Syllables
    reader: JapaneseReader
    _parsed: dict[str, tuple[Mora, ...]] = field(default_factory=dict, repr=False, compare=False)

    @property
    def notation(self) -> str:
        """The notation of its symbols."""
        return NOTATION

    @property
    def version(self) -> str:
        """Library, packages, settings and the tables that decide readings."""
        tables = sorted(self.reader.readings.items()), sorted(self.syllables.phones.items())
        digest = hashlib.sha256(repr(tables).encode()).hexdigest()[:12]
        try:
            reader = f"{PACKAGE} {package_version(PACKAGE)}, sudachidict {package_version('sudachidict_core')}"
        except PackageNotFoundError:
            reader = "kana only"
        return f"espeak-ng {libespeak.espeak_version()}; {reader}; lipdb {package_version('lipdb')}; {SETTINGS}; tables {digest}"

    def raw(self) -> KanaVoice:
        """Itself: what it says are phones already, and its tables are few."""
        return self

    def speak(self, text: str) -> Spoken:
        """Speak *text*: phones with length; words are those of the dictionary, as they are written."""
        tokens, notes = self._tokens(text)
        words = [sounds.Word(token.written, token.joined) for token in tokens if isinstance(token, Word)]
        spoken = sounds.speak(list(self._breaths(tokens)), words, voice=self.name, language=self.language, notation=NOTATION)
        return replace(spoken, notes=notes)

    def phrases(self, text: str) -> Phrases:
        """The phones of every word, a phrase for every breath."""
        tokens, _ = self._tokens(text)
        return sounds.phrases(self._breaths(tokens))

    def _tokens(self, text: str) -> tuple[list[Token], tuple[str, ...]]:
        """Words that sound, and pauses."""
        cleaned, notes = clean(text)
        check_script(cleaned, self.script, language=self.language)
        tokens, unread = self.reader.read(cleaned)
        tokens = self._sounding(tokens)
        if unread:
            notes = (*notes, f"text: {' '.join(unread)} can't be read and is left out")
        if not any(isinstance(token, Word) for token in tokens):
            raise InputError(f"text: there are no words in {cleaned!r}; write Japanese")
        return tokens, notes

    def _sounding(self, tokens: Iterable[Token]) -> list[Token]:
        """*tokens*, with a word that has no sound of its own, such as っ or ー, as part of the word in front of it, else behind."""
        found: list[Token] = []
        for token in tokens:
            last = found[-1] if found else None
            if isinstance(token, Word) and isinstance(last, Word) and not (self._sounds(token) and self._sounds(last)):
                found[-1] = Word(last.written + token.written, last.kana + token.kana, last.joined)
            else:
                found.append(token)
        return [token for token in found if not isinstance(token, Word) or any(mora.core != LENGTH for mora in self._morae(token))]

    def _sounds(self, word: Word) -> bool:
        return any(mora.core == NASAL or mora.core.isascii() for mora in self._morae(word))

    def _morae(self, word: Word) -> tuple[Mora, ...]:
        """The morae of *word*, as if it were the first."""
        if word.kana not in self._parsed:
            self._parsed[word.kana] = tuple(morae(word.kana, self.syllables.phones, 0))
        return self._parsed[word.kana]

    def _breaths(self, tokens: Iterable[Token]) -> Iterator[Breath]:
        row, number = list[Mora](), 0
        for token in [*tokens, Pause(".")]:
            spoken = [mora._replace(word=number) for mora in self._morae(token)] if isinstance(token, Word) else []
            mark = token.mark if isinstance(token, Pause) else "," if len(row) + len(spoken) > LONGEST_BREATH else ""
            if mark and row:
                yield Breath(sounds_of(row), mark)
                row = []
            row += spoken
            number += isinstance(token, Word)
