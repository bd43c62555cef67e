"""Colours of charts that follow the theme of the visitor's browser (Okabe and Ito 2008: everybody can tell them apart)."""

from __future__ import annotations

import streamlit as st


def dark() -> bool:
    """Whether the visitor's browser shows the dark theme."""
    return st.context.theme.type == "dark"


def blue() -> str:
    """The blue of lines: Okabe and Ito's own is too dark for a dark page."""
    return "#3d9ad6" if dark() else "#0072b2"


def ink() -> str:
    """The colour of letters."""
    return "#fafafa" if dark() else "#31333f"
