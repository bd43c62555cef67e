"""What made the weights at one instant: which pair, which layer, which curve."""

from __future__ import annotations

from typing import Any

import streamlit as st
from parts.lines import played
from parts.session import database

from lipdb import Line
from lipdb.decisions import Cause
from lipdb.schedule import MICROSECONDS


def explain(line: Line, character: str, at: float) -> None:
    """A row for each pose that moves at *at* seconds, and a way to each pair's curves."""
    track = played(line, character).track
    at = min(max(at, 0.0), (len(track.weights) - 1) / track.fps)
    causes = database().explain(line, at=at, character=character)
    rows = [row for cause in causes if (row := _row(cause))]
    st.write(f"**{at:.2f} s**, {_where(line, at)}")
    if not rows:
        st.caption("Nothing moves the face here.")
        return
    st.dataframe(rows, hide_index=True, column_config={"weight": st.column_config.ProgressColumn(min_value=0, max_value=1, format="%.2f")})
    links = st.container(horizontal=True)
    for left, right in dict.fromkeys((left, right) for cause in causes for left, right, *_ in cause.curves):
        query = {"pair": f"{left}-{right}", "language": line.language, "character": character}
        links.page_link("pages/curves.py", label=f"Edit {left}-{right}", icon=":material/timeline:", query_params=query)


def _row(cause: Cause) -> dict[str, Any] | None:
    """A table's row, with the curve that won by maximum; None for a pose that nothing moves."""
    weight = cause.weights["final"]
    if weight < 0.0005 and not any(curve[2] for curve in cause.curves):
        return None
    curves = sorted(cause.curves, key=lambda curve: -curve[2])
    drawn = [f"{left}-{right} {value:.2f}" for left, right, value, _ in curves]
    best = curves[0][3] if curves else None
    return {
        "pose": cause.pose,
        "weight": weight,
        "pairs and their curves": " · ".join(drawn),
        "the larger one is": f"{best.where}, {best.curve.origin}" if best else "",
        "most changed by": cause.stage or "nothing",
        "gives way to": ", ".join(cause.yields_to),
    }


def _where(line: Line, at: float) -> str:
    """The phone that is heard at *at* seconds, and its word."""
    schedule = line.schedule
    heard = zip(schedule.phones, schedule.edges, schedule.edges[1:], strict=False)
    phone = next((phone for phone, start, end in heard if start <= at * MICROSECONDS < end), None)
    if phone is None or phone.silent:
        return "in silence"
    word = f" in “{schedule.words[phone.word]}”" if phone.word >= 0 else ""
    return f"{phone.symbol}{word}"
