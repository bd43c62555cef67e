"""Editing one row of a language: what is typed outlives other pages, and is saved against the revision that was seen."""

from __future__ import annotations

import streamlit as st
from parts.conflict import Choice, save_or_ask
from parts.leaving import lost_by_leaving
from parts.session import Edited, database

SAVED = "languages_saved"


def seen(place: str) -> int:
    """The revision at which the visitor began to edit at *place*: what is saved in between is a conflict.

    A place is ``phone``, a language and a phone of it, or ``alias``, a language, a notation and a symbol, with a space between each: no
    name has one, so no place begins as another's fields do.
    """
    begun: dict[str, int] = st.session_state.setdefault("languages_seen", {})
    return begun.setdefault(place, database().store.revision)


def forget(place: str) -> None:
    """Begin anew at *place*: its fields show what is saved."""
    st.session_state.get("languages_seen", {}).pop(place, None)
    for name in [name for name in st.session_state if str(name).startswith(f"{place} ")]:
        del st.session_state[name]


def fill(place: str, fields: dict[str, object]) -> None:
    """Show *fields*, unless the visitor has typed something there that is not saved yet."""
    kept = st.session_state.setdefault(f"{place} from", fields)
    if kept != fields and not _typed(place):
        forget(place)
        st.session_state[f"{place} from"] = fields
    seen(place)
    for name, value in fields.items():
        st.session_state.setdefault(f"{place} {name}", value)


def _typed(place: str) -> bool:
    """Whether the visitor has something else there than what was saved when they began."""
    kept: dict[str, object] = st.session_state.get(f"{place} from", {})
    return any(st.session_state.get(f"{place} {name}", value) != value for name, value in kept.items())


@lost_by_leaving
def unsaved() -> list[str]:
    """What the visitor has typed and not saved: ``phone ZH of en``."""
    places = [place.split(" ") for place in st.session_state.get("languages_seen", {}) if _typed(place)]
    return [" ".join([kind, *filter(None, row), "of", code]) for kind, code, *row in places]


def picked(key: str, names: list[str], target: str) -> None:
    """Take over the row of the table *key* that was clicked on into the widget *target*; *names* are its rows."""
    rows = st.session_state[key].selection.rows
    if rows:
        st.session_state[target] = names[rows[0]]


def save_one(edit: Edited, *, note: str, place: str, what: str) -> None:
    """Save *edit* as the visitor saw it at *place*, or ask when somebody was first; *what* says what was done."""
    begun = seen(place)

    def after(choice: Choice, revision: int | None) -> None:
        if choice == "edit":
            return
        forget(place)
        st.session_state[SAVED] = (
            f"Revision {revision}: {what}." if revision else "Nothing was changed." if choice == "mine" else "Theirs stays."
        )

    save_or_ask([edit], note=note, seen=begun, after=after)
    st.rerun()
