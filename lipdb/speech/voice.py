"""What every voice offers, and what it gives back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

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


class Voice(Protocol):
    """Makes timed phones and sound from text; the same text gives the same bytes.

    Both methods raise `InputError` for text that the voice can't read.
    """

    @property
    def name(self) -> str:
        """What the speech engine calls this voice, for example ``en-us``."""

    @property
    def language(self) -> str:
        """The code of the language it speaks."""

    @property
    def version(self) -> str:
        """Everything but the text that decides the result: programs with their versions, settings."""

    def speak(self, text: str) -> Spoken:
        """Speak *text*."""

    def phones(self, text: str) -> tuple[tuple[str, ...], ...]:
        """The symbols of every word of *text*, without sound and times."""


def lay_out(edges: NDArray[np.float64], phones: Sequence[Phone], *, language: str, notation: str, words: tuple[str, ...]) -> Schedule:
    """The schedule of *phones* between *edges* (n + 1 seconds): pauses joined, no phone shorter than `ensure_shortest` says."""
    keep = [i for i, phone in enumerate(phones) if not (phone.silent and i and phones[i - 1].silent)]
    times = ensure_shortest(np.append(edges[keep], edges[-1]))
    return Schedule(tuple(int(t) for t in np.rint(times * MICROSECONDS)), tuple(phones[i] for i in keep), language, notation, words)
