"""Tables of rows that a visitor edits: they stay as the visitor left them until they are saved or discarded.

They outlive other sections, other pages and what others save meanwhile, and never meet another visitor's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, Literal

import pandas as pd
import streamlit as st
from parts.conflict import Choice, save_or_ask
from parts.leaving import lost_by_leaving
from parts.lines import state
from parts.saved import tell
from parts.session import Edited, database, in_words, visitor

from lipdb import Database
from lipdb.curated.tsv import Key, Row
from lipdb.errors import LipdbError, SchemaVersionError

Rows = Mapping[tuple[str, Key], Row | None]
"""What is to be saved, by table and key; None takes a row away."""
Cells = list[dict[str, Any]]
"""A table as a visitor edits it, row by row."""

HELD = "rows_held"
_TURNS = count(1)


@dataclass
class Held:
    """What one visitor does to some *tables*, which were read at revision *seen*: they have them as *edited* now.

    The browser counts its edits from what it *began* with; a table that begins anew gets another *turn*.
    """

    title: str
    seen: int
    tables: dict[str, Cells]
    edited: dict[str, Cells] = field(default_factory=dict)
    began: dict[str, Cells] = field(default_factory=dict)
    turns: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for which, cells in self.tables.items():
            self.put(which, cells)

    def put(self, which: str, cells: Cells) -> None:
        """Let the visitor have *cells* as the table *which*."""
        self.edited[which] = self.began[which] = cells
        self.turns[which] = next(_TURNS)

    def widget(self, which: str) -> str:
        """The key of the browser's table."""
        return f"rows_{which}_{self.turns[which]}"

    @property
    def changed(self) -> bool:
        """Whether something is not saved, as far as the browser has told."""
        told = (st.session_state.get(self.widget(which), {}) for which in self.tables)
        return self.edited != self.tables or any(one.get(part) for one in told for part in ("edited_rows", "added_rows", "deleted_rows"))

    @property
    def base(self) -> Database:
        """The database that the tables were read from: what differs from it is the visitor's, and nobody else's."""
        return database() if self.seen == database().store.revision else state(self.seen)


def hold(name: str, title: str, load: Callable[[], dict[str, Cells]]) -> Held:
    """The tables that the editor *name* works on, called *title*: read anew when the data have changed and the visitor has not."""
    mine: dict[str, Held] = st.session_state.setdefault(HELD, {})
    now = database().store.revision
    if name not in mine or (mine[name].seen != now and not mine[name].changed):
        mine[name] = Held(title, now, load())
    return mine[name]


@lost_by_leaving
def unsaved(*, other_than: str = "") -> list[str]:
    """What the visitor has changed and not saved, in editors *other than* the one called so."""
    return [held.title for name, held in st.session_state.get(HELD, {}).items() if name != other_than and held.changed]


def table(held: Held, which: str, columns: Mapping[str, Any], *, rows: Literal["fixed", "dynamic"]) -> Cells:
    """An editable table of *held*, locked for who may not edit; its rows as the visitor has them now, without empty ones."""
    if held.widget(which) not in st.session_state:  # another page or section was shown, and the browser has forgotten its edits
        held.put(which, held.edited[which])
    edited = st.data_editor(
        pd.DataFrame(held.began[which], columns=list(columns)),
        column_config=dict(columns),
        num_rows=rows if visitor().editor else "fixed",
        hide_index=True,
        disabled=not visitor().editor,
        key=held.widget(which),
        placeholder="",
    )
    plain = edited.astype(object).where(edited.notna(), None).to_dict("records")
    held.edited[which] = [
        {str(name): cell for name, cell in row.items()} for row in plain if any(cell not in (None, "") for cell in row.values())
    ]
    return held.edited[which]


def save_button(name: str, held: Held, rows: Rows, *, note: str) -> None:
    """Save *rows*, with a note of the visitor's; nothing for who may not edit."""
    if not visitor().editor:
        st.caption("You may look, but not change.")
        return
    left, middle, right = st.columns([4, 1, 1], vertical_alignment="bottom")
    given = left.text_input("Note", key=f"{name}_note", placeholder=note, persist_state="session")
    saved = middle.button("Save", key=f"{name}_save", type="primary", disabled=not rows, width="stretch")
    if right.button("Discard", key=f"{name}_discard", disabled=not held.changed, width="stretch"):
        drop(name)
        st.rerun()
    if saved:
        save_rows(rows, note=given.strip() or note, seen=held.seen, name=name)


def save_rows(rows: Rows, *, note: str, seen: int, name: str) -> None:
    """Save *rows* of the editor *name* and begin anew; when somebody saved one of them since *seen*, ask what is to stay.

    What can't be saved is told here, and the page goes on: its face stays.
    """

    def after(choice: Choice, revision: int | None) -> None:
        if choice == "edit":
            return
        drop(name)
        tell(name, f"Saved as revision {revision}." if revision else "Nothing is left to save.", revision)

    try:
        save_or_ask([Edited(path, key, row) for (path, key), row in rows.items()], note=note, seen=seen, after=after)
    except SchemaVersionError:  # nothing of the page counts any more
        raise
    except LipdbError as error:
        st.error(in_words(error), icon=":material/error:")
    else:
        st.rerun()


def drop(name: str) -> None:
    """Forget what the visitor has not saved in the editor *name*."""
    st.session_state.get(HELD, {}).pop(name, None)
    st.session_state.pop(f"{name}_note", None)


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
