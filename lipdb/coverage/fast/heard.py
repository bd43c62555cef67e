"""Evidence of what running speech does to words, and what is believed of it."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from lipdb.coverage.fast.context import KINDS, PLACES, Context

Votes = dict[tuple[str, int], Counter[str]]

SURE = 2
"""Times that the voice must say a word so to be believed."""
_RULE = 3  # Different words that must do the same for others to do it, too.


class Heard(NamedTuple):
    """A word in a sentence: as it is read *alone*, as it was *said* there (labels), and what stood *before* and *behind* it."""

    word: str
    alone: Sequence[str]
    said: Sequence[str]
    before: int
    behind: int


@dataclass
class Evidence:
    """How often each word was said in which way.

    By word and neighbour: *heads*, the first label, and *rests*, all after it. By label and neighbour: what other words did
    with such a *first* or *last* label, a vote a word. A word that alone is one label has no head: all of it is the rest.
    """

    alone: dict[str, Sequence[str]] = field(default_factory=dict)
    heads: Votes = field(default_factory=lambda: defaultdict(Counter))
    rests: Votes = field(default_factory=lambda: defaultdict(Counter))
    first: dict[tuple[str, int], dict[str, set[str]]] = field(default_factory=lambda: defaultdict(lambda: defaultdict(set)))
    last: dict[tuple[str, int], dict[str, set[str]]] = field(default_factory=lambda: defaultdict(lambda: defaultdict(set)))

    def add(self, heard: Heard) -> None:
        """Take *heard* into account."""
        word, alone, said = heard.word, heard.alone, heard.said
        self.alone[word] = alone
        whole = len(alone) < 2
        self.rests[word, heard.behind][" ".join(said if whole else said[1:])] += 1
        if whole:
            return
        self.heads[word, heard.before][said[0]] += 1
        if list(said[1 : len(alone) - 1]) == list(alone[1:-1]):
            self.last[alone[-1], heard.behind][" ".join(said[len(alone) - 1 :])].add(word)
        if list(said[1:]) == list(alone[1:]):
            self.first[alone[0], heard.before][said[0]].add(word)

    def context(self, pauses_before: Sequence[str], flows_after: Sequence[str]) -> Context:
        """What is to be believed."""
        rules = Context(heads=_rules(self.first), tails=_rules(self.last))
        ruled = {label for label, _, _ in rules.heads}, {label for label, _, _ in rules.tails}
        readings = [
            (word, place, reading)
            for word, alone in self.alone.items()
            for place, reading in self._places(word, alone, rules, ruled)
            if reading != rules.usual(" ".join(alone), place)
        ]
        return Context(tuple(sorted(readings)), rules.heads, rules.tails, tuple(sorted(pauses_before)), tuple(sorted(flows_after)))

    def _places(self, word: str, alone: Sequence[str], rules: Context, ruled: tuple[set[str], set[str]]) -> Iterator[tuple[int, str]]:
        """How *word* is read at every place: as it was heard there, else by the rules, else as it was heard elsewhere."""
        for place in range(PLACES):
            before, behind = divmod(place, KINDS)
            usual = rules.usual(" ".join(alone), place).split(" ")
            head, rest = ([], usual) if len(alone) < 2 else (usual[:1], usual[1:])
            heads = _believed(self.heads, word, before, elsewhere=alone[0] not in ruled[0]) if head else None
            rests = _believed(self.rests, word, behind, elsewhere=alone[-1] not in ruled[1])
            yield place, " ".join([*(head if heads is None else heads), *(rest if rests is None else rests)])


def _believed(votes: Votes, word: str, neighbour: int, *, elsewhere: bool) -> list[str] | None:
    """What was said of *word* beside this *neighbour*, or beside any; None when it was heard too seldom."""
    here = votes.get((word, neighbour), Counter())
    if here.total() < SURE and elsewhere:
        here = sum((votes.get((word, kind), Counter()) for kind in range(KINDS)), Counter[str]())
    return most(here).split() if here.total() >= SURE else None


def _rules(seen: Mapping[tuple[str, int], Mapping[str, set[str]]]) -> tuple[tuple[str, int, str], ...]:
    """What more than half of the words with a label do beside a neighbour, where they change it."""
    rules = []
    for (label, neighbour), ways in sorted(seen.items()):
        said = min(ways, key=lambda way: (-len(ways[way]), way))
        if said != label and len(ways[said]) >= _RULE and 2 * len(ways[said]) > sum(map(len, ways.values())):
            rules.append((label, neighbour, said))
    return tuple(rules)


def most(counts: Counter[str]) -> str:
    """The most frequent; of equals the first by the alphabet."""
    return min(counts, key=lambda said: (-counts[said], said))
