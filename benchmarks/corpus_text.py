"""Grow a text to any size: new sentences in the manner of a seed, with new words all the way.

usage: python benchmarks/corpus_text.py SEED SIZE OUT [--characters]

SEED has a sentence a line, SIZE is in MB (10^6 bytes). Sentences are walks through the seed's pairs of neighbouring words, from
a start to an end that the seed has, so frequent words, punctuation and what stands beside what are the seed's. One word in
25 gives way to one of a tail without end, made of a beginning and an ending of the seed's words and drawn by Zipf's law;
as in real text, the number of different words grows with about the 0.6th power of the length (a tail of real words ends, and
with it what a cold scan costs). With --characters each character is a word and the tail are rarer Chinese characters.
The same seed and size give the same bytes on any machine.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.int64]

WALKS = 20_000
LONGEST = 60
TAIL = 0.04
EXPONENT, COMMONEST = 1.4, 2000
"""Of Zipf's law, and the rank at which the tail begins."""
RARE_CHARACTERS = range(0x4E00, 0x9FA6)


@dataclass(frozen=True)
class Chain:
    """The words of a seed and what follows each: word *w* is followed by one of ``following[starts[w]:starts[w + 1]]``.

    Word 0 is both the start and the end of a sentence.
    """

    words: list[str]
    starts: Numbers
    following: Numbers

    @classmethod
    def of(cls, sentences: list[list[str]]) -> Chain:
        """The chain of *sentences*."""
        numbers = {"": 0}
        runs = [[numbers.setdefault(word, len(numbers)) for word in ["", *words, ""]] for words in sentences if words]
        pairs = np.array([(a, b) for run in runs for a, b in pairwise(run)])
        pairs = pairs[np.argsort(pairs[:, 0], kind="stable")]
        return cls(list(numbers), np.searchsorted(pairs[:, 0], np.arange(len(numbers) + 1)), pairs[:, 1])

    def walks(self, rng: np.random.Generator) -> Numbers:
        """`WALKS` sentences, of shape (sentence, word), 0 behind the end."""
        at = np.zeros((LONGEST, WALKS), np.int64)
        open = np.arange(WALKS)
        for step in range(LONGEST):
            last = at[step - 1, open] if step else np.zeros(WALKS, np.int64)
            first, count = self.starts[last], self.starts[last + 1] - self.starts[last]
            at[step, open] = self.following[first + (rng.random(len(open)) * count).astype(np.int64)]
            open = open[at[step, open] > 0]
            if not open.size:
                break
        return at.T


class Tail:
    """Words beyond the seed's: the *rank*-th is always the same."""

    def __init__(self, words: list[str], *, characters: bool) -> None:
        plain = sorted({word for word in words if word.isalpha() and len(word) > 3})
        self._heads = sorted({word[: -len(word) // 3] for word in plain})
        self._ends = sorted({word[-len(word) // 3 :] for word in plain})
        self._characters = characters

    def word(self, rank: int) -> str:
        """The word at *rank*, from 1."""
        mixed = rank * 0x9E3779B97F4A7C15 % 2**64
        if self._characters:
            return chr(RARE_CHARACTERS[(mixed >> 20) % len(RARE_CHARACTERS)])
        return self._heads[(mixed >> 36) % len(self._heads)] + self._ends[(mixed >> 8) % len(self._ends)]


def grow(sentences: list[str], size: int, *, characters: bool = False, seed: int = 1) -> Iterator[bytes]:
    """*size* bytes of text in the manner of *sentences*, in pieces of whole lines; the last line may be cut short."""
    rng = np.random.default_rng(seed)
    chain = Chain.of([list(text) if characters else text.split() for text in sentences])
    tail = Tail(chain.words, characters=characters)
    known = {0: len(chain.words)}  # Rank in the tail to number; 0 is the line feed.
    texts = [(word if characters else f"{word} ").encode() for word in chain.words] + [b"\n"]
    plain = np.array([word.isalpha() for word in chain.words])
    while size > 0:
        numbers = chain.walks(rng)
        ranks = (COMMONEST * rng.random(numbers.shape) ** (-1 / (EXPONENT - 1))).clip(max=2**40).astype(np.int64)
        rare = (rng.random(numbers.shape) < TAIL) & plain[numbers]
        for rank in np.unique(ranks[rare]).tolist():
            if rank not in known:
                known[rank] = len(texts)
                texts.append((tail.word(rank) if characters else f"{tail.word(rank)} ").encode())
        numbers[rare] = [known[rank] for rank in ranks[rare].tolist()]
        ended = np.concatenate([numbers, np.zeros((len(numbers), 1), np.int64)], axis=1)
        ended[np.arange(len(ended)), np.argmax(ended == 0, axis=1)] = known[0]
        piece = b"".join([texts[number] for number in ended[ended > 0].tolist()]).replace(b" \n", b"\n")[:size]
        size -= len(piece)
        yield piece


def main() -> None:
    """Write the text."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("seed", type=Path)
    parser.add_argument("size", type=float, help="MB")
    parser.add_argument("out", type=Path)
    parser.add_argument("--characters", action="store_true")
    given = parser.parse_args()
    sentences = given.seed.read_text(encoding="utf-8").splitlines()
    with given.out.open("wb") as out:
        for piece in grow(sentences, round(given.size * 1e6), characters=given.characters):
            out.write(piece)


if __name__ == "__main__":
    main()
