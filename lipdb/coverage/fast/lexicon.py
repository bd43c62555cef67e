"""What a voice says to each written word by itself, asked once.

A lexicon holds nothing but a voice's answers, so no result depends on what was in it before. Its answers are kept between
scans (`lipdb.coverage.fast.lexicon_files`).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from lipdb.coverage.fast.codes import UNKNOWN, Codes, Keys
from lipdb.coverage.fast.readings import Numbers, Readings
from lipdb.coverage.fast.words import Words, each_a_word
from lipdb.coverage.findings import NO_WORDS, REASONS
from lipdb.coverage.speaker import Speaker
from lipdb.schedule import SILENCE
from lipdb.speech.voice import Voice

Masks = NDArray[np.uint32]

REMARKS = tuple(REASONS)
"""What bit *i* of a mask of remarks means."""
# A word that every language of a script can read: does the voice pause where something stands between two of it?
_BESIDE = {
    "Arab": "بابا", "Armn": "պապ", "Cyrl": "папа", "Deva": "पापा", "Geor": "მამა", "Grek": "παπα", "Hans": "爸", "Hant": "爸",
    "Hebr": "אבא", "Jpan": "パパ", "Kore": "아빠", "Latn": "papa", "Thai": "ปาปา",
}  # fmt: skip
# Among Chinese characters a word in Latin letters is English; by itself it would be pinyin.
_FRAMES = {"Hans": "啊，{}，啊", "Hant": "啊，{}，啊"}


BREAK = f" {SILENCE} "
"""Between the phrases of a reading."""


ANSWERS = pa.schema([("word", pa.string()), ("reading", pa.string()), ("remarks", pa.int64())])
"""What a voice says to words: labels between spaces, ``_`` where it pauses; and a mask of `REMARKS`."""


class Spelled(NamedTuple):
    """A text as it was said: each phrase as labels between spaces; and a mask of `REMARKS`."""

    phrases: list[str]
    remarks: int


class Lexicon:
    """What *voice* says to words.

    By the number of a word: *reading* is the number of its reading in *readings*, *remarks* a mask. *pauses* says of each gap
    whether the voice pauses there. What was *asked* of the voice stands there until somebody keeps it;
    *files* are the names of those whose answers were taken over.
    """

    def __init__(self, voice: Voice) -> None:
        self.readings = Readings()
        self.reading: Numbers = np.zeros(0, np.int32)
        self.remarks: Masks = np.zeros(0, np.uint32)
        self.unusual: NDArray[np.bool_] = np.zeros(0, bool)
        self.pauses: NDArray[np.bool_] = np.zeros(0, bool)
        self.asked = ANSWERS.empty_table()
        self.files: set[str] = set()
        self.speaker = Speaker(voice)
        self._frame, self._beside = _FRAMES.get(voice.script, ""), _BESIDE.get(voice.script, "3")
        self._words, self._gaps = Codes(), Codes()

    def arrays(self) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
        """All that `restore` needs: arrays, and plain data."""
        told = {"names": self.readings.names, "files": sorted(self.files)}
        return {"words": self._words.slots.reshape(-1), "reading": self.reading, "remarks": self.remarks, **self.readings.arrays()}, told

    def restore(self, arrays: dict[str, NDArray[Any]], told: dict[str, Any]) -> None:
        """Take over what `arrays` gave of another lexicon of the same voice; this one is empty."""
        self.reading, self.remarks = arrays.pop("reading"), arrays.pop("remarks")
        self._words = Codes.of(arrays.pop("words").reshape(-1, 2), len(self.reading))
        self.unusual = (self.remarks != 0) | (self.reading == 0)
        self.readings, self.files = Readings.of(told["names"], **arrays), set(told["files"])

    def __len__(self) -> int:
        return len(self._words)

    def words(self, words: Words) -> NDArray[np.int64]:
        """The numbers of *words*; the voice is asked for those that are new."""
        keys = words.keys()
        numbers = self._words.find(keys)
        if (new := np.flatnonzero(numbers == UNKNOWN)).size:
            places = _first(keys, new)
            answers = self._ask([words.word(place) for place in places.tolist()])
            asked = pa.table([list(column) for column in zip(*answers, strict=True)], schema=ANSWERS)
            self._enter(asked, self.readings.number(asked["reading"].combine_chunks()))
            self.asked = pa.concat_tables([self.asked, asked])
            numbers[new] = self._words.find(keys[new])
        return numbers

    def gaps(self, words: Words, places: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Whether the voice pauses in the gaps at *places*."""
        keys = words.gap_keys(places)
        numbers = self._gaps.find(keys)
        if (new := np.flatnonzero(numbers == UNKNOWN)).size:
            first = _first(keys, new)
            said = self.said([f"{self._beside}{words.gap(place)}{self._beside}" for place in places[first].tolist()])
            self.pauses = np.append(self.pauses, np.array([len(one.phrases) > 1 for one in said], bool))
            self._gaps.add(keys[first])
            numbers[new] = self._gaps.find(keys[new])
        return self.pauses[numbers]

    def learn(self, answers: pa.Table) -> None:
        """Take over *answers* of the same voice, a table of `ANSWERS`, each word once; those that are known already stay."""
        answers = answers.combine_chunks()
        new = self._words.find(each_a_word(answers["word"].combine_chunks()).keys()) == UNKNOWN
        if not new.all():
            answers = answers.filter(pa.array(new))
        self._enter(answers, self.readings.number_many(answers["reading"].combine_chunks()))

    def _enter(self, answers: pa.Table, readings: Numbers) -> None:
        self.reading = np.append(self.reading, readings)
        self.remarks = np.append(self.remarks, answers["remarks"].to_numpy().astype(np.uint32))
        self.unusual = (self.remarks != 0) | (self.reading == 0)
        self._words.add(each_a_word(answers["word"].combine_chunks()).keys())

    def said(self, texts: Sequence[str]) -> list[Spelled]:
        """Each of *texts* as the voice says it in running speech."""
        rows, names = self.speaker.say_all(texts), self.speaker.labels
        # Codes are of 16 bits, and so are the characters of this encoding.
        phrases = [filter(None, codes.decode("utf-16-le", "surrogatepass").split("\0")) for codes, _ in rows]
        return [
            Spelled([" ".join([names[ord(code)] for code in phrase]) for phrase in of], mask_of(reasons))
            for of, (_, reasons) in zip(phrases, rows, strict=True)
        ]

    def _ask(self, words: list[str]) -> list[tuple[str, str, int]]:
        framed = [bool(self._frame) and word.isascii() for word in words]
        said = self.said([self._frame.format(word) if apart else word for word, apart in zip(words, framed, strict=True)])
        # A line may have other words.
        remarks = ~mask_of((NO_WORDS,))
        return [
            (word, BREAK.join(phrases[1:-1] if apart else phrases), found & remarks)
            for word, apart, (phrases, found) in zip(words, framed, said, strict=True)
        ]


def mask_of(reasons: Iterable[str]) -> int:
    """*reasons* as a mask of `REMARKS`."""
    return sum(1 << REMARKS.index(reason) for reason in reasons)


def _first(keys: Keys, places: NDArray[np.int64]) -> NDArray[np.int64]:
    """Where each different key among *places* stands first, in order."""
    return places[np.sort(np.unique(keys[places], return_index=True)[1])]
