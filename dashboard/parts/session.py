"""What all pages share: the database to look at, who visits and what they may do, and the one gate that every write goes through."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass

import streamlit as st
from parts.upgrade import warn_of_upgrade

import lipdb
from lipdb import Database
from lipdb.curated.tsv import Key, Row
from lipdb.errors import LipdbError, SchemaVersionError

NAME = "visitor"


@st.cache_resource(show_spinner=False)
def _writable() -> Database:
    return lipdb.open(os.environ.get("LIPDB_URL"), phonesets=os.environ.get("LIPDB_PHONESETS"))


@st.cache_resource(show_spinner=False)
def shared() -> Database:
    """The one view of all visitors. Pages ask `database` for it, which looks at who asks."""
    return _writable().read_only()


def database() -> Database:
    """The database that `lipdb dashboard` was started with, to look at: one for all visitors.

    Every way to write through it raises `StoreError`, whoever asks; see `save` and `writable`. Raises `LipdbError` for who
    has to sign in first.
    """
    if not visitor().reader:
        raise LipdbError("sign in to see this; with another address, if yours is not let in")
    return shared()


@dataclass(frozen=True, slots=True)
class Visitor:
    """Who is here, and whether they may change anything, or look at all."""

    name: str
    editor: bool
    reader: bool = True


def sign_in_configured() -> bool:
    """Whether visitors sign in (section ``[auth]`` of Streamlit's secrets)."""
    return _secret("auth") is not None


def visitor() -> Visitor:
    """Who is here.

    Without sign-in everybody on this machine may edit, under the name they give. With it, those whose e-mail address stands
    in ``editors`` of section ``[lipdb]`` of the secrets may edit. All others who are signed in may look; with ``viewers``
    there too, only those whose address stands in it.
    """
    if not sign_in_configured():
        return Visitor(st.session_state.get(NAME, "").strip(), editor=True)
    if not st.user.is_logged_in:
        return Visitor("", editor=False, reader=False)
    address = str(st.user.get("email") or "")
    # A provider says so when anybody could have typed this address.
    if not address or st.user.get("email_verified") is False:
        return Visitor(address, editor=False, reader=_addresses("viewers") is None)
    editors, viewers = _addresses("editors") or set(), _addresses("viewers")
    editor = address.casefold() in editors
    return Visitor(address, editor, editor or viewers is None or address.casefold() in viewers)


def _addresses(role: str) -> set[str] | None:
    """The addresses that the secrets list for *role*; None when they list none."""
    listed = (_secret("lipdb") or {}).get(role)
    if listed is None:
        return None
    return {str(one).casefold() for one in ([listed] if isinstance(listed, str) else listed)}  # type: ignore[attr-defined]


def _secret(section: str) -> dict[str, object] | None:
    try:
        found = st.secrets.get(section)
    except FileNotFoundError:
        return None
    return dict(found) if found else None


def greet() -> None:
    """Who is here, in the side bar, and a way to sign in or to say one's name. Stops the page for who has to sign in."""
    if not sign_in_configured():
        st.sidebar.text_input("Your name", key=NAME, help="It stands beside every change that you save.", placeholder="for the history")
    elif st.user.is_logged_in:
        who = visitor()
        role = "editor" if who.editor else "viewer" if who.reader else "not let in"
        st.sidebar.text(f"{who.name or 'No address'} ({role})")  # as it is: Markdown would make a link of it
        st.sidebar.button("Sign out", on_click=st.logout)
        if not who.reader:
            st.error("You may not look at this. Ask to be let in, or sign out and in again as somebody else.")
            st.stop()
    else:
        st.title("lipdb")
        st.write("Sign in to see lines, curves and coverage.")
        st.button("Sign in", type="primary", on_click=st.login)
        st.stop()
    with shown_errors():
        database().store.require_current()
    warn_of_upgrade()


def in_words(told: LipdbError | str) -> str:
    """An error or a note for people before a page: without what the command line is given, its options and ``text:``.

    The database is given to the command line alone, so ``--db`` stays.
    """
    return re.sub(r"(?<!\S)--(?=[a-z])(?!db\b)", "", str(told)).removeprefix("text: ")


def as_typed(text: str) -> str:
    """*text* of a visitor for where Streamlit reads Markdown: it is shown as it was typed."""
    return re.sub(r"([\\`*_\[\]<>~|$:#&])", r"\\\1", text)


@contextmanager
def shown_errors() -> Iterator[None]:
    """Show an error that a visitor can mend as a message, and stop the page there."""
    try:
        yield
    except SchemaVersionError:
        st.error(
            "The database was upgraded while this page was open. Nothing is saved any more: "
            "restart `lipdb dashboard` with the newer lipdb, then reload this page.",
            icon=":material/upgrade:",
        )
        st.stop()
    except LipdbError as error:
        st.error(in_words(error), icon=":material/error:")
        st.stop()


def writable() -> tuple[Database, str]:
    """The database to write to, and the name that stands beside the change: the only way to it, so the only gate.

    Raises `LipdbError` for a visitor who may not write, or has not said their name.
    """
    who = visitor()
    if not who.editor:
        raise LipdbError("you may look, but not change; ask an editor, or to be made one")
    if not who.name:
        raise LipdbError("who are you? Give your name in the side bar; it stands beside every change")
    return _writable(), who.name


@dataclass(frozen=True, slots=True)
class Edited:
    """One row to save: None as *row* takes it away. An *accepted* one becomes the visitor's own even if nothing in it changes."""

    table: str
    key: Key
    row: Row | None
    accepted: bool = False


def save(edits: Sequence[Edited], *, note: str, seen: int) -> int | None:
    """Save *edits* as one revision under the visitor's name; its number, None when nothing changed.

    *seen* is the revision that the page showed. Raises `EditConflictError` when somebody saved the same since, and
    `LipdbError` for what can't be saved, and for a visitor who may not.
    """
    db, author = writable()
    with db.edit(author=author, note=note) as edit:
        for one in edits:
            if one.row is None:
                edit.delete(one.table, one.key, expected_revision=seen)
            else:
                edit.put(one.table, one.row, expected_revision=seen, accepted=one.accepted)
    return edit.revision


def undo(number: int, *, note: str = "") -> int | None:
    """Take back revision *number* as a new revision; its number, None when nothing of it is left. Raises as `save` does."""
    db, author = writable()
    return db.store.undo(number, author=author, note=note)
