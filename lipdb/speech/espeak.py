"""Any language that espeak-ng speaks: text to timed phones and sound.

Times, labels and sound come from one synthesis. Phones without sound come from phonemizer, which asks the same library;
both give the same segments (stress can differ before a comma, where only the synthesis knows the melody).
"""

from __future__ import annotations

import hashlib
import os
import re
import threading
from bisect import bisect_right
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version as package_version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import PhonesetError
from lipdb.schedule import SILENCE, Phone
from lipdb.sound import Sound
from lipdb.speech import libespeak
from lipdb.speech.closures import restore_closures, share_swallowed
from lipdb.speech.libespeak import Mark, find_espeak
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Spoken, lay_out

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records, Row

NOTATION = "espeak"
# Part of a voice's version: change it with anything that changes times, so that nobody is given what was kept before.
SETTINGS = "175 words a minute, lead-in 0.25 s, closures 1"
SHORTEST_PAUSE = 0.06
STRESS = {"ˈ": 1, "ˌ": 2}
# Plosives and affricates, by the first sign of their label.
STOP = re.compile(r"[pbtdkɡgqcɟʈɖɢʔ]")
_PHONEMIZING = threading.Lock()
SWITCH = re.compile(r"\([a-z-]+\)")
# In front of a small letter espeak takes a full stop for an abbreviation and makes no pause; people write so, too.
FULL_STOP = "。"
SENTENCE_END = re.compile(
    r"(?<=[^\W\d_]{3})(?<!\betc)(?<!\best)(?<!\binc)(?<!\bltd)(?<!\bdept)(?<!approx)"
    r"(?<!\bруб)(?<!\bкоп)(?<!\bтыс)(?<!\bмлн)(?<!\bмлрд)(?<!\bстр)(?<!\bтел)\.(?=[\"'”’»)]? [a-zß-ÿа-яё])"
)
EDGE = re.compile(r"^[\s\"'“”‘’«»()\[\]{}<>.,;:!?¡¿…–—-]+|[\s\"“”«»()\[\]{}<>.,;:!?。।॥،؛؟۔…–—-]+$")


def espeak_voice(records: Records, language: str) -> EspeakVoice:
    """The voice of *language* as its ``language.tsv`` says. Raises `PhonesetError` when that is missing."""
    row = language_row(records, language)
    aliases = records.get(f"{language}/aliases.tsv", {})
    symbols = frozenset(symbol for notation, symbol in aliases if notation == NOTATION)
    return EspeakVoice(row["voice"], language, row["script"], symbols)


def language_row(records: Records, language: str) -> Row:
    """The row of *language*. Raises `PhonesetError` when there is none."""
    try:
        return records[f"{language}/language.tsv"][(language,)]
    except KeyError:
        raise PhonesetError(f"{language}/language.tsv has no row {language!r}; add one with the voice that speaks it") from None


@dataclass(frozen=True, slots=True)
class EspeakVoice:
    """A voice of espeak-ng; see `lipdb.speech.voice.Voice`. *symbols* are the labels that the alias table knows."""

    name: str
    language: str
    script: str
    symbols: frozenset[str] = frozenset()

    @property
    def version(self) -> str:
        """Library, package, settings and the labels that decide whether a length stays."""
        digest = hashlib.sha256(repr(sorted(self.symbols)).encode()).hexdigest()[:12]
        return f"espeak-ng {libespeak.espeak_version()}; lipdb {package_version('lipdb')}; {SETTINGS}; labels {digest}"

    def speak(self, text: str) -> Spoken:
        """Speak *text*: IPA labels of espeak without stress marks, words as they are written."""
        text, notes = self._checked(text)
        utterance = libespeak.speak(text, self.name)
        marks = without_short_pauses(utterance.marks, utterance.sound.rate)
        words, word_of = words_of(text, marks)
        phones = [Phone(SILENCE) if not m.label else self._phone(m.label, w) for m, w in zip(marks, word_of, strict=True)]
        schedule = lay_out(mended_edges(marks, utterance.sound), phones, language=self.language, notation=NOTATION, words=words)
        return Spoken(schedule, utterance.sound, notes)

    def phones(self, text: str) -> tuple[tuple[str, ...], ...]:
        """The labels of every spoken word, through phonemizer; words that are said as one are one."""
        text, _ = self._checked(text)
        words = phonemize(text, self.name)
        return tuple(tuple(self._phone(label, 0).symbol for label in word) for word in words)

    def _checked(self, text: str) -> tuple[str, tuple[str, ...]]:
        cleaned, notes = clean(text)
        check_script(cleaned, self.script, language=self.language)
        return SENTENCE_END.sub(FULL_STOP, cleaned), notes

    def _phone(self, label: str, word: int) -> Phone:
        stress = next((level for mark, level in STRESS.items() if mark in label), 0)
        symbol = label.translate({ord(mark): None for mark in STRESS})
        forms = (symbol, symbol.replace("ː", ""), undoubled(symbol))
        known = next((form for form in forms if form in self.symbols), symbol)
        return Phone(known, word=word, stress=stress, long="ː" in label or undoubled(symbol) != symbol)


