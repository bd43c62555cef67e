"""Which pairs of common phones a language takes over from others, which only it has, and how much of real text each carries."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from typing import Any

from lipdb.coverage.reports.frequency import Frequency, Pair
from lipdb.curated.tsv import Records
from lipdb.errors import InputError
from lipdb.phones.refined import Kinds
from lipdb.schedule import SILENCE

POSSIBLE, OWN, WITHIN, EDGES, SYLLABLES = "possible", "own phones", "within syllables", "across syllable edges", "syllables"


@dataclass(frozen=True, slots=True)
class Part:
    """Some pairs of a language: *shared* ones by the first language that they come from, and the *new* ones that only it has.

    *inherited* counts those new ones that begin with the curves of a coarser phone (`Kinds`); *silence_shared* and
    *silence_new* count pairs with ``_``, which all else leaves out. *share_new* is the part (0..1) of running text, without
    ``_``, that the new ones carry; None where nothing is counted.
    """

    name: str
    shared: Mapping[str, int]
    new: tuple[Pair, ...]
    inherited: int
    silence_shared: int
    silence_new: int
    share_new: float | None = None

    @property
    def pairs(self) -> int:
        """Shared and new ones."""
        return sum(self.shared.values()) + len(self.new)

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "pairs of": self.name,
            "pairs": self.pairs,
            "shared": sum(self.shared.values()),
            "new": len(self.new),
            "inherited": self.inherited,
            "_ shared": self.silence_shared,
            "_ new": self.silence_new,
            "text in new": "" if self.share_new is None else f"{self.share_new:.2%}",
        }

    def to_json(self) -> dict[str, Any]:
        """Plain data for a program."""
        return {
            "name": self.name,
            "pairs": self.pairs,
            "shared": sum(self.shared.values()),
            "shared_by": dict(self.shared),
            "new": len(self.new),
            "inherited": self.inherited,
            "silence": {"pairs": self.silence_shared + self.silence_new, "shared": self.silence_shared, "new": self.silence_new},
            "share_new": self.share_new,
            "share_shared": None if self.share_new is None else 1 - self.share_new,
            "new_pairs": [list(pair) for pair in self.new],
        }


@dataclass(frozen=True, slots=True)
class PairOrigin:
    """A possible pair: the language it is taken *over* from (nothing when it is new), and the parts that it occurs in.

    *share* is its part (0..1) of all texts together, pairs with ``_`` among the rest.
    """

    left: str
    right: str
    over: str
    parts: tuple[str, ...]
    share: float

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {"left": self.left, "right": self.right, "from": self.over, "in": list(self.parts), "share": round(self.share, 6)}


@dataclass(frozen=True, slots=True)
class Reuse:
    """What *language* takes over from the languages *donors*: *own* are the common phones that only it has.

    *parts* begin with all pairs that are possible between the phones of all of them. *new* are the new pairs that occur
    in the texts, most frequent first; *pairs* is every possible pair, most frequent first.
    """

    language: str
    donors: tuple[str, ...]
    own: tuple[str, ...]
    parts: tuple[Part, ...]
    new: Frequency
    pairs: tuple[PairOrigin, ...]

    def to_json(self) -> dict[str, Any]:
        """Plain data for a program."""
        return {
            "language": self.language,
            "from": list(self.donors),
            "new_phones": list(self.own),
            "parts": [part.to_json() for part in self.parts],
            "new_pairs": [{"left": left, "right": right, "count": count} for (left, right), count in self.new.counts.items()],
        }


def common_phones(records: Records, language: str) -> frozenset[str]:
    """The common phones that the phones of *language* map to."""
    return frozenset(common for row in records.get(f"{language}/phones.tsv", {}).values() for common in row["common"].split())


def reuse(records: Records, language: str, donors: Sequence[str], texts: Mapping[str, Frequency]) -> Reuse:
    """What *language* takes over from *donors*, and how much of each of *texts* (name to frequency, with ``_``) that carries.

    Raises `InputError` for a language without phones.
    """
    phones = {code: common_phones(records, code) for code in (language, *donors)}
    if empty := next((code for code, found in phones.items() if not found), ""):
        raise InputError(f"language {empty!r} has no phones; `lipdb language list` shows those that there are")
    held = {donor: phones[donor] for donor in donors}
    own, every, kinds = phones[language], phones[language].union(*held.values()), Kinds.from_records(records)
    named = {POSSIBLE: _all_pairs(every), OWN: _all_pairs(own)}
    within, edges = _syllable_pairs(records, language)
    if within:
        named |= {WITHIN: within, EDGES: edges, SYLLABLES: within | edges}
    parts = [_part(name, pairs, held, kinds) for name, pairs in named.items()]
    parts += [_part(name, text.counts, held, kinds, text) for name, text in texts.items()]
    named |= {name: frozenset(text.counts) for name, text in texts.items()}
    together = Frequency.of((*pair, count) for text in texts.values() for pair, count in text.counts.items())
    origins = [
        PairOrigin(*pair, _holder(pair, held), tuple(name for name, held_in in named.items() if pair in held_in), together.share(pair))
        for pair in frozenset().union(*named.values())
    ]
    return Reuse(
        language,
        tuple(donors),
        tuple(sorted(own.difference(*held.values()))),
        tuple(parts),
        Frequency.of((*pair, count) for pair, count in together.counts.items() if not _holder(pair, held)),
        tuple(sorted(origins, key=lambda one: (-one.share, one.left, one.right))),
    )


def _all_pairs(phones: Iterable[str]) -> frozenset[Pair]:
    """Every pair of *phones* and silence; two silences never meet."""
    names = (SILENCE, *phones)
    return frozenset(pair for pair in product(names, names) if pair != (SILENCE, SILENCE))


def _holder(pair: Pair, held: Mapping[str, frozenset[str]]) -> str:
    """The first language that has both phones of *pair*, nothing when none has; silence is everybody's."""
    return next((code for code, phones in held.items() if set(pair) - {SILENCE} <= phones), "")


