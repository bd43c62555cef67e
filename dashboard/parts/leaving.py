"""Whether the visitor would lose something by leaving: then the browser asks first (page.js)."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import TypeVar

import streamlit as st

_ASKED: list[Callable[[], object]] = []
Unsaved = TypeVar("Unsaved", bound=Callable[..., object])


def lost_by_leaving(unsaved: Unsaved) -> Unsaved:
    """Count what *unsaved* finds as lost by leaving. A module that nobody has imported has nothing unsaved."""
    _ASKED.append(unsaved)
    return unsaved


def tell_browser() -> None:
    """Tell the browser whether anything of the visitor is unsaved. Pages whose parts run alone call it there too."""
    unsaved = any(found() for found in _ASKED)
    st.html(f"<script>lipdbUnsaved({json.dumps(unsaved)})</script>", unsafe_allow_javascript=True)
