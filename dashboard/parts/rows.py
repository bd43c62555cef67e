"""Tables of rows that a visitor edits: they stay as the visitor left them until they are saved, whatever others save meanwhile."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import pandas as pd
import streamlit as st
from parts.conflict import Choice, save_or_ask
from parts.session import Edited, database, visitor

from lipdb.curated.tsv import Key, Row

Rows = Mapping[tuple[str, Key], Row | None]
"""What is to be saved, by table and key; None takes a row away."""

TOLD = "rows_told"


@dataclass(frozen=True, slots=True)
class Held:
    """What an editor shows, and the revision that it was read at."""

    seen: int
    tables: dict[str, list[dict[str, Any]]]


def hold(name: str, load: Callable[[], dict[str, list[dict[str, Any]]]]) -> Held:
    """The tables that the editor *name* works on: read anew when the data have changed and the visitor has not."""
    key, now = f"{name}_held", database().store.revision
    held: Held | None = st.session_state.get(key)
    if held is None or (held.seen != now and not any(_edited(name, held, table) for table in held.tables)):
        held = st.session_state[key] = Held(now, load())
    return held


def table(name: str, held: Held, which: str, columns: Mapping[str, Any], *, rows: Literal["fixed", "dynamic"]) -> list[dict[str, Any]]:
    """An editable table of *held*, locked for who may not edit; its rows as the visitor has them now, without empty ones."""
    edited = st.data_editor(
        pd.DataFrame(held.tables[which], columns=list(columns)),
        column_config=dict(columns),
        num_rows=rows,
        hide_index=True,
        disabled=not visitor().editor,
        key=_widget(name, held, which),
    )
    plain = edited.astype(object).where(edited.notna(), None).to_dict("records")
    return [row for row in plain if any(cell not in (None, "") for cell in row.values())]


def save_button(name: str, held: Held, rows: Rows, *, note: str) -> None:
    """Save *rows*, with a note of the visitor's; nothing for who may not edit."""
    if not visitor().editor:
        st.caption("You may look, but not change.")
        return
    left, middle, right = st.columns([4, 1, 1], vertical_alignment="bottom")
    given = left.text_input("Note", key=f"{name}_note", placeholder=note)
    saved = middle.button("Save", key=f"{name}_save", type="primary", disabled=not rows, width="stretch")
    if right.button("Discard", key=f"{name}_discard", disabled=not rows, width="stretch"):
        drop(name)
        st.rerun()
    if saved:
        save_rows(rows, note=given.strip() or note, seen=held.seen, name=name)


def save_rows(rows: Rows, *, note: str, seen: int, name: str = "") -> None:
    """Save *rows* and begin anew; when somebody saved one of them since *seen*, ask what is to stay."""

    def after(choice: Choice, revision: int | None) -> None:
        if choice == "edit":
            return
        if name:
            drop(name)
        st.session_state[TOLD] = f"Saved as revision {revision}." if revision else "Nothing is left to save."

    count = st.session_state.get(TOLD)
    save_or_ask([Edited(path, key, row) for (path, key), row in rows.items()], note=note, seen=seen, after=after)
    if st.session_state.get(TOLD) != count:
        st.rerun()


def told() -> None:
    """Say once that something was saved."""
    if text := st.session_state.pop(TOLD, ""):
        st.success(text, icon=":material/check:")


def drop(name: str) -> None:
    """Forget what the visitor has not saved."""
    held = st.session_state.pop(f"{name}_held", None)
    for which in held.tables if held else ():
        st.session_state.pop(_widget(name, held, which), None)
    st.session_state[f"{name}_times"] = st.session_state.get(f"{name}_times", 0) + 1


def _widget(name: str, held: Held, which: str) -> str:
    return f"{name}_{which}_{held.seen}_{st.session_state.get(f'{name}_times', 0)}"


def _edited(name: str, held: Held, which: str) -> bool:
    state = st.session_state.get(_widget(name, held, which), {})
    return any(state.get(part) for part in ("edited_rows", "added_rows", "deleted_rows"))


def text(cell: Any) -> str:
    """A cell as the curated tables have it."""
    return "" if cell is None else f"{cell:g}" if isinstance(cell, float) else str(cell)


def changed(before: Mapping[Key, Row], after: Mapping[Key, Row], path: str) -> dict[tuple[str, Key], Row | None]:
    """The rows of the table at *path* that differ."""
    gone: dict[tuple[str, Key], Row | None] = {(path, key): None for key in before if key not in after}
    return gone | {(path, key): row for key, row in after.items() if row != before.get(key)}


def names(rows: Sequence[Row], column: str) -> dict[str, str]:
    """Names with their titles, from rows of languages or characters."""
    return {row[column]: row.get("title") or row.get("name") or row[column] for row in rows}
