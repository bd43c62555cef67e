"""Tables of pairs, a click into which opens the pair in Curves; and widgets that come back as they were left."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import Any

import pandas as pd
import streamlit as st

KEPT = "coverage_kept"
ROW, MOST = 35, 560
"""Pixels of a row, and of a table at most."""


def keep(key: str, value: Any, *, among: Collection[Any] = ()) -> str:
    """*key* of a widget that begins with *value*, and that comes back with what it had when the page was left.

    What is no longer *among* the options, where they are given, is forgotten.
    """
    kept: dict[str, Any] = st.session_state.setdefault(KEPT, {})
    held = st.session_state.get(key, kept.get(key, value))
    if among and isinstance(held, list):
        held = [one for one in held if one in among]
    elif among and held not in among:
        held = value
    if st.session_state.get(key) != held:
        st.session_state[key] = held
    kept[key] = held
    return key


def one_of(label: str, options: Sequence[str], *, key: str, hidden: bool = False) -> str:
    """Exactly one of *options*, the first one to begin with; a second click on it takes nothing away."""

    def back() -> None:
        st.session_state[key] = st.session_state[key] or st.session_state[KEPT][key]

    visibility: Any = "collapsed" if hidden else "visible"
    st.segmented_control(label, options, key=keep(key, options[0]), on_change=back, label_visibility=visibility)
    return str(st.session_state[key])


def pairs_table(rows: pd.DataFrame, pairs: Sequence[tuple[str, str]], go: Callable[[str, str], None], *, key: str) -> None:
    """Show *rows*, one for each of *pairs*; a click opens one."""
    number, text = st.column_config.NumberColumn, st.column_config.TextColumn
    config = {
        "count": number("times"),
        "rank": number("rank", width=60),
        "pair": text("pair", width=85),
        "percent": number("% of text", format="%.3f", help="Of all pairs in running text"),
        "cumulative": number("% so far", format="%.2f", help="This pair and all more frequent ones"),
        "covered": number("% then", format="%.2f", help="By hand, when this pair and all before it are done"),
        "hours": number("hours", format="%.1f", help="Until this pair and all before it are done"),
        "paper": text("paper %", width=75, alignment="right", help="Xu et al. 2013, Table 2"),
        "done": text("poses done", help="Of those that move the face in this pair"),
        "lines": text("lines", help="Where the script needs it"),
    }
    event = st.dataframe(
        rows,
        hide_index=True,
        column_config={name: column for name, column in config.items() if name in rows},
        key=key,
        height=min(ROW * (len(rows) + 1) + 3, MOST),
        on_select="rerun",
        selection_mode="single-cell",
    )
    st.caption("Click a row to open the pair in Curves.")
    for row, _ in event.selection.cells[:1]:
        go(*pairs[row])