def undoubled(symbol: str) -> str:
    """``ə`` for ``əə``: espeak writes some lengthened vowels twice."""
    half = len(symbol) // 2
    return symbol[:half] if symbol[:half] == symbol[half:] else symbol


def phonemize(text: str, voice: str) -> list[list[str]]:
    """The IPA labels, with stress, of every word of *text*, by phonemizer.

    Its wrapper is used bare: the backend on top of it takes the punctuation out, which changes how numbers and the ends
    of clauses are read.
    """
    with _PHONEMIZING:
        spoken = SWITCH.sub("", _phonemizer(voice).text_to_phonemes(text))
    words = [[label for label in word.split("_") if label.strip("ˈˌ")] for word in spoken.split()]
    return [word for word in words if word]


@cache
def _phonemizer(voice: str) -> Any:
    """One wrapper a voice: each keeps a library of its own, and never gives its memory back. Raises `PhonesetError`."""
    library, data = find_espeak()
    os.environ.setdefault("PHONEMIZER_ESPEAK_LIBRARY", str(library))
    if data:
        os.environ.setdefault("PHONEMIZER_ESPEAK_DATA_PATH", str(data))
    from phonemizer.backend.espeak.wrapper import EspeakWrapper

    wrapper = EspeakWrapper()
    try:
        wrapper.set_voice(voice)
    except RuntimeError as error:
        raise libespeak.no_such_voice(voice) from error
    return wrapper


def words_of(text: str, marks: tuple[Mark, ...]) -> tuple[tuple[str, ...], list[int]]:
    """The written words of *text*, and for every mark the index of its word, -1 for pauses.

    A written word is what stands between spaces, without punctuation at its edges; espeak's word events point into it,
    several of them into a number. Written words that are said as one ("of the") are one word.
    """
    tokens = [m.span() for m in re.finditer(r"\S+", text)]
    starts = [start for start, _ in tokens]
    # Within numbers the positions jump back and forth, so none may be before the last.
    positions = np.maximum.accumulate([bisect_right(starts, max(m.position, 0)) - 1 for m in marks])
    sounding = sorted({int(t) for t, m in zip(positions, marks, strict=True) if m.label})
    words = []
    for token, following in zip(sounding, [*sounding[1:], len(tokens)], strict=True):
        written = text[tokens[token][0] : tokens[following - 1][1]]
        words.append(EDGE.sub("", written) or written)
    index = {token: i for i, token in enumerate(sounding)}
    return tuple(words), [index[int(t)] if m.label else -1 for t, m in zip(positions, marks, strict=True)]


def mended_edges(marks: tuple[Mark, ...], sound: Sound) -> NDArray[np.float64]:
    """Edges of *marks* in seconds, with swallowed phones given time and closures given back to their stops."""
    edges = np.array([*(m.start for m in marks), marks[-1].end]) / sound.rate
    stops = np.array([bool(STOP.match(m.label.lstrip("ˈˌ'"))) for m in marks])
    pauses = np.array([not m.label for m in marks])
    return restore_closures(share_swallowed(edges), stops, pauses, sound.samples, sound.rate)


def without_short_pauses(marks: tuple[Mark, ...], rate: int) -> tuple[Mark, ...]:
    """*marks* without language switches and without pauses too short for a mouth to close; the mark in front lasts on."""
    kept: list[Mark] = []
    for mark in _joined_pauses(marks):
        short = not mark.label and mark.end - mark.start < SHORTEST_PAUSE * rate
        if kept and (short or SWITCH.fullmatch(mark.label)):
            kept[-1] = kept[-1]._replace(end=mark.end)
        else:
            kept.append(mark)
    return tuple(kept)


def _joined_pauses(marks: tuple[Mark, ...]) -> list[Mark]:
    joined: list[Mark] = []
    for mark in marks:
        if joined and not mark.label and not joined[-1].label:
            joined[-1] = joined[-1]._replace(end=mark.end)
        else:
            joined.append(mark)
    return joined