def _part(name: str, pairs: Iterable[Pair], held: Mapping[str, frozenset[str]], kinds: Kinds, text: Frequency | None = None) -> Part:
    by = {pair: _holder(pair, held) for pair in pairs}
    new = tuple(sorted(pair for pair, holder in by.items() if not holder and SILENCE not in pair))
    shared = Counter(holder for pair, holder in by.items() if holder and SILENCE not in pair)
    silence = [bool(holder) for pair, holder in by.items() if SILENCE in pair]
    inherited = sum(any(_holder(coarse, held) for coarse in kinds.coarser_pairs(*pair)) for pair in new)
    share = None
    if text is not None:
        spoken = sum(count for pair, count in text.counts.items() if SILENCE not in pair)
        share = sum(text.counts[pair] for pair in new) / spoken if spoken else 0.0
    return Part(name, {code: shared[code] for code in held}, new, inherited, sum(silence), len(silence) - sum(silence), share)


def _syllable_pairs(records: Records, language: str) -> tuple[frozenset[Pair], frozenset[Pair]]:
    """The pairs inside the written syllables of *language*, and those where any of them meets any other or silence.

    Both are empty for a language without a table of syllables.
    """
    rows = records.get(f"{language}/syllables.tsv", {}).values()
    common = {row["phone"]: row["common"].split() for row in records.get(f"{language}/phones.tsv", {}).values()}
    spoken = [[name for part in (row["initial"], row["final"]) if part for name in common[part]] for row in rows]
    firsts, lasts = {row[0] for row in spoken if row}, {row[-1] for row in spoken if row}
    within = frozenset(pair for row in spoken for pair in pairwise(row))
    return within, frozenset({*product(lasts, firsts), *product([SILENCE], firsts), *product(lasts, [SILENCE])})
