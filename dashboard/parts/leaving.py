"""What the visitor would lose by leaving: the browser asks first (page.js), and says what a restart of the server took away."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from secrets import token_hex
from typing import TypeVar

import streamlit as st

SESSION = "leaving_session"
TOLD = (Path(__file__).parent / "leaving.js").read_text("utf-8")
_ASKED: list[Callable[[], list[str]]] = []
Unsaved = TypeVar("Unsaved", bound=Callable[..., list[str]])


def lost_by_leaving(unsaved: Unsaved) -> Unsaved:
    """Count what *unsaved* names as lost by leaving. A module that nobody has imported has nothing unsaved."""
    _ASKED.append(unsaved)
    return unsaved


def tell_browser() -> None:
    """Tell the browser what of the visitor's is unsaved now. Pages whose parts run alone call it there too."""
    # A server that was started anew, or has forgotten a visitor who was away, begins a session of another name.
    session = st.session_state.setdefault(SESSION, token_hex(8))
    unsaved = [name for found in _ASKED for name in found()]
    st.html(f"<script>({TOLD})({json.dumps([session, unsaved])})</script>", unsafe_allow_javascript=True)
