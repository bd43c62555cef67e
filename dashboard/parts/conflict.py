"""Somebody else saved the same first: a dialog that shows both versions and asks which one is to stay."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import streamlit as st
from parts.lines import state
from parts.session import Edited, save, shown_errors
from parts.versions import curves_chart

from lipdb.curated.tsv import Row
from lipdb.curves.keys import Keys, parse_keys
from lipdb.store.conflict import EditConflictError, Versions

Choice = Literal["mine", "theirs", "edit"]
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
    ``theirs`` (the visitor's other rows are saved all the same) or ``edit`` (nothing was saved). Raises `LipdbError`.
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
    rows = "row" if len(error.conflicts) == 1 else "rows"
    what = f"{len(error.conflicts)} {rows} that you changed too, in revision {error.revision}"
    st.write(f"{error.author} changed {what}. Nothing of yours is saved yet.")
    for versions in error.conflicts:
        _both(versions, asked.seen)
    left, middle, right = st.columns(3)
    lost = {(one.path, one.key) for one in error.conflicts}
    with shown_errors():
        if left.button("Save mine over theirs", key="conflict_mine", width="stretch"):
            _answer(asked, "mine", asked.edits)
        if middle.button("Keep theirs", key="conflict_theirs", width="stretch", help="Your other changes are saved."):
            _answer(asked, "theirs", [one for one in asked.edits if (one.table, one.key) not in lost])
        if right.button("Go on editing", key="conflict_edit", width="stretch", help="Nothing is saved; your version stays in the editor."):
            _answer(asked, "edit", ())


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
    name = " ".join(versions.key)
    if "/curves/" in f"/{versions.path}":
        before = state(seen).records.get(versions.path, {}).get(versions.key)
        drawn = {"mine": versions.mine, "theirs": versions.theirs, "before": before}
        st.altair_chart(curves_chart(name, {who: _keys(row) for who, row in drawn.items()}), width="stretch")
        absent = [who for who, row in (("yours", versions.mine), ("theirs", versions.theirs)) if row is None]
        if absent:
            st.caption(f"{' and '.join(absent)} {ABSENT}")
        return
    st.write(f"**{name}** ({versions.path})")
    columns = dict.fromkeys([*(versions.mine or {}), *(versions.theirs or {})])
    cells = [
        {"": who, **{column: (row or {}).get(column, ABSENT) for column in columns}}
        for who, row in (("yours", versions.mine), ("theirs", versions.theirs))
    ]
    st.dataframe(cells, hide_index=True)


def _keys(row: Row | None) -> Keys | None:
    return parse_keys(row["keys"]) if row else None
