"""Somebody else saved the same first: a dialog that shows both versions and asks which one is to stay, for each row or for all."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import streamlit as st
from parts.lines import state
from parts.session import Edited, as_typed, save, shown_errors
from parts.versions import curves_chart

from lipdb.curated.tsv import Key, Row
from lipdb.curves.keys import Keys, parse_keys
from lipdb.store.conflict import EditConflictError, Versions
from lipdb.words import counted

Choice = Literal["mine", "theirs", "chosen", "edit"]
Place = tuple[str, Key]
MINE, THEIRS = "Mine", "Theirs"
ASKED = "conflict_asked"
ABSENT = "not there: the layer below counts"


@dataclass(frozen=True, slots=True)
class _Asked:
    edits: tuple[Edited, ...]
    note: str
    seen: int
    error: EditConflictError
    after: Callable[[Choice, int | None], None]


def save_or_ask(edits: Sequence[Edited], *, note: str, seen: int, after: Callable[[Choice, int | None], None]) -> None:
    """Save *edits* as `save` does; when somebody saved the same since *seen*, ask what is to stay.

    *after* is told in the end what was chosen and the revision that it made: ``mine`` (also when nobody was in the way),
    ``theirs`` (the visitor's other rows are saved all the same), ``chosen`` (row by row) or ``edit`` (nothing was saved).
    Raises `LipdbError`.
    """
    try:
        after("mine", save(edits, note=note, seen=seen))
    except EditConflictError as error:
        st.session_state[ASKED] = _Asked(tuple(edits), note, seen, error, after)
        st.rerun()


def ask_again() -> None:
    """Open the dialog while a question is not answered; pages call it once, before they show anything else."""
    if ASKED in st.session_state:
        _ask()


def _dismissed() -> None:
    st.session_state.pop(ASKED).after("edit", None)


@st.dialog("Somebody else saved first", width="large", on_dismiss=_dismissed)
def _ask() -> None:
    asked: _Asked = st.session_state[ASKED]
    error = asked.error
    several = len(error.conflicts) > 1
    what = f"{counted(len(error.conflicts), 'row')} that you changed too, in revision {error.revision}"
    st.write(f"{as_typed(error.author)} changed {what}. Nothing of yours is saved yet.")
    chosen = {}
    for number, versions in enumerate(error.conflicts):
        _both(versions, asked.seen)
        if several:
            key = f"conflict_{error.revision}_{number}"
            chosen[versions.path, versions.key] = st.segmented_control(
                "Which one stays", (MINE, THEIRS), key=key, label_visibility="collapsed"
            )
    if several:
        _save_chosen(asked, chosen)
    left, middle, right = st.columns(3)
    every = "all " * several
    with shown_errors():
        if left.button(f"Save {every}mine over theirs", key="conflict_mine", width="stretch"):
            _answer(asked, "mine", asked.edits)
        if middle.button(f"Keep {every}theirs", key="conflict_theirs", width="stretch", help="Your other changes are saved."):
            _answer(asked, "theirs", _without(asked, [(one.path, one.key) for one in error.conflicts]))
        if right.button("Go on editing", key="conflict_edit", width="stretch", help="Nothing is saved; your version stays in the editor."):
            _answer(asked, "edit", ())


def _save_chosen(asked: _Asked, chosen: Mapping[Place, str | None]) -> None:
    """The button for rows that were chosen one by one. None is chosen to begin with, so that none is lost unseen."""
    left = sum(choice is None for choice in chosen.values())
    label = f"Choose for {counted(left, 'more row')}" if left else "Save as chosen"
    with shown_errors():
        if st.button(label, key="conflict_chosen", type="primary", disabled=bool(left), help="Your other changes are saved too."):
            _answer(asked, "chosen", _without(asked, [place for place, choice in chosen.items() if choice == THEIRS]))


def _without(asked: _Asked, places: Collection[Place]) -> list[Edited]:
    return [one for one in asked.edits if (one.table, one.key) not in places]


def _answer(asked: _Asked, choice: Choice, edits: Sequence[Edited]) -> None:
    """Save what was chosen, over the versions that were shown and no newer ones; a third person's are asked about again."""
    seen = asked.error.revision
    try:
        revision = save(edits, note=asked.note, seen=seen) if edits else None
    except EditConflictError as error:
        st.session_state[ASKED] = _Asked(asked.edits, asked.note, seen, error, asked.after)
        st.rerun()
    del st.session_state[ASKED]
    asked.after(choice, revision)
    st.rerun()


def _both(versions: Versions, seen: int) -> None:
    """One row as both sides have it: curves as curves, other rows as a table."""
    if "/curves/" in f"/{versions.path}":
        st.write("**{}-{} {}**".format(*versions.key))
        before = state(seen).records.get(versions.path, {}).get(versions.key)
        drawn = {"mine": versions.mine, "theirs": versions.theirs, "before": before}
        st.altair_chart(curves_chart({who: _keys(row) for who, row in drawn.items()}), width="stretch")
        absent = [who for who, row in (("yours", versions.mine), ("theirs", versions.theirs)) if row is None]
        if absent:
            st.caption(f"{' and '.join(absent)} {ABSENT}")
        return
    st.write(f"**{' '.join(versions.key)}** ({versions.path})")
    columns = dict.fromkeys([*(versions.mine or {}), *(versions.theirs or {})])
    cells = [
        {"": who, **{column: (row or {}).get(column, ABSENT) for column in columns}}
        for who, row in (("yours", versions.mine), ("theirs", versions.theirs))
    ]
    st.dataframe(cells, hide_index=True)


def _keys(row: Row | None) -> Keys | None:
    return parse_keys(row["keys"]) if row else None
