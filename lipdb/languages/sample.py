"""What the voice of a language makes of its sample text, and which phones and pairs of common phones that has."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import TYPE_CHECKING

from lipdb.curated.tsv import Records
from lipdb.curves.lookup import CurveBook
from lipdb.decisions import ORIGINS, pair_uses
from lipdb.errors import InputError
from lipdb.languages.folder import LanguageFolder
from lipdb.languages.report import Coverage, Pair, Remark
from lipdb.phones.mapping import unbracketed
from lipdb.phones.phoneset import PhoneSet, shortened
from lipdb.poses import SHARED
from lipdb.schedule import MICROSECONDS, SILENCE, Phone, Schedule

if TYPE_CHECKING:
    from lipdb.speech.voice import Phrases, Voice


PROBE = "1"
"""What a voice is asked for to see whether it is there; every language has numbers."""


@dataclass(frozen=True, slots=True)
class Sample:
    """The sample text as the voice says it: sentence → phrases; *refused* are the sentences that it can't read, and why."""

    said: dict[str, Phrases]
    refused: dict[str, str] = field(default_factory=dict)


def listen(voice: Voice, sentences: Iterable[str]) -> Sample:
    """Let *voice* read *sentences*. Raises what the voice raises but `InputError`."""
    sample = Sample({})
    for sentence in sentences:
        try:
            sample.said[sentence] = voice.phrases(sentence)
        except InputError as error:
            sample.refused[sentence] = str(error).removeprefix("text: ")
    return sample


def symbols_of(phrases: Phrases) -> Iterator[str]:
    """Every symbol in *phrases*, in order."""
    return (symbol for phrase in phrases for word in phrase for symbol in word)


