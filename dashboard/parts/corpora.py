"""Corpora to choose from: the scans of the register, and each language's own example sentences so that there is always one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import streamlit as st
from parts.session import database

from lipdb import Database
from lipdb.coverage.register import CURRENT, MISSING, state_of
from lipdb.coverage.reports.frequency import Frequency
from lipdb.coverage.reports.named import read_frequency
from lipdb.coverage.reports.script import Script, read_script
from lipdb.coverage.result import read_result
from lipdb.store.scans import Scan

SENTENCES = "example sentences"


@dataclass(frozen=True, slots=True)
class Corpus:
    """Something that was counted in *language*: a *scan* in a *state*, or without one the language's example sentences."""

    language: str
    title: str
    state: str = CURRENT
    scan: Scan | None = None

    @property
    def key(self) -> str:
        """It is found again by this."""
        return f"{self.language} {self.scan.id if self.scan else SENTENCES}"

    @property
    def label(self) -> str:
        """What a visitor chooses. The state is no part of it: a field lets go of what is called otherwise than when it was chosen."""
        if self.scan is None:
            return f"{self.language}: {self.title}"
        return f"{self.language}: {self.title} ({self.scan.mode}, {self.scan.totals['pairs']:,} pairs)"

    def frequency(self) -> Frequency:
        """How often each pair occurs in it. Raises `InputError` when its result can't be read any more."""
        if self.scan is None:
            return sentences(database(), self.language).frequency()
        return _scanned(self.scan.path, _changed(self.scan.path))


def corpora(languages: Sequence[str], *, every: bool = False) -> list[Corpus]:
    """What there is for *languages*: of each its scans, newest first, then its sentences.

    *every* takes in scans of which there is nothing to see: without pairs, or whose result is missing.
    """
    db, found = database(), []
    for language in languages:
        scans = [scanned(scan) for scan in db.store.scans(language)]
        found += [one for one in scans if every or (one.state != MISSING and one.scan and one.scan.totals["pairs"])]
        if db.records.get(f"{language}/sentences.tsv"):
            found.append(Corpus(language, SENTENCES))
    return found


def scanned(scan: Scan) -> Corpus:
    """The corpus that *scan* counted, as it is now."""
    state = state_of(database(), scan)
    title = "" if state == MISSING else _title(scan.path, _changed(scan.path))
    return Corpus(scan.language, title or ", ".join(Path(path).name for path in scan.corpus), state, scan)


def usual(offered: Sequence[Corpus]) -> list[str]:
    """The keys of those to begin with: of each language its newest scan that still holds, else its sentences."""
    first: dict[str, str] = {}
    for corpus in offered:
        if corpus.state == CURRENT:
            first.setdefault(corpus.language, corpus.key)
    return list(first.values())


@st.cache_resource(max_entries=32, show_spinner="Reading the example sentences…")
def _sentences(_db: Database, language: str, revision: int) -> Script:  # noqa: ARG001  (the revision decides)
    text = "\n".join(sentence for (sentence,) in _db.records[f"{language}/sentences.tsv"])
    return read_script(text, _db.voice(language), _db.phoneset(language))


def sentences(db: Database, language: str) -> Script:
    """The example sentences of *language*. Raises `InputError` when its voice can say none of them."""
    return _sentences(db, language, db.store.revision)


@st.cache_resource(max_entries=32, show_spinner=False)
def _scanned(path: str, changed: int) -> Frequency:  # noqa: ARG001  (the file decides)
    return read_frequency(Path(path))


@st.cache_data(max_entries=256, show_spinner=False)
def _title(path: str, changed: int) -> str:  # noqa: ARG001  (the file decides)
    try:
        return str(read_result(Path(path)).get("title", ""))
    except (OSError, ValueError):
        return ""


def _changed(path: str) -> int:
    try:
        return Path(path).stat().st_mtime_ns
    except OSError:
        return 0
