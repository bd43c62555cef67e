"""Any language that espeak-ng speaks: text to timed phones and sound.

Times, labels and sound come from one synthesis. Phones without sound come from phonemizer, which asks the same library;
both give the same segments (stress can differ before a comma, where only the synthesis knows the melody).
"""

from __future__ import annotations

import hashlib
import re
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache
from importlib.metadata import version as package_version
from itertools import groupby, repeat
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipdb.errors import PhonesetError
from lipdb.schedule import SILENCE, Phone
from lipdb.sound import Sound
from lipdb.speech import libespeak, phonemes
from lipdb.speech.arabic import spelt_for_espeak
from lipdb.speech.closures import restore_closures, share_swallowed
from lipdb.speech.context import in_context
from lipdb.speech.libespeak import Mark, is_phone
from lipdb.speech.phonemes import BREAK, SHORTEST_PAUSE, SWITCH
from lipdb.speech.text import check_script, clean, is_ordinary
from lipdb.speech.voice import Phrase, Phrases, Reading, Spoken, lay_out

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records, Row

NOTATION = "espeak"
# Part of a voice's version: change it with anything that changes times, so that nobody is given what was kept before.
SETTINGS = "175 words a minute, lead-in 0.25 s, closures 1, breaks 1"
STRESS = {"ˈ": 1, "ˌ": 2}
LONGEST_BREAK = 0.1
"""Seconds of silence within a word that are no pause: Italian "stazi-one" and Portuguese "vi-agem" have up to 0.064."""
# Plosives and affricates, by the first sign of their label.
STOP = re.compile(r"[pbtdkɡgqcɟʈɖɢʔ]")
# In front of a small letter espeak takes a full stop for an abbreviation and makes no pause; people write so, too.
FULL_STOP = "。"
SENTENCE_END = re.compile(
    r"(?<=[^\W\d_]{3})(?<!\betc)(?<!\best)(?<!\binc)(?<!\bltd)(?<!\bdept)(?<!approx)"
    r"(?<!\bруб)(?<!\bкоп)(?<!\bтыс)(?<!\bмлн)(?<!\bмлрд)(?<!\bстр)(?<!\bтел)\.(?=[\"'”’»)]? [a-zß-ÿа-яё])"
)
ELIDED = re.compile(r"^\w{1,2}['’](?=\w)")
WRITTEN = re.compile(r"\S+")
SIGNS = "\"'“”‘’«»()[]{}<>.,;:!?¡¿。।॥،؛؟۔…–—-"
EDGE = re.compile(r"^[\s\"'“”‘’«»()\[\]{}<>.,;:!?¡¿…–—-]+|[\s\"“”«»()\[\]{}<>.,;:!?。।॥،؛؟۔…–—-]+$")


def espeak_voice(records: Records, language: str) -> EspeakVoice:
    """The voice of *language* as its ``language.tsv`` says. Raises `PhonesetError` when that is missing."""
    row = language_row(records, language)
    aliases = records.get(f"{language}/aliases.tsv", {})
    symbols = frozenset(symbol for notation, symbol in aliases if notation == NOTATION)
    readings = {word: reading["reading"] for (word,), reading in records.get(f"{language}/readings.tsv", {}).items()}
    return EspeakVoice(row["voice"], language, row["script"], symbols, readings)


def language_row(records: Records, language: str) -> Row:
    """The row of *language*. Raises `PhonesetError` when there is none."""
    try:
        return records[f"{language}/language.tsv"][(language,)]
    except KeyError:
        raise PhonesetError(f"{language}/language.tsv has no row {language!r}; add one with the voice that speaks it") from None


