"""Real text of a language, as the frequency of its pairs of common phones: its sample sentences, a scan, or a text file."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from lipdb.coverage.reports.frequency import Frequency, Pair
from lipdb.coverage.reports.named import DELIMITERS, read_frequency
from lipdb.files import read_text
from lipdb.languages.sample import Sample, listen, symbols_of
from lipdb.languages.text import sentences_of
from lipdb.phones.phoneset import PhoneSet
from lipdb.schedule import MICROSECONDS, SILENCE, Phone, Schedule

if TYPE_CHECKING:
    from lipdb.database import Database
    from lipdb.speech.voice import Phrases


@dataclass(frozen=True, slots=True)
class Text:
    """A text's *name*, how often each pair of common phones occurs in it, and what a person should know of it."""

    name: str
    frequency: Frequency
    notes: tuple[str, ...] = ()


def frequency_of(database: Database, language: str, corpus: Path | None = None) -> Text:
    """The pairs of *corpus*: of a table of pairs as a scan writes it, or of a text that the language's voice reads.

    Without *corpus*: of the language's sample sentences. Raises `InputError` for files that can't be read.
    """
    if corpus is not None and corpus.suffix.lower() in (".parquet", *DELIMITERS):
        return Text(corpus.name, read_frequency(corpus))
    if corpus is None:
        name = f"{language}/sentences.tsv"
        sentences = tuple(sentence for (sentence,) in database.records.get(name, {}))
    else:
        name, sentences = corpus.name, sentences_of(read_text(corpus))
    if not sentences:
        return Text(name, Frequency.of(()), ("there is no text to count; give one with --corpus",))
    voice = database.voice(language)
    sample = listen(voice, sentences)
    frequency, notes = heard(sample, database.phoneset(language), voice.notation)
    if sample.refused:
        first = next(iter(sample.refused.values()))
        notes = (f"{len(sample.refused)} of {len(sentences)} sentences can't be read: {first}", *notes)
    return Text(name, frequency, notes)


def heard(sample: Sample, phoneset: PhoneSet, notation: str) -> tuple[Frequency, tuple[str, ...]]:
    """How often each pair of common phones occurs in what a voice said in *notation*, with ``_`` at the ends of phrases.

    And notes on symbols that no table knows, which are mapped by articulation.
    """
    common, notes = {}, []
    for symbol in sorted({symbol for phrases in sample.said.values() for symbol in symbols_of(phrases)}):
        alone = Schedule((0, MICROSECONDS), (Phone(symbol),), phoneset.language, notation)
        resolved, unknown = phoneset.resolve(alone, allow_unknown=True)
        common[symbol] = [name for phone in resolved.phones for name in phone.common]
        notes += [f"unknown symbol {one} was mapped by articulation" for one in unknown]
    counts: Counter[Pair] = Counter()
    for phrases in sample.said.values():
        counts.update(_pairs(phrases, common))
    return Frequency.of((*pair, count) for pair, count in counts.items()), tuple(notes)


def _pairs(phrases: Phrases, common: Mapping[str, Sequence[str]]) -> Iterable[Pair]:
    for phrase in phrases:
        names = [name for word in phrase for symbol in word for name in common[symbol]]
        yield from (pair for pair in pairwise((SILENCE, *names, SILENCE)) if pair != (SILENCE, SILENCE))
