"""A counter without a voice, which worker processes can import, and corpora to count."""

from __future__ import annotations

import os
import signal
import time
from array import array
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa

from lipdb.coverage.counts import DOCUMENTS, PAIRS, Counts, Lines, pair_table

WORDS = ("bob", "go", "see", "an", "idea", "moon", "fish", "top")


@dataclass(frozen=True)
class LetterCounter:
    """Says every letter as it is written. Lines may tell it to misbehave: ``die``, ``hang``, ``wait``."""

    size: int = 1 << 18
    key: str = "letters"
    mode: str = "exact"
    notation: str = "espeak"
    threads: bool = True
    slow: float = 0.0

    def count(self, lines: Lines) -> Counts:
        time.sleep(self.slow)
        labels = ["_", *map(chr, range(33, 127))]
        codes, lengths = array("H"), []
        for text in lines.texts.to_pylist():
            obey(text)
            line = [0, *(ord(letter) - 32 for letter in text if "!" <= letter <= "~"), 0]
            codes.extend(line)
            lengths.append(len(line))
        document = np.repeat(lines.document, lengths)
        given = np.bincount(lines.document, minlength=len(lines.names)).astype(np.int64)
        return Counts.of(
            pairs=pair_table(lines, document, np.array(codes, np.uint16), labels) if len(codes) else PAIRS.empty_table(),
            documents=pa.table([pa.array(lines.names, pa.string()), given, given], schema=DOCUMENTS),
        )


@dataclass(frozen=True)
class ByteCounter(LetterCounter):
    """Counts nothing but lines: for what reading costs."""

    def count(self, lines: Lines) -> Counts:
        return Counts.of(documents=pa.table([[""], [len(lines.texts)], [len(lines.texts)]], schema=DOCUMENTS))


def obey(text: str) -> None:
    if text == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    while text == "hang":
        pass


def text(lines: int, *, seed: int = 0) -> str:
    """Lines of a few words, the same for the same seed."""
    chosen = np.random.default_rng(seed).integers(0, len(WORDS), (lines, 6)).tolist()
    return "".join(" ".join([WORDS[k] for k in six]) + "\n" for six in chosen)


def pairs_in(*texts: str) -> dict[tuple[str, str], int]:
    """What `LetterCounter` finds in texts, counted in the plainest way."""
    found: dict[tuple[str, str], int] = {}
    for line in "\n".join(texts).splitlines():
        letters = [c for c in line if "!" <= c <= "~"]
        for pair in zip(["_", *letters], [*letters, "_"], strict=True):
            if pair != ("_", "_"):
                found[pair] = found.get(pair, 0) + 1
    return found


def pairs_of(counts: Counts) -> dict[tuple[str, str], int]:
    """The pairs of all documents together."""
    rows = counts.pairs.group_by(["left", "right"]).aggregate([("count", "sum")]).to_pylist()
    return {(row["left"], row["right"]): row["count_sum"] for row in rows}


def write(folder: Path, **files: str | bytes) -> Path:
    """Files below *folder*; ``__`` in a name stands for a full stop."""
    folder.mkdir(exist_ok=True)
    for name, content in files.items():
        (folder / name.replace("__", ".")).write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder
