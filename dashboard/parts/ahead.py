"""What other pages are drawn with, fetched while the first one is looked at."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import streamlit as st

PARTS = ("Button", "Checkbox", "Multiselect", "Metric", "DataFrame", "ArrowVegaLiteChart", "vega-interpreter", "embed", "remark-emoji")
"""Scripts of Streamlit that the browser fetches when a page first shows something of the kind, a second of that page where it is slow."""
SCRIPTS = Path(st.__file__).parent / "static" / "static" / "js"
ALONE, PATIENCE = 4000, 500
"""Milliseconds that the first page has for itself, and that each script waits at most for a moment in which nothing else is to do."""

# What does not come, or is not there in another Streamlit, is fetched when it is needed, as if nobody had asked.
_SCRIPT = """
(names, alone, timeout) => {
  if (window.lipdbAhead) return;
  window.lipdbAhead = [];
  const folder = document.querySelector('script[type="module"][src*="/static/js/"]')?.src;
  const idle = window.requestIdleCallback ?? setTimeout;
  const next = ([name, ...others]) => {
    if (!folder || !name) return;
    const fetched = () => import(new URL(name, folder)).then(() => window.lipdbAhead.push(name), () => {});
    idle(() => fetched().then(() => next(others)), { timeout });
  };
  setTimeout(() => next(names), alone);
}
"""


@cache
def parts() -> list[str]:
    """The files of `PARTS` that this Streamlit has; their names carry a digest of what is in them."""
    return [file.name for part in PARTS for file in sorted(SCRIPTS.glob(f"{part}.*.js"))]


def fetch_ahead() -> None:
    """Let the browser fetch what it will need on other pages. Nothing is to be seen of it."""
    st.html(f"<script>({_SCRIPT})({json.dumps(parts())}, {ALONE}, {PATIENCE})</script>", unsafe_allow_javascript=True)
