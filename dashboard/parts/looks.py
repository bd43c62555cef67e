"""Colours that follow the theme of the visitor's browser (Okabe and Ito 2008: everybody can tell them apart)."""

from __future__ import annotations

import streamlit as st

INK = {"light": "#0e1016", "dark": "#fafafa"}
"""Letters. Captions are drawn with six tenths of it: the contrast is 5.0, that of Streamlit's own on a light page 3.7."""
BLUE = {"light": "#0072b2", "dark": "#3d9ad6"}
"""Lines, and what is chosen: Okabe and Ito's own is too dark for a dark page, and red, Streamlit's, looks like danger on Save."""


def theme() -> str:
    """What the visitor's browser shows: "light" or "dark"."""
    return st.context.theme.type or "light"


def dark() -> bool:
    """Whether the visitor's browser shows the dark theme."""
    return theme() == "dark"


def blue() -> str:
    """The blue of lines."""
    return BLUE[theme()]


def ink() -> str:
    """The colour of letters."""
    return INK[theme()]
