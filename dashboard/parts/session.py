"""What all pages share: the database, who visits and what they may do, how errors are shown and edits are saved."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import streamlit as st

import lipdb
from lipdb import Database
from lipdb.curated.tsv import Key, Row
from lipdb.errors import LipdbError, SchemaVersionError

NAME = "visitor"


@st.cache_resource
def database() -> Database:
    """The database that `lipdb dashboard` was started with: one for all visitors."""
    return lipdb.open(os.environ.get("LIPDB_URL"), phonesets=os.environ.get("LIPDB_PHONESETS"))


@dataclass(frozen=True, slots=True)
class Visitor:
    """Who is here, and whether they may change anything."""

    name: str
    editor: bool


def sign_in_configured() -> bool:
    """Whether visitors sign in (section ``[auth]`` of Streamlit's secrets)."""
    return _secret("auth") is not None


def visitor() -> Visitor:
    """Who is here.

    Without sign-in everybody on this machine may edit, under the name they give. With it, those whose e-mail address stands
    in ``editors`` of section ``[lipdb]`` of the secrets may edit, and all others look.
    """
    if not sign_in_configured():
        return Visitor(st.session_state.get(NAME, ""), editor=True)
    if not st.user.is_logged_in:
        return Visitor("", editor=False)
    address = str(st.user.get("email") or "")
    editors = (_secret("lipdb") or {}).get("editors", [])
    return Visitor(address, editor=bool(address) and address in editors)


def _secret(section: str) -> dict[str, object] | None:
    try:
        found = st.secrets.get(section)
    except FileNotFoundError:
        return None
    return dict(found) if found else None


def greet() -> None:
    """Who is here, in the side bar, and a way to sign in or to say one's name. Stops the page for who has to sign in."""
    with st.sidebar:
        if not sign_in_configured():
            st.text_input("Your name", key=NAME, help="It stands beside every change that you save.", placeholder="for the history")
            return
        if st.user.is_logged_in:
            who = visitor()
            st.write(f"{who.name} ({'editor' if who.editor else 'viewer'})")
            st.button("Sign out", on_click=st.logout)
            return
    st.title("lipdb")
    st.write("Sign in to see lines, curves and coverage.")
    st.button("Sign in", type="primary", on_click=st.login)
    st.stop()


@contextmanager
def shown_errors() -> Iterator[None]:
    """Show an error that a visitor can mend as a message, and stop the page there."""
    try:
        yield
    except SchemaVersionError:
        st.error("The database was upgraded while this page was open. Restart `lipdb dashboard` with the newer lipdb, then reload.")
        st.stop()
    except LipdbError as error:
        st.error(str(error), icon=":material/error:")
        st.stop()


@dataclass(frozen=True, slots=True)
class Edited:
    """One row to save: None as *row* takes it away."""

    table: str
    key: Key
    row: Row | None


def save(edits: Sequence[Edited], *, note: str, seen: int) -> int | None:
    """Save *edits* as one revision under the visitor's name; its number, None when nothing changed.

    *seen* is the revision that the page showed. Raises `EditConflictError` when somebody saved the same since, and
    `LipdbError` for what can't be saved, and for a visitor who may not: every write of every page goes through here.
    """
    who = visitor()
    if not who.editor:
        raise LipdbError("you may look, but not change; ask an editor, or to be made one")
    if not who.name.strip():
        raise LipdbError("who are you? Give your name in the side bar; it stands beside every change")
    with database().edit(author=who.name, note=note) as edit:
        for one in edits:
            if one.row is None:
                edit.delete(one.table, one.key, expected_revision=seen)
            else:
                edit.put(one.table, one.row, expected_revision=seen)
    return edit.revision
