"""What running speech does to words: what is known of it, and what it makes of one reading.

By itself the voice says "the" with ə, "a" as the letter and "of" in full; in a sentence the neighbours decide. Most of that
is the outer labels: what a word begins with depends on what the word in front ends with (Spanish "de" with d behind a
pause, with ð behind a vowel), and what it ends with depends on what follows (English "her" with r before a vowel). So a
word has a reading for each of three things before it and three behind it: a pause, a vowel, a consonant.
"""

from __future__ import annotations

import hashlib
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any, Self

PAUSE, VOWEL, CONSONANT = range(3)
"""What stands before or behind a word."""
KINDS = 3
PLACES = KINDS * KINDS
"""How many places a word can have: ``before * KINDS + behind``."""


@dataclass(frozen=True)
class Context:
    """What a sample taught.

    * *readings*: word, place and how it is read there
    * *heads*: of other words, the first label alone, what stands before, the first label there
    * *tails*: of other words, the last label alone, what stands behind, the last labels there
    * *pauses_before* and *flows_after*: words before which the voice pauses without a mark, and behind which it does not pause
      in spite of one
    """

    readings: tuple[tuple[str, int, str], ...] = ()
    heads: tuple[tuple[str, int, str], ...] = ()
    tails: tuple[tuple[str, int, str], ...] = ()
    pauses_before: tuple[str, ...] = ()
    flows_after: tuple[str, ...] = ()

    @property
    def digest(self) -> str:
        """Changes with anything in it."""
        told = self.readings, self.heads, self.tails, self.pauses_before, self.flows_after
        return hashlib.sha256(repr(told).encode()).hexdigest()[:12]

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)

    @classmethod
    def from_json(cls, told: dict[str, Any]) -> Self:
        """What `to_json` gave. Raises `TypeError` for anything else."""
        fields: dict[str, Any] = {name: tuple(tuple(one) if isinstance(one, list) else one for one in rows) for name, rows in told.items()}
        return cls(**fields)

    @cached_property
    def _heads(self) -> dict[tuple[str, int], str]:
        return {(label, before): said for label, before, said in self.heads}

    @cached_property
    def _tails(self) -> dict[tuple[str, int], str]:
        return {(label, behind): said for label, behind, said in self.tails}

    def usual(self, alone: str, place: int) -> str:
        """How a word that is read *alone* like this is read at *place*, if nothing is known of the word itself."""
        before, behind = divmod(place, KINDS)
        labels = alone.split(" ")
        if len(labels) < 2:
            return alone
        head = self._heads.get((labels[0], before), labels[0])
        tail = self._tails.get((labels[-1], behind), labels[-1])
        return " ".join(filter(None, [head, *labels[1:-1], tail]))