class Hearing:
    """What *voice* says of a language's sentences and example words, with the phones that it stands for in *phoneset*.

    Raises `LipdbError` when the voice can't be had.
    """

    def __init__(self, folder: LanguageFolder, phoneset: PhoneSet, voice: Voice) -> None:
        self.folder, self.phoneset, self.notation = folder, phoneset, voice.notation
        with suppress(InputError):
            voice.phrases(PROBE)
        self.sample = listen(voice, (sentence for (sentence,) in folder.rows("sentences")))
        # An example may be several words, and in another script than its own as well.
        words = {word for row in folder.rows("phones").values() for word in row["example"].replace(",", " ").split()}
        self.examples = {word: self._phones(symbols_of(phrases)) for word, phrases in listen(voice, sorted(words)).said.items()}
        self.counts = Counter(symbol for phrases in self.sample.said.values() for symbol in symbols_of(phrases))
        self.parts = {symbol: phoneset.symbols.parts(symbol, self.notation) for symbol in self.counts}

    def _phones(self, symbols: Iterable[str]) -> frozenset[str]:
        return frozenset(part for symbol in symbols for part in self.phoneset.symbols.parts(symbol, self.notation))

    @property
    def phones(self) -> frozenset[str]:
        """Every phone that occurs."""
        return frozenset(part for parts in self.parts.values() for part in parts)

    def remarks(self) -> Iterator[Remark]:
        """Sentences that can't be read, symbols that no table knows, and phones that never occur."""
        path = f"{self.folder.code}/sentences.tsv"
        for sentence, why in self.sample.refused.items():
            yield Remark(path, (sentence,), "sentence", f"the voice can't read this: {why}")
        yield from self._symbols(path)
        yield from self._unheard(path)

    def _unheard(self, path: str) -> Iterator[Remark]:
        """Phones that the voice does not say in their example; those that it says there, but in no sentence, are errors."""
        heard = self.phones
        for key, row in self.folder.rows("phones").items():
            phone, words = row["phone"], row["example"].replace(",", " ").split()
            shown = any(phone in self.examples.get(word, ()) for word in words)
            # Where there are no sentences at all, one finding says so.
            if phone not in heard and self.sample.said:
                what = "write one with it" if shown else "the voice does not say it in its example either"
                message = f"{phone!r} occurs in no sentence of {path}; {what}"
                yield Remark(f"{self.folder.code}/phones.tsv", key, "phone", message, note=not shown)
            elif not shown:
                yield Remark(
                    f"{self.folder.code}/phones.tsv", key, "example", f"the voice does not say {phone!r} in {row['example']}", note=True
                )

    def _symbols(self, path: str) -> Iterator[Remark]:
        missing = [symbol for symbol, parts in self.parts.items() if not parts]
        foreign = [symbol for symbol, parts in self.parts.items() if any(map(unbracketed, parts)) and not unbracketed(symbol)]
        first = {symbol: sentence for sentence, phrases in reversed(self.sample.said.items()) for symbol in symbols_of(phrases)}
        for symbol, what in self._unknown(missing).items():
            message = f"the voice says {shortened(symbol)!r} here ({self.counts[symbol]}x in all), which no table knows; {what}"
            yield Remark(path, (first[symbol],), "sentence", message)
        for symbol in foreign:
            segments = " ".join(filter(None, map(unbracketed, self.parts[symbol])))
            message = (
                f"the voice says {symbol!r} here ({self.counts[symbol]}x in all), which only the common table knows ({segments}); "
                f"give it a row in {self.folder.code}/phones.tsv or aliases.tsv"
            )
            yield Remark(path, (first[symbol],), "sentence", message)

    def _unknown(self, symbols: Sequence[str]) -> dict[str, str]:
        """What to say of each unknown symbol."""
        if not symbols:
            return {}
        _, unknown = self.phoneset.resolve(_schedule(symbols, self.folder.code, self.notation), allow_unknown=True)
        return {one.symbol: f"nearest is {one.proposal!r}: {one.reason}" if one.proposal else one.reason for one in unknown}

    def pairs(self) -> Counter[Pair]:
        """How often each pair of common phones occurs, with ``_`` at the ends of phrases."""
        common = {symbol: self._common(symbol) for symbol in self.parts}
        found: Counter[Pair] = Counter()
        for phrases in self.sample.said.values():
            for phrase in phrases:
                row = [c for word in phrase for symbol in word for c in common[symbol]]
                found.update(pair for pair in pairwise((SILENCE, *row, SILENCE)) if pair != (SILENCE, SILENCE))
        return found

    def _common(self, symbol: str) -> tuple[str, ...]:
        # An alias may name a phone that there is not; another finding says so.
        found = [self.phoneset.mappings.find(part, {}) for part in self.parts[symbol]]
        return tuple(c for mapped in found if mapped for c in mapped.common)

    def coverage(self) -> Coverage | None:
        """The pairs that the language can have, those that the sample has, and where the curves of these come from.

        None where there is no sentence or no phone, or a phone maps to a common phone that there is not.
        """
        records, own = self.folder.records, self.folder.rows("phones")
        common = sorted({SILENCE, *(c for row in own.values() for c in row["common"].split())})
        if not self.sample.said or not own or any((name,) not in records.get("common.tsv", {}) for name in common):
            return None
        possible = [(left, right) for left, right in product(common, repeat=2) if left != SILENCE or right != SILENCE]
        found = self.pairs()
        missing = tuple(pair for pair in possible if pair not in found)
        return Coverage(
            sentences=len(self.sample.said),
            phones=len(own),
            phones_heard=len(self.phones & {phone for (phone,) in own}),
            possible=len(possible),
            occurring=len(possible) - len(missing),
            missing=missing,
            origins=_origins(records, self.folder.code, [pair for pair in possible if pair in found]),
        )


def _origins(records: Records, language: str, pairs: list[Pair]) -> dict[str, int]:
    """How many of *pairs* have a curve of each origin, where the records have curves."""
    if not records.get(f"poses/{SHARED}.tsv"):
        return {}
    uses = pair_uses(CurveBook.from_records(records, SHARED, language=language), ((pair, 1) for pair in pairs))
    counts = Counter(use.origin for use in uses)
    return {origin: counts[origin] for origin in ORIGINS if counts[origin]}


def _schedule(symbols: Iterable[str], language: str, notation: str = "") -> Schedule:
    """*symbols* one after another, a second each."""
    phones = tuple(Phone(symbol) for symbol in symbols) or (Phone(SILENCE),)
    return Schedule(tuple(i * MICROSECONDS for i in range(len(phones) + 1)), phones, language, notation)
