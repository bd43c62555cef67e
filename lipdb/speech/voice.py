"""What every voice offers, and what it gives back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from lipdb.schedule import MICROSECONDS, Phone, Schedule
from lipdb.sound import Sound
from lipdb.speech.closures import ensure_shortest


@dataclass(frozen=True, slots=True)
class Spoken:
    """A text as a voice spoke it.

    The schedule's symbols are as the voice writes them, no common phones yet. *notes* say in a line each what of the
    text was left out or read in a way that a person might not expect.
    """

    schedule: Schedule
    sound: Sound
    notes: tuple[str, ...] = ()


Phrase = tuple[tuple[str, ...], ...]
"""The symbols of every word that is said in one breath."""
Phrases = tuple[Phrase, ...]
"""What is said between one pause and the next."""


class Reading(NamedTuple):
    """A text as a voice would say it: its phrases, and how many of its words are *foreign*, read as another language's."""

    phrases: Phrases
    foreign: int = 0


class Voice(Protocol):
    """Makes timed phones and sound from text; the same text gives the same bytes.

    `speak` and `phrases` raise `InputError` for text that the voice can't read.
    """

    @property
    def name(self) -> str:
        """What the speech engine calls this voice, for example ``en-us``."""

    @property
    def language(self) -> str:
        """The code of the language it speaks."""

    @property
    def notation(self) -> str:
        """The notation of its symbols."""

    @property
    def script(self) -> str:
        """The script that it reads (ISO 15924)."""

    @property
    def version(self) -> str:
        """Everything but the text that decides the result: programs with their versions, settings."""

    def raw(self) -> Voice:
        """The same voice with symbols that depend as little as can be on tables that people edit: for counts that are kept."""

    def speak(self, text: str) -> Spoken:
        """Speak *text*."""

    def phrases(self, text: str) -> Phrases:
        """The symbols of every word of every phrase of *text*, without sound and times.

        A phrase ends where `speak` pauses, so its first and last symbols are those that stand next to silence.
        """


def lay_out(edges: NDArray[np.float64], phones: Sequence[Phone], *, language: str, notation: str, words: tuple[str, ...]) -> Schedule:
    """The schedule of *phones* between *edges* (n + 1 seconds): pauses joined, no phone shorter than `ensure_shortest` says."""
    keep = [i for i, phone in enumerate(phones) if not (phone.silent and i and phones[i - 1].silent)]
    times = ensure_shortest(np.append(edges[keep], edges[-1]))
    return Schedule(tuple(int(t) for t in np.rint(times * MICROSECONDS)), tuple(phones[i] for i in keep), language, notation, words)
