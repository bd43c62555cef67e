"""Mandarin: Chinese characters or pinyin to timed initials and finals, with sound from espeak-ng.

espeak is given pinyin, one word a syllable, so what it plays is known syllable by syllable. Its first consonant is the
initial and the rest the final; which phones those are is the syllable table's word, not espeak's.
"""

from __future__ import annotations

import hashlib
import re
from bisect import bisect_right
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import version as package_version
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import InputError
from lipdb.phones.mapping import bracketed
from lipdb.phones.syllables import Syllables
from lipdb.schedule import SILENCE, Phone
from lipdb.speech import libespeak, phonemes
from lipdb.speech.espeak import FULL_STOP, SETTINGS, language_row, mended_edges, undoubled, without_short_pauses
from lipdb.speech.libespeak import Mark
from lipdb.speech.pinyin import NEUTRAL, Foreign, Pause, PinyinReader, Syllable, Token, has_characters
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Phrases, Reading, Spoken, lay_out

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records

NOTATION = "pinyin"
# Chao digits of the tones, as espeak's phonemes for Mandarin carry them.
CHAO = {1: "55", 2: "35", 3: "214", 4: "51", 5: "11"}
# espeak-ng 1.52 has no rule for these syllables and reads them as English; its phonemes say them.
PHONEMES = {
    "hm": "hm{}", "hng": "hN{}", "jiong": "tS;j'ong{}", "lüan": "l'y&{}n", "lün": "l'y@{}n", "m": "m{}", "n": "n{}", "ng": "N{}",
    "qiong": "tS;hj'ong{}", "xiong": "S;j'ong{}", "ê": "'E{}",
}  # fmt: skip
RHOTIC = "[[r]]"
# Syllables. espeak cuts a clause of 800 characters anywhere, even within a syllable.
LONGEST_BREATH = 60
# As a word by itself this letter would be read as an article.
LETTERS = {"A": "eh", "a": "eh"}
INITIAL_SHARE = 0.35


def pinyin_voice(records: Records, language: str) -> PinyinVoice:
    """The voice of *language* as its tables say. Raises `PhonesetError` when ``language.tsv`` is missing."""
    row = language_row(records, language)
    phones = frozenset(phone for (phone,) in records.get(f"{language}/phones.tsv", {}))
    syllables = Syllables.from_rows(records.get(f"{language}/syllables.tsv", {}).values())
    readings = {word: reading["reading"] for (word,), reading in records.get(f"{language}/readings.tsv", {}).items()}
    segments = frozenset(segment for (segment,) in records.get("ipa.tsv", {}))
    return PinyinVoice(row["voice"], language, row["script"], PinyinReader(syllables, phones, readings), segments)


@dataclass(frozen=True)
class PinyinVoice:
    """A voice that reads Chinese; see `lipdb.speech.voice.Voice`. *segments* are the IPA segments of the common layer."""

    name: str
    language: str
    script: str
    reader: PinyinReader
    segments: frozenset[str]

    @property
    def notation(self) -> str:
        """The notation of its symbols."""
        return NOTATION

    @property
    def version(self) -> str:
        """Library, packages, settings and the tables that decide readings."""
        tables = sorted(self.reader.readings.items()), sorted(self.reader.syllables.phones.items()), sorted(self.segments)
        digest = hashlib.sha256(repr(tables).encode()).hexdigest()[:12]
        programs = f"espeak-ng {libespeak.espeak_version()}; pypinyin {package_version('pypinyin')}; lipdb {package_version('lipdb')}"
        return f"{programs}; {SETTINGS}; tables {digest}"

    def raw(self) -> PinyinVoice:
        """The voice itself: initials and finals come from the syllable table, whatever they map to."""
        return self

    def speak(self, text: str) -> Spoken:
        """Speak *text*: initials and finals with tones; words are the characters as written.

        A word in Latin letters is read as English; its phones are IPA segments in brackets, for the common layer.
        """
        tokens, notes = self._tokens(text)
        script, starts = respell(tokens, self.reader.syllables.phones)
        utterance = libespeak.speak(script, self.name, phonemes=True)
        marks = without_short_pauses(utterance.marks, utterance.sound.rate)
        edges = mended_edges(marks, utterance.sound)
        spoken = [token for token in tokens if not isinstance(token, Pause)]
        words = tuple(token.written for token in spoken)
        times, phones = zip(*self._timed(spoken, marks, starts, edges), strict=True)
        _check_all_spoken(words, phones)
        schedule = lay_out(np.array([*times, edges[-1]]), phones, language=self.language, notation=NOTATION, words=words)
        return Spoken(schedule, utterance.sound, notes)

    def _timed(
        self, spoken: Sequence[Syllable | Foreign], marks: Sequence[Mark], starts: Sequence[int], edges: NDArray[np.float64]
    ) -> Iterator[tuple[float, Phone]]:
        """Start and phone of every pause, initial, final and foreign segment, in order."""
        for word, first, last in runs(marks, starts):
            inner = [i for i in range(first, last) if marks[i].label]
            if word < 0:
                yield edges[first], Phone(SILENCE)
            elif isinstance(token := spoken[word], Syllable):
                yield from _syllable(token, word, edges[inner], edges[last])
            else:
                for i in inner:
                    yield from self._foreign(marks[i].label, word, edges[i], edges[i + 1])

    def phrases(self, text: str) -> Phrases:
        """Initial and final of every syllable, and the segments of foreign words."""
        return self.read(text).phrases

    def read(self, text: str) -> Reading:
        """As `phrases`, with the number of words that are read as English."""
        tokens, _ = self._tokens(text)
        foreign = sum(isinstance(token, Foreign) for token in tokens)
        return Reading(tuple(tuple(map(self._symbols, breath)) for breath in breaths(tokens)), foreign)

    def _symbols(self, token: Syllable | Foreign) -> tuple[str, ...]:
        return token.phones if isinstance(token, Syllable) else self._foreign_segments(token.written)

    def _tokens(self, text: str) -> tuple[list[Token], tuple[str, ...]]:
        cleaned, notes = clean(text)
        check_script(cleaned, self.script, language=self.language)
        tokens, unread = self.reader.read(cleaned)
        syllables = [token for token in tokens if isinstance(token, Syllable)]
        foreign = [token.written for token in tokens if isinstance(token, Foreign)]
        if foreign:
            notes = (*notes, f"text: {', '.join(dict.fromkeys(foreign))} read as English")
        if unread:
            notes = (*notes, f"text: {' '.join(unread)} can't be read and is left out")
        if syllables and not has_characters(cleaned) and all(s.tone == NEUTRAL for s in syllables):
            notes = (*notes, "text: pinyin without tones is read in the neutral tone; write them as ni3 hao3 or nǐ hǎo")
        if not syllables and not foreign:
            raise InputError(f"text: there are no words in {cleaned!r}; write Chinese characters or pinyin")
        return tokens, notes

    def _foreign_segments(self, word: str) -> tuple[str, ...]:
        labels = [label for spoken in phonemes.words(word, self.name) for label in spoken]
        return tuple(bracketed(segment) for label in labels for segment in split_ipa(label, self.segments))

    def _foreign(self, label: str, word: int, start: float, end: float) -> list[tuple[float, Phone]]:
        segments = split_ipa(label, self.segments)
        share = (end - start) / max(1, len(segments))
        return [(start + k * share, Phone(bracketed(segment), word=word)) for k, segment in enumerate(segments)]


