"""Korean: Hangul to timed phones, with sound from espeak-ng.

The phones follow from the rules of standard pronunciation (`lipdb.speech.hangul`). espeak is given phonemes; its own
reading of Hangul is not used: it leaves out most assimilation (국물 kukmul, 신라 sinra) and splits ㅊ and ㅌ in two. Of
14,363 running words of bills and interface strings it says 9.6 % otherwise, not counting tense consonants and hushes, and
8.2 % with another mouth.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib.metadata import version as package_version
from typing import TYPE_CHECKING, NamedTuple

from lipdb.errors import InputError
from lipdb.phones.mapping import bracketed
from lipdb.speech import libespeak, phonemes, sounds
from lipdb.speech.espeak import SETTINGS, language_row
from lipdb.speech.korean_numbers import spell_numbers
from lipdb.speech.korean_sounds import sounds_of
from lipdb.speech.mandarin import split_ipa
from lipdb.speech.sounds import Breath, Sound, Word
from lipdb.speech.text import check_script, clean
from lipdb.speech.voice import Phrases, Reading, Spoken

if TYPE_CHECKING:
    from lipdb.curated.tsv import Records

NOTATION = "ipa"
PUNCTUATION = {**dict.fromkeys(",;:…、，", ","), ".": ".", "。": ".", "!": "!", "?": "?"}
# Sounds, some 70 syllables. A person breathes sooner or later, and espeak cuts a clause of 800 characters anywhere.
LONGEST_BREATH = 160
# How Koreans call Latin letters, for words in capitals.
_LETTERS = {
    "A": "에이", "B": "비", "C": "시", "D": "디", "E": "이", "F": "에프", "G": "지", "H": "에이치", "I": "아이", "J": "제이", "K": "케이",
    "L": "엘", "M": "엠", "N": "엔", "O": "오", "P": "피", "Q": "큐", "R": "아르", "S": "에스", "T": "티", "U": "유", "V": "브이",
    "W": "더블유", "X": "엑스", "Y": "와이", "Z": "제트",
}  # fmt: skip
_SIGNS = {"&": "앤드", "+": "플러스", "@": "골뱅이"}
_PIECE = re.compile(r"(?P<hangul>[가-힣]+)|(?P<capitals>[A-Z]+)(?![a-z'’])|(?P<latin>[A-Za-zÀ-ž][A-Za-zÀ-ž'’]*)|(?P<other>.)")


class Plan(NamedTuple):
    """What is to be said: breaths, the words that their sounds belong to, notes, and how many words are read as English."""

    breaths: list[Breath]
    words: list[Word]
    notes: tuple[str, ...]
    foreign: int


@dataclass
class _Draft:
    """A plan in the making; *row* is the breath that is not at its end yet."""

    breaths: list[Breath] = field(default_factory=list)
    words: list[Word] = field(default_factory=list)
    row: list[Sound] = field(default_factory=list)
    unread: list[str] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)

    def pause(self, mark: str) -> None:
        """End the breath, if anything is said in it."""
        if self.row:
            self.breaths.append(Breath(self.row, mark))
        self.row = []


def hangul_voice(records: Records, language: str) -> HangulVoice:
    """The voice of *language* as its tables say. Raises `PhonesetError` when ``language.tsv`` is missing."""
    row = language_row(records, language)
    readings = {word: reading["reading"] for (word,), reading in records.get(f"{language}/readings.tsv", {}).items()}
    segments = frozenset(segment for (segment,) in records.get("ipa.tsv", {}))
    return HangulVoice(row["voice"], language, row["script"], readings, segments)


@dataclass(frozen=True)
class HangulVoice:
    """A voice that reads Korean; see `lipdb.speech.voice.Voice`.

    *readings* are parts of words and how they are spelled as they sound; *segments* the IPA segments of the common layer.
    """

    name: str
    language: str
    script: str
    readings: Mapping[str, str]
    segments: frozenset[str]

    @property
    def notation(self) -> str:
        """The notation of its symbols."""
        return NOTATION

    @property
    def version(self) -> str:
        """Library, package, settings and the tables that decide readings."""
        digest = hashlib.sha256(repr((sorted(self.readings.items()), sorted(self.segments))).encode()).hexdigest()[:12]
        return f"espeak-ng {libespeak.espeak_version()}; lipdb {package_version('lipdb')}; {SETTINGS}; tables {digest}"

    def raw(self) -> HangulVoice:
        """Itself: what it says are phones already, and its table is small."""
        return self

    def speak(self, text: str) -> Spoken:
        """Speak *text*; words are what stands between spaces, as it is written.

        A word in small Latin letters is read as English; its phones are IPA segments in brackets, for the common layer.
        """
        plan = self._plan(text)
        spoken = sounds.speak(plan.breaths, plan.words, voice=self.name, language=self.language, notation=NOTATION)
        return replace(spoken, notes=plan.notes)

    def phrases(self, text: str) -> Phrases:
        """The phones of every word, a phrase for every breath."""
        return self.read(text).phrases

    def read(self, text: str) -> Reading:
        """As `phrases`, with the number of words that are read as English."""
        plan = self._plan(text)
        return Reading(sounds.phrases(plan.breaths), plan.foreign)

    def _plan(self, text: str) -> Plan:
        cleaned, notes = clean(text)
        check_script(cleaned, self.script, language=self.language)
        draft = _Draft()
        for written, spelled in zip(cleaned.split(), spell_numbers(cleaned).split(), strict=True):
            self._add(written, spelled, draft)
        draft.pause(".")
        if len(draft.words) == len(draft.foreign):
            raise InputError(f"text: there is no Korean in {cleaned!r}; write Hangul, or give the --language of the text")
        if draft.foreign:
            notes = (*notes, f"text: {', '.join(dict.fromkeys(draft.foreign))} read as English")
        if draft.unread:
            notes = (*notes, f"text: {' '.join(dict.fromkeys(draft.unread))} can't be read and is left out")
        return Plan(draft.breaths, draft.words, notes, len(draft.foreign))

    def _add(self, written: str, spelled: str, draft: _Draft) -> None:
        """Add what stands between two spaces, as it is *written* and with its numbers *spelled*, to *draft*."""
        rest, heard = written.strip(_EDGE), False
        for kind, piece in self._pieces(spelled):
            if kind == "unread":
                draft.unread.append(piece)
            elif kind == "mark" or len(draft.row) > LONGEST_BREATH:
                draft.pause(piece if kind == "mark" else ",")
            if kind == "latin":
                draft.row += self._foreign(piece, len(draft.words))
                draft.foreign.append(piece)
                draft.words.append(Word(piece, plain=piece))
                heard, rest = False, rest.partition(piece)[2]
            elif kind == "hangul":
                draft.row += sounds_of(piece, len(draft.words))
                heard = True
        if heard:
            draft.words.append(Word(rest))

    def _pieces(self, spelled: str) -> Iterator[tuple[str, str]]:
        """The parts of what stands between spaces: Hangul as it is to be read, Latin words, marks of pauses, unread signs."""
        respelled = self._words.sub(lambda match: self.readings[match[0]], spelled)
        text = "".join(_SIGNS.get(sign, sign) for sign in respelled)
        hangul = ""
        for match in _PIECE.finditer(text):
            kind, piece = match.lastgroup or "", match[0]
            if kind in ("hangul", "capitals"):
                hangul += piece if kind == "hangul" else "".join(_LETTERS[letter] for letter in piece)
                continue
            named = ("latin", piece) if kind == "latin" else _other(piece)
            if named[0]:
                if hangul:
                    yield "hangul", hangul
                hangul = ""
                yield named
        if hangul:
            yield "hangul", hangul

    @cached_property
    def _words(self) -> re.Pattern[str]:
        longest_first = sorted(self.readings, key=len, reverse=True)
        return re.compile("|".join(map(re.escape, longest_first)) or r"(?!)")

    def _foreign(self, written: str, word: int) -> list[Sound]:
        labels = [label for spoken in phonemes.words(written, self.name) for label in spoken]
        return [Sound(bracketed(segment), word, ("",)) for label in labels for segment in split_ipa(label, self.segments)]


_EDGE = " \"'“”‘’«»()[]{}<>.,;:!?…、，。·~-–—「」『』《》〈〉"


def _other(sign: str) -> tuple[str, str]:
    """What a *sign* that is no letter says: a pause, something that nobody reads, or nothing."""
    if sign in PUNCTUATION:
        return "mark", PUNCTUATION[sign]
    return ("unread", sign) if unicodedata.category(sign)[0] in "LNS" else ("", "")
