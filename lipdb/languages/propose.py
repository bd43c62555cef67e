"""Rows for a new language: what its voice was heard to say, mapped by articulation, for a person to review."""

from __future__ import annotations

import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from lipdb.curated.schema import table_of
from lipdb.curated.tsv import Key, Records, Row, canonical_row, key_of
from lipdb.languages.labels import THIRD, Reading, has_tones, read_espeak
from lipdb.languages.precedent import judged, precedents
from lipdb.languages.report import REVIEW
from lipdb.languages.xsampa import xsampa
from lipdb.phones.proposal import Proposal
from lipdb.phones.segments import read_segment
from lipdb.schedule import SILENCE

NOTATION = "ipa"
"""The own notation of a new language: its phones are named by their IPA."""
RARE = 1 / 10_000
"""A phone with a smaller share of a text may come from a name or a foreign word; a short text can't tell."""
_TIE = "\u0361"


@dataclass(frozen=True, slots=True)
class Phone:
    """A phone that was heard: its IPA, the labels that it was heard in and whether in one *alone*, how often and whether that is
    *rare*, a word with it, and what it may map to.
    """

    ipa: str
    labels: tuple[str, ...]
    alone: bool
    count: int
    rare: bool
    example: str
    proposal: Proposal

    @property
    def review(self) -> str:
        """Why a person must look at it; nothing when all agree. All of it is a proposal, in any case."""
        reasons = [note for note in self.proposal.reason.split("; ") if note.startswith(REVIEW)]
        if self.proposal.review and not reasons:
            reasons.append(f"{REVIEW} the rule is not sure")
        if self.rare:
            reasons.append(f"{REVIEW} heard only {self.count}x")
        if not self.alone:
            reasons.append(f"{REVIEW} heard only within {self.labels[0]!r}")
        return "; ".join(reason.removeprefix(REVIEW).strip() for reason in reasons)

    @property
    def reason(self) -> str:
        """The reason of the mapping with its confidence, as a sentence without its end."""
        reason = "; ".join(note for note in self.proposal.reason.split("; ") if not note.startswith(REVIEW))
        return f"{reason[:1].upper()}{reason[1:]} ({self.proposal.confidence:g})"

    @property
    def comment(self) -> str:
        """The reason, after what must be reviewed."""
        return f"{REVIEW} {self.review}. {self.reason}" if self.review else self.reason

    def to_row(self) -> dict[str, Any]:
        """Plain data for a listing."""
        return {
            "phone": self.ipa,
            "labels": list(self.labels),
            "common": list(self.proposal.common),
            "confidence": self.proposal.confidence,
            "heard": self.count,
            "example": self.example,
            "review": self.review,
        }


@dataclass(frozen=True, slots=True)
class Proposed:
    """The phones of a language, the *readings* of its labels, and the labels of which nothing is known (*strange*)."""

    phones: tuple[Phone, ...]
    readings: tuple[Reading, ...]
    strange: tuple[str, ...]


def propose_phones(heard: Counter[str], examples: Mapping[str, str], records: Records) -> Proposed:
    """Phones for the labels that were *heard*, with *examples* (label → word), mapped as in the languages of *records* or by rule."""
    tonal = has_tones(heard)
    readings = [read_espeak(label, tonal=tonal) for label in sorted(heard)]
    of: dict[str, list[Reading]] = {}
    for reading in readings:
        for segment in reading.segments:
            of.setdefault(segment, []).append(reading)
    known, common = precedents(records), records.get("common.tsv", {})
    phones, strange = [], [reading.label for reading in readings if not reading.segments]
    for segment, found in sorted(of.items()):
        proposal = judged(segment, records, known)
        # A label of this phone alone, heard often, shows it best.
        found.sort(key=lambda reading: (not reading.plain, len(reading.segments), -heard[reading.label], reading.label))
        labels = tuple(dict.fromkeys(reading.label for reading in found))
        if not proposal.common or any((name,) not in common for name in proposal.common):
            strange += labels
            continue
        count = sum(heard[label] for label in labels)
        alone, rare = found[0].plain, count < RARE * heard.total()
        phones.append(Phone(segment, labels, alone, count, rare, examples[labels[0]], proposal))
    return Proposed(tuple(phones), tuple(reading for reading in readings if reading.segments), tuple(strange))


def phone_rows(proposed: Proposed, *, author: str, time: str) -> Iterator[dict[str, str]]:
    """Rows of ``phones.tsv``."""
    for phone in proposed.phones:
        yield {
            "phone": phone.ipa,
            "kind": "vowel" if read_segment(phone.ipa).letters[0].vowel else "consonant",
            "ipa": phone.ipa,
            "common": " ".join(phone.proposal.common),
            "example": phone.example,
            "origin": "generated",
            "source": "espeak",
            "licence": "Apache-2.0",
            "author": author,
            "time": time,
            "comment": phone.comment,
        }


def alias_rows(proposed: Proposed, records: Records) -> Iterator[dict[str, str]]:
    """Rows of ``aliases.tsv``: espeak's labels, affricates with a tie bar, and X-SAMPA."""
    there = {phone.ipa for phone in proposed.phones}
    known = [reading for reading in proposed.readings if there.issuperset(reading.segments)]
    for reading in known:
        comment = f"{REVIEW} read as {' '.join(reading.segments)}, but {reading.strange} is no IPA" if reading.strange else ""
        yield _alias("espeak", unicodedata.normalize("NFC", reading.bare), reading.segments, "espeak", comment)
    # A tone that is written as a number is read as one; the third looks like a vowel, so it must be listed with every vowel.
    for tone in sorted({reading.tone for reading in known if THIRD in reading.tone}):
        for reading in known:
            if read_segment(reading.segments[0]).letters[0].vowel:
                comment = f"Tone {tone.replace(THIRD, '3')} of espeak"
                yield _alias("espeak", unicodedata.normalize("NFC", reading.bare + tone), reading.segments, "espeak", comment)
    taken: set[str] = set()
    for phone in proposed.phones:
        letters = read_segment(phone.ipa).letters
        if len(letters) == 2 and not letters[0].vowel and not letters[0].tied:
            tied = unicodedata.normalize("NFC", phone.ipa[: len(letters[0].text)] + _TIE + phone.ipa[len(letters[0].text) :])
            yield _alias("ipa", tied, (phone.ipa,), "ipa2020", "")
        spelled = xsampa(phone.ipa, records)
        if spelled and spelled not in taken and spelled != SILENCE:
            taken.add(spelled)
            yield _alias("xsampa", spelled, (phone.ipa,), "wells1997", "")


def _alias(notation: str, symbol: str, phones: Sequence[str], source: str, comment: str) -> dict[str, str]:
    return {"notation": notation, "symbol": symbol, "phones": " ".join(phones), "source": source, "comment": comment}


def table(path: str, rows: Iterable[dict[str, str]]) -> dict[Key, Row]:
    """*rows* of the table at *path* in canonical form; of equal keys the first."""
    kind = table_of(path)
    assert kind is not None
    found: dict[Key, Row] = {}
    for cells in rows:
        row = canonical_row(kind, cells)
        found.setdefault(key_of(kind, row), row)
    return found