def breaths(tokens: Iterable[Token]) -> Iterator[list[Syllable | Foreign]]:
    """What is said between one pause and the next: at every mark of punctuation, and after `LONGEST_BREATH`."""
    breath: list[Syllable | Foreign] = []
    for token in tokens:
        if isinstance(token, Pause) or len(breath) == LONGEST_BREATH:
            if breath:
                yield breath
            breath = []
        if not isinstance(token, Pause):
            breath.append(token)
    if breath:
        yield breath


def respell(tokens: Iterable[Token], legal: Container[str]) -> tuple[str, list[int]]:
    """What espeak is given for *tokens*, and the character at which each spoken one starts."""
    text, starts, breath = "", list[int](), 0
    for token in tokens:
        if isinstance(token, Pause):
            text = f"{text.rstrip()}{FULL_STOP if token.mark == '.' else token.mark} " if starts else text
            breath = 0
            continue
        breath += 1
        if breath > LONGEST_BREATH:
            text, breath = f"{text.rstrip()}, ", 1
        starts.append(len(text))
        text += f"{_respell_syllable(token, legal) if isinstance(token, Syllable) else LETTERS.get(token.written, token.written)} "
    return text.rstrip(), starts


def _respell_syllable(syllable: Syllable, legal: Container[str]) -> str:
    plain, rhotic = syllable.plain, ""
    if plain not in legal:
        # Erhua: the r takes the place of a final n or i (duanmu2007), where what is left can be said.
        plain, rhotic = plain.removesuffix("r"), RHOTIC
        plain = plain[:-1] if plain[-1] in "ni" and plain[:-1] in legal else plain
    if plain in PHONEMES:
        return f"[[{PHONEMES[plain].format(CHAO[syllable.tone])}]]{rhotic}"
    return f"{plain.replace('ü', 'v')}{syllable.tone}{rhotic}"


def runs(marks: Sequence[Mark], starts: Sequence[int]) -> Iterator[tuple[int, int, int]]:
    """``(word, first, last + 1)`` of the marks of each word; -1 for a pause, unless it is within a word."""
    words = [bisect_right(starts, mark.position) - 1 if mark.label else -1 for mark in marks]
    for i in range(1, len(words) - 1):
        if words[i] < 0 and words[i - 1] == words[i + 1]:
            words[i] = words[i - 1]
    first = 0
    for word, group in groupby(words):
        last = first + len(list(group))
        yield word, first, last
        first = last


def _syllable(syllable: Syllable, word: int, starts: NDArray[np.float64], end: float) -> list[tuple[float, Phone]]:
    """Start and phone of the initial, if there is one, and of the final, which has the tone."""
    final = Phone(syllable.phones[-1], word=word, tone=syllable.tone)
    if len(syllable.phones) == 1:
        return [(starts[0], final)]
    border = starts[1] if len(starts) > 1 else starts[0] + INITIAL_SHARE * (end - starts[0])
    return [(starts[0], Phone(syllable.phones[0], word=word)), (border, final)]


def split_ipa(label: str, segments: Container[str]) -> list[str]:
    """The IPA segments of espeak's *label*, the longest that *segments* knows first; a letter that it lacks stays alone.

    espeak's labels of a foreign word carry its Chao digits, of which it writes 3 as ɜ, and a vowel can be written twice.
    """
    rest = undoubled(re.sub("[0-9ˈˌ]|(?<=.)ɜ$", "", label))
    found = []
    while rest:
        length = next((n for n in range(len(rest), 0, -1) if rest[:n] in segments or rest[:n].replace("ː", "") in segments), 1)
        piece = rest[:length]
        found.append(piece if piece in segments else piece.replace("ː", "") or piece)
        rest = rest[length:].lstrip("ː")
    return found


def _check_all_spoken(words: Sequence[str], phones: Iterable[Phone]) -> None:
    silent = set(range(len(words))) - {phone.word for phone in phones}
    if silent:
        raise InputError(f"text: the voice can't say {words[min(silent)]!r}; write it in Chinese characters or pinyin")
