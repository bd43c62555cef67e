"""The language that a visitor is adding: it outlives reruns and other pages, and never meets another visitor's."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path
from typing import Any

import streamlit as st
from parts.leaving import lost_by_leaving
from parts.session import database, in_words, visitor
from parts.stage import stage

from lipdb.curated.tsv import Key, Row
from lipdb.database import DEFAULT_CHARACTER, Database
from lipdb.errors import LipdbError
from lipdb.languages.draft import Draft
from lipdb.languages.trial import Checked, Trial, perform
from lipdb.performance import Performance
from lipdb.progress import reported

WORK, STEP, HEARD = "languages_work", "languages_step", "languages_heard"
MOST_HEARD = 12
STEPS = ("1 Language", "2 Phones", "3 Common phones", "4 Check", "5 Save")
_TOKENS = count(1)


@dataclass
class Work:
    """A *draft* with the database's revision that it was *seen* against, the *phone* that is looked at, and what came of it."""

    draft: Draft
    seen: int
    phone: str
    token: int = field(default_factory=lambda: next(_TOKENS))
    checked: tuple[str, Checked] | None = None
    files: list[Path] = field(default_factory=list)
    revision: int | None = None

    @property
    def kept(self) -> bool:
        """Whether it was saved, as text or into the database."""
        return bool(self.files or self.revision)

    def own(self) -> dict[str, dict[Key, Row]]:
        """The rows of the draft, as they would be saved now."""
        return self.draft.tables(database().records, author=visitor().name)

    def trial(self) -> Trial:
        """The database with the draft in it."""
        return Trial(database(), self.own())

    def key(self, name: str) -> str:
        """The key of a widget that belongs to this draft."""
        return f"languages_{self.token}_{name}"


def work() -> Work | None:
    """What the visitor is working on."""
    found: Work | None = st.session_state.get(WORK)
    return found


@lost_by_leaving
def unsaved() -> list[str]:
    """The language that the visitor is adding, if it is kept nowhere yet."""
    mine = work()
    return [f"language {mine.draft.row['name']}"] if mine and not mine.kept else []


def begin(draft: Draft) -> None:
    """Work on *draft*, and go on to its phones."""
    st.session_state[WORK] = Work(draft, database().store.revision, draft.in_order()[0].phone.ipa)
    go(STEPS[1])


def go(step: str) -> None:
    """Go to *step* in the next run: a widget that is shown already can't be set."""
    st.session_state["languages_go"] = step


def digest(own: object) -> str:
    """Equal for equal rows."""
    return hashlib.sha256(repr(own).encode()).hexdigest()


def hear(db: Database, mark: str, text: str, language: str, *, key: str) -> None:
    """The voice says *text* and the face with it; an error is shown in place. *mark* is equal for equal data."""
    kept: dict[Any, Performance] = st.session_state.setdefault(HEARD, {})
    asked = (mark, text, language)
    try:
        if asked not in kept:
            kept[asked] = perform(db, text, language=language, character=DEFAULT_CHARACTER)
            while len(kept) > MOST_HEARD:
                kept.pop(next(iter(kept)))
    except LipdbError as error:
        st.caption(f":material/error: {in_words(error)}")
        return
    made = kept[asked]
    stage([made], key=key, compact=True)
    if made.line is not None:
        said = ", ".join(f"{phone.symbol} → {' '.join(phone.common)}" for phone in made.line.schedule.phones if not phone.silent)
        st.caption(f"**{text}** is said {said}")
        for note in made.line.notes:
            st.caption(f":material/info: {in_words(note)}")


@contextmanager
def progress(what: str) -> Iterator[None]:
    """Show how far the long work inside the block is."""
    bar = st.progress(0.0, f"{what}…")

    def show(doing: str, done: int, total: int) -> None:
        if done == total or done % max(total // 50, 1) == 0:
            bar.progress(min(done / max(total, 1), 1.0), f"{what}: {doing}, {done} of {total}")

    try:
        with reported(show):
            yield
    finally:
        bar.empty()


@contextmanager
def told() -> Iterator[None]:
    """Show an error that the visitor can mend, and go on with the page."""
    try:
        yield
    except LipdbError as error:
        st.error(in_words(error), icon=":material/error:")
