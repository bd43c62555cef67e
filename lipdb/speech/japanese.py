"""Japanese: text to timed phones with length, with sound from espeak-ng.

Open JTalk's dictionary (the package pyopenjtalk-plus, extra ``ja``) cuts text into words and says how each is read, in
kana; without it, kana are still read. The phones come from the kana. espeak is given phonemes, so what it plays is known
phone by phone; its own reading of kana is not used (it says hp for っぱ and rao for りょ).
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError
from importlib.metadata import version as package_version
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError
from lipdb.phones.syllables import Syllables
from lipdb.schedule import SILENCE, Phone
from lipdb.speech import libespeak
from lipdb.speech.espeak import FULL_STOP, SETTINGS, language_row, mended_edges, without_short_pauses
from lipdb.speech.japanese_words import PACKAGE, JapaneseReader, Pause, Token, Word
from lipdb.speech.kana import Mora, Sound, morae, sounds
from lipdb.speech.libespeak import Mark
from lipdb.speech.mandarin import runs
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Phrases, Spoken, lay_out

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
        words = [token for token in tokens if isinstance(token, Word)]
        script, chunks = respell(self._breaths(tokens), words)
        utterance = libespeak.speak(script, self.name, phonemes=True)
        marks = without_short_pauses(utterance.marks, utterance.sound.rate)
        edges = mended_edges(marks, utterance.sound)
        times, phones = zip(*_timed(chunks, marks, edges), strict=True)
        written = tuple(word.written for word in words)
        schedule = lay_out(np.array([*times, edges[-1]]), phones, language=self.language, notation=NOTATION, words=written)
        return Spoken(schedule, utterance.sound, notes)

    def phrases(self, text: str) -> Phrases:
        """The phones of every word, a phrase for every breath."""
        tokens, _ = self._tokens(text)
        return tuple(
            tuple(tuple(sound.phone for sound in word) for _, word in groupby(breath, key=lambda sound: sound.word))
            for breath, _ in self._breaths(tokens)
        )

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
        """*tokens*, with a word that has no vowel of its own, such as っ or ー, as part of the word in front of it."""
        found: list[Token] = []
        for token in tokens:
            if isinstance(token, Word) and not any(mora.core.isascii() for mora in morae(token.kana, self.syllables.phones, 0)):
                if found and isinstance(last := found[-1], Word):
                    found[-1] = last._replace(written=last.written + token.written, kana=last.kana + token.kana)
                elif any(morae(token.kana, self.syllables.phones, 0)) and token.kana.strip("ー"):
                    found.append(token)
            else:
                found.append(token)
        return found

    def _breaths(self, tokens: Iterable[Token]) -> Iterator[tuple[list[Sound], str]]:
        """The sounds between one pause and the next, and the mark that ends them."""
        row, number = list[Mora](), 0
        for token in [*tokens, Pause(".")]:
            spoken = list(morae(token.kana, self.syllables.phones, number)) if isinstance(token, Word) else []
            mark = token.mark if isinstance(token, Pause) else "," if len(row) + len(spoken) > LONGEST_BREATH else ""
            if mark and row:
                yield sounds(row), mark
                row = []
            row += spoken
            number += isinstance(token, Word)


Chunk = tuple[int, list[Sound]]
"""Where in espeak's text the sounds of some words that are said as one begin, and these sounds."""


def respell(breaths: Iterable[tuple[list[Sound], str]], words: Sequence[Word]) -> tuple[str, list[Chunk]]:
    """What espeak is given, and its chunks: an accent phrase each, as `Word.joined` says."""
    text, chunks = "", list[Chunk]()
    for breath, mark in breaths:
        parts: list[list[Sound]] = []
        for number, word in groupby(breath, key=lambda sound: sound.word):
            if not parts or not words[number].joined:
                parts.append([])
            parts[-1] += word
        for part in parts:
            chunks.append((len(text), part))
            text += f"[[{''.join(sign for sound in part for sign in sound.phonemes)}]] "
        text = f"{text.rstrip()}{FULL_STOP if mark == '.' else mark} "
    return text.rstrip(), chunks


def _timed(chunks: Sequence[Chunk], marks: Sequence[Mark], edges: NDArray[np.float64]) -> Iterator[tuple[float, Phone]]:
    """Start and phone of every pause and sound, in order."""
    for number, first, last in runs(marks, [start for start, _ in chunks]):
        if number < 0:
            yield edges[first], Phone(SILENCE)
            continue
        part = chunks[number][1]
        sizes = np.cumsum([0, *(len(sound.phonemes) for sound in part)])
        played = edges[[i for i in range(first, last) if marks[i].label]]
        if len(played) == sizes[-1]:
            starts = played[sizes[:-1]]
        else:  # espeak plays two vowels as one here and there
            starts = np.interp(sizes[:-1] / sizes[-1], np.linspace(0, 1, len(played) + 1), [*played, edges[last]])
        for start, sound in zip(starts, part, strict=True):
            yield start, Phone(sound.phone, word=sound.word, long=sound.long)
