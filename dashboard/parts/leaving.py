"""Whether the visitor would lose something by leaving: then the browser asks first, or says what was lost (page.js)."""

from __future__ import annotations

import json
from collections.abc import Callable
from secrets import token_hex
from typing import TypeVar

import streamlit as st

SESSION = "leaving_session"
_ASKED: list[Callable[[], object]] = []
Unsaved = TypeVar("Unsaved", bound=Callable[..., object])


def lost_by_leaving(unsaved: Unsaved) -> Unsaved:
    """Count what *unsaved* finds as lost by leaving. A module that nobody has imported has nothing unsaved."""
    _ASKED.append(unsaved)
    return unsaved


def tell_browser() -> None:
    """Tell the browser what it has to know before it leaves. Pages whose parts run alone call it there too."""
    # A server that was started anew, or has forgotten a visitor who was away, begins a session of another name.
    session = st.session_state.setdefault(SESSION, token_hex())
    unsaved = any(found() for found in _ASKED)
    st.html(f"<script>lipdbUnsaved({json.dumps([session, unsaved])})</script>", unsafe_allow_javascript=True)