@dataclass(frozen=True, slots=True)
class EspeakVoice:
    """A voice of espeak-ng; see `lipdb.speech.voice.Voice`.

    *symbols* are the labels that the alias table knows; *readings* has words and how to spell them so that espeak says them.
    """

    name: str
    language: str
    script: str
    symbols: frozenset[str] = frozenset()
    readings: Mapping[str, str] = field(default_factory=dict, hash=False)

    @property
    def notation(self) -> str:
        """The notation of its symbols."""
        return NOTATION

    @property
    def version(self) -> str:
        """Library, package, settings, the labels that decide whether a length stays and the words that are respelt."""
        tables = sorted(self.symbols), sorted(self.readings.items())
        digest = hashlib.sha256(repr(tables).encode()).hexdigest()[:12]
        return f"espeak-ng {libespeak.espeak_version()}; lipdb {package_version('lipdb')}; {SETTINGS}; labels {digest}"

    def raw(self) -> EspeakVoice:
        """The voice with labels as espeak writes them, length and all; only those that depend on their place or stress stay."""
        placed = {symbol.split("/")[0] for symbol in self.symbols if "/" in symbol}
        return replace(self, symbols=frozenset(s for s in self.symbols if "/" in s or s[0] in STRESS or s.replace("ː", "") in placed))

    def speak(self, text: str) -> Spoken:
        """Speak *text*: IPA labels of espeak, words as they are written.

        A label has its mark of stress only where the alias table lists it so, because it sounds otherwise without.
        """
        written, spelt, notes = self._checked(text)
        utterance = libespeak.speak(spelt, self.name)
        marks = without_short_pauses(utterance.marks, utterance.sound.rate)
        words, word_of = words_of(spelt, marks, written)
        phones = self._phones([mark.label for mark in marks], word_of)
        schedule = lay_out(mended_edges(marks, utterance.sound), phones, language=self.language, notation=NOTATION, words=words)
        return Spoken(schedule, utterance.sound, notes)

    def phrases(self, text: str) -> Phrases:
        """The labels of every spoken word of every phrase, through phonemizer; words that are said as one are one."""
        return self.read(text).phrases

    def read(self, text: str) -> Reading:
        """As `phrases`, with the number of words that are read by the rules of another language."""
        phrases: list[Phrase] = []
        switches = 0
        [spelled] = self.spelled([self.checked(text)[0]])
        for phrase in spelled.split(BREAK):
            bare, found = SWITCH.subn("", phrase) if "(" in phrase else (phrase, 0)
            switches += found
            if words := [symbols for word in bare.split() if (symbols := self.symbols_of(word))]:
                phrases.append(tuple(words))
        return Reading(tuple(phrases), (switches + 1) // 2)

    def checked(self, text: str) -> tuple[str, bool]:
        """*text* as espeak is to be given it, and whether it `is_ordinary`. Raises `InputError` where the voice can't read it."""
        if is_ordinary(text, self.script):
            return self._respelt(_ended(text)), True
        return self._checked(text)[1], False

    def spelled(self, texts: Sequence[str]) -> list[str]:
        """Each of *texts*, that are checked, as espeak writes it; see `lipdb.speech.phonemes.spelled`."""
        return phonemes.spelled(texts, self.name)

    def symbols_of(self, word: str) -> tuple[str, ...]:
        """The symbols of a *word* of `spelled`."""
        return _placed([symbol for written in word.split("_") if (symbol := _symbol(written, self.symbols))], self.symbols)

    def _checked(self, text: str) -> tuple[str, str, tuple[str, ...]]:
        """*text* cleaned, the same as it is spelt for espeak, and notes of what was left out."""
        cleaned, notes = clean(text)
        check_script(cleaned, self.script, language=self.language)
        ended = _ended(cleaned)
        return ended, self._respelt(ended), notes

    def _respelt(self, text: str) -> str:
        """*text* with the words that espeak reads wrongly spelt so that it does not."""
        spelt = respelt(text, self.readings) if self.readings else text
        return spelt_for_espeak(spelt) if self.name == "ar" else spelt

    def _phones(self, labels: Sequence[str], word_of: Sequence[int]) -> list[Phone]:
        """The phones of *labels* (empty: a pause), of which each belongs to a word."""
        phones = list[Phone]()
        for word, places in groupby(range(len(labels)), word_of.__getitem__):
            said = [labels[place] for place in places]
            symbols = _placed([_known(label, self.symbols) for label in said], self.symbols)
            phones += [_phone(label, symbol, word) if label else Phone(SILENCE) for label, symbol in zip(said, symbols, strict=True)]
        return phones


def _ended(text: str) -> str:
    """*text* with full stops that espeak takes for such."""
    # Most lines have a full stop only at their end: looking for it is quicker than the expression.
    return SENTENCE_END.sub(FULL_STOP, text) if "." in text[:-1] else text


def _phone(label: str, symbol: str, word: int) -> Phone:
    stress = next((level for mark, level in STRESS.items() if mark in label), 0)
    bare = unstressed(label)
    return Phone(symbol, word=word, stress=stress, long="ː" in label or undoubled(bare) != bare)


def respelt(text: str, readings: Mapping[str, str]) -> str:
    """*text* with every word that *readings* has, in small letters, spelt as they say, the signs around it kept.

    A word may be elided into: "l'enthousiasme" is "enthousiasme".
    """
    tokens = text.split(" ")
    for place, token in enumerate(tokens):
        word = token.strip(SIGNS)
        if ("'" in word or "’" in word) and word.lower() not in readings:
            word = ELIDED.sub("", word)
        if (reading := readings.get(word.lower())) is not None:
            tokens[place] = token.replace(word, reading, 1)
    return " ".join(tokens)


def unstressed(label: str) -> str:
    """*label* without its marks of stress."""
    return label.replace("ˈ", "").replace("ˌ", "")


def _known(label: str, symbols: frozenset[str]) -> str:
    """*label* as the alias table writes it: as it is, without stress, without length, or not doubled."""
    bare = unstressed(label)
    return next((form for form in (label, bare, bare.replace("ː", ""), undoubled(bare)) if form in symbols), bare)


@lru_cache(maxsize=1 << 12)
def _symbol(written: str, symbols: frozenset[str]) -> str:
    """The symbol of one label of a word, empty for what is no phone. They come again and again, so each is looked at once."""
    return _known(written, symbols) if is_phone(written) else ""


def _placed(word: list[str], symbols: frozenset[str]) -> tuple[str, ...]:
    """The labels of a *word*, those that have a form for their place (`lipdb.speech.context`) in that form."""
    if not _has_places(symbols):
        return tuple(word)
    return tuple(map(in_context, word, ["", *word], [*word[1:], ""], repeat(symbols)))


@lru_cache(maxsize=1 << 6)
def _has_places(symbols: frozenset[str]) -> bool:
    return any("/" in symbol for symbol in symbols)


def undoubled(symbol: str) -> str:
    """``ə`` for ``əə``: espeak writes some lengthened vowels twice."""
    half = len(symbol) // 2
    return symbol[:half] if symbol[:half] == symbol[half:] else symbol


def words_of(text: str, marks: tuple[Mark, ...], written: str = "") -> tuple[tuple[str, ...], list[int]]:
    """The written words of *text*, and for every mark the index of its word, -1 for pauses.

    The words are those of *written*, if that has as many: the same text as a person spelt it.

    A written word is what stands between spaces, without punctuation at its edges; espeak's word events point into it,
    several of them into a number. Written words that are said as one ("of the") are one word.
    """
    tokens = [m.span() for m in WRITTEN.finditer(text)]
    starts = [start for start, _ in tokens]
    # Within numbers the positions jump back and forth, so none may be before the last.
    positions = np.maximum.accumulate([bisect_right(starts, max(m.position, 0)) - 1 for m in marks])
    sounding = sorted({int(t) for t, m in zip(positions, marks, strict=True) if m.label})
    shown = [m.span() for m in WRITTEN.finditer(written)]
    text, shown = (written, shown) if len(shown) == len(tokens) else (text, tokens)
    words = []
    for token, following in zip(sounding, [*sounding[1:], len(tokens)], strict=True):
        word = text[shown[token][0] : shown[following - 1][1]]
        words.append(EDGE.sub("", word) or word)
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
    joined = _joined_pauses(marks)
    for mark, following in zip(joined, [*joined[1:], joined[-1]], strict=True):
        in_a_word = bool(kept) and kept[-1].position == following.position
        short = not mark.label and mark.end - mark.start < (LONGEST_BREAK if in_a_word else SHORTEST_PAUSE) * rate
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
