"""Sentences and words of a language as pairs of common phones: to find text that needs a pair."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from lipdb.languages.reuse_text import heard
from lipdb.languages.sample import Sample, listen
from lipdb.schedule import SILENCE

if TYPE_CHECKING:
    from lipdb.coverage.reports.frequency import Pair
    from lipdb.database import Database
    from lipdb.line import Line


class Examples:
    """The sample sentences of *language*, and which pairs *character* says in each; sentences that can't be read are left out."""

    def __init__(self, database: Database, language: str, character: str | None = None) -> None:
        phoneset = database.phoneset(language, character=character)
        sentences = [sentence for (sentence,) in database.records.get(f"{language}/sentences.tsv", {})]
        voice = database.voice(language)
        self.pairs: dict[str, frozenset[Pair]] = {}
        for sentence, phrases in listen(voice, sentences).said.items():
            frequency, _ = heard(Sample({sentence: phrases}), phoneset, voice.notation)
            self.pairs[sentence] = frozenset(frequency.pairs)

    def containing(self, left: str, right: str) -> list[str]:
        """The sentences in which the pair occurs, the shortest first."""
        return sorted((sentence for sentence, pairs in self.pairs.items() if (left, right) in pairs), key=lambda s: (len(s), s))


def pairs_in_order(line: Line) -> list[Pair]:
    """The pairs of common phones of *line* in the order of speech, each once, with ``_`` at its ends."""
    _, names = line.schedule.common()
    return list(dict.fromkeys(pair for pair in pairwise((SILENCE, *names, SILENCE)) if pair != (SILENCE, SILENCE)))
