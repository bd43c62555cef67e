"""Speak a text whose phones are known: espeak-ng is given phonemes, and what it plays is told apart by their number.

For languages that have a reader of their own. Each phone is written as one or more of espeak's phonemes, of which each is
one label of what it plays, so the times of the phones follow without asking what the labels are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lipdb.schedule import SILENCE, Phone
from lipdb.speech import libespeak
from lipdb.speech.espeak import FULL_STOP, mended_edges, without_short_pauses
from lipdb.speech.libespeak import Mark
from lipdb.speech.mandarin import runs
from lipdb.speech.voice import Phrases, Spoken, lay_out


class Sound(NamedTuple):
    """A phone of the word with index *word*, and the phonemes that espeak is given for it, each one label of what it plays."""

    phone: str
    word: int
    phonemes: tuple[str, ...]
    long: bool = False


class Breath(NamedTuple):
    """What is said between one pause and the next, and the mark of punctuation that ends it, one of ``, . ! ?``."""

    sounds: list[Sound]
    mark: str


class Word(NamedTuple):
    """A word as it is *written*; whether it is *joined* to the word in front, as by one accent; and *plain* text that espeak
    is given instead of phonemes, for a word that it reads by itself.
    """

    written: str
    joined: bool = False
    plain: str = ""


def speak(breaths: Sequence[Breath], words: Sequence[Word], *, voice: str, language: str, notation: str) -> Spoken:
    """Speak *breaths*, whose sounds belong to *words*, with espeak's *voice*; the schedule is in *notation*."""
    text, chunks = _respell(breaths, words)
    utterance = libespeak.speak(text, voice, phonemes=True)
    marks = without_short_pauses(utterance.marks, utterance.sound.rate)
    edges = mended_edges(marks, utterance.sound)
    times, phones = zip(*_timed(chunks, marks, edges), strict=True)
    written = tuple(word.written for word in words)
    schedule = lay_out(np.array([*times, edges[-1]]), phones, language=language, notation=notation, words=written)
    return Spoken(schedule, utterance.sound)


def phrases(breaths: Iterable[Breath]) -> Phrases:
    """The phones of every word of every breath."""
    return tuple(
        tuple(tuple(sound.phone for sound in word) for _, word in groupby(breath.sounds, key=lambda sound: sound.word))
        for breath in breaths
    )


_Chunk = tuple[int, list[Sound]]
"""Where in espeak's text the sounds of words that are said as one begin, and these sounds."""


def _respell(breaths: Iterable[Breath], words: Sequence[Word]) -> tuple[str, list[_Chunk]]:
    text, chunks = "", list[_Chunk]()
    for sounds, mark in breaths:
        parts: list[list[Sound]] = []
        for number, word in groupby(sounds, key=lambda sound: sound.word):
            if not parts or not words[number].joined:
                parts.append([])
            parts[-1] += word
        for part in parts:
            chunks.append((len(text), part))
            plain = words[part[0].word].plain
            text += f"{plain or '[[' + '|'.join(sign for sound in part for sign in sound.phonemes) + ']]'} "
        text = f"{text.rstrip()}{FULL_STOP if mark == '.' else mark} "
    return text.rstrip(), chunks


def _timed(chunks: Sequence[_Chunk], marks: Sequence[Mark], edges: NDArray[np.float64]) -> Iterator[tuple[float, Phone]]:
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
        else:  # espeak plays two phonemes as one here and there
            starts = np.interp(sizes[:-1] / sizes[-1], np.linspace(0, 1, len(played) + 1), [*played, edges[last]])
        for start, sound in zip(starts, part, strict=True):
            yield start, Phone(sound.phone, word=sound.word, long=sound.long)
