"""The curves of a pose's links, drawn as the curves of pairs are: the pose's weight goes in, the shape's comes out."""

from __future__ import annotations

from dataclasses import dataclass
from secrets import token_hex

import streamlit as st
from parts.rows import Held
from parts.session import visitor
from parts.viewer import component

from lipdb.characters.own_links import STRAIGHT, bend_drawn
from lipdb.curves.keys import Keys, format_keys, parse_keys
from lipdb.errors import LipdbError

COMPONENT, SHOWN = "characters_bends", "characters_bends_shown"
AXIS = "weight of the pose, 0 to 1"

Bends = dict[str, list[list[float]] | None]
"""By shape: the keys of its link; None for a straight line."""


@dataclass
class _Shown:
    """The *bends* that the browser has, for one character's *pose*; with a new *token* it forgets its steps and takes these."""

    pose: tuple[str, str]
    token: str
    bends: Bends


def bends_editor(name: str, held: Held, pose: str) -> None:
    """Let the visitor draw the curves of the links of *pose*; what is drawn goes into the table ``links`` of *held*.

    Raises `LipdbError` for a curve in the table that can't be.
    """
    _receive(name, held, pose)
    mount = component("keys")
    links = {row["shape"]: row for row in held.edited["links"] if row["pose"] == pose and row["shape"]}
    if not links:
        st.caption(f"Nothing is linked to {pose} yet: it moves no shape.")
    if mount is None or not links:
        return
    curves = {shape: parse_keys(row["curve"] or "") for shape, row in links.items()}
    bends: Bends = {shape: _plain(keys) for shape, keys in curves.items()}
    shown: _Shown | None = st.session_state.get(SHOWN)
    if shown is None or shown.pose != (name, pose) or shown.bends != bends:
        shown = st.session_state[SHOWN] = _Shown((name, pose), token_hex(), bends)
    lanes = [
        {
            "pose": shape,
            "keys": bends[shape],
            "below": STRAIGHT,
            "from": "straight",
            "note": "",
            "drawn": bend_drawn(curves[shape], float(row["gain"] or 0)),
        }
        for shape, row in links.items()
    ]
    data = {"id": shown.token, "axis": AXIS, "lanes": lanes, "locked": not visitor().editor, "silent": [False, False]}
    mount(data=data, key=COMPONENT, on_curves_change=lambda: None)


def _receive(name: str, held: Held, pose: str) -> None:
    """Take over what the browser has sent, and show the table anew."""
    sent = (st.session_state.get(COMPONENT) or {}).get("curves") or {}
    shown: _Shown | None = st.session_state.get(SHOWN)
    if shown is None or shown.pose != (name, pose) or sent.get("id") != shown.token or not visitor().editor:
        return
    drawn: Bends = {shape: _plain(_read(pose, shape, sent["curves"].get(shape))) for shape in shown.bends}
    if drawn == shown.bends:
        return
    shown.bends = drawn
    held.put("links", [_bent(row, drawn) if row["pose"] == pose else row for row in held.edited["links"]])
    st.rerun()


def _bent(row: dict[str, object], drawn: Bends) -> dict[str, object]:
    keys = drawn.get(str(row["shape"]))
    return {**row, "curve": format_keys((time, weight) for time, weight in keys or ())}


def _plain(keys: Keys) -> list[list[float]] | None:
    return [list(key) for key in keys] or None


def _read(pose: str, shape: str, given: object) -> Keys:
    try:
        return parse_keys(format_keys((float(time), float(weight)) for time, weight in given or ()))  # type: ignore[attr-defined]
    except (TypeError, ValueError) as error:
        raise LipdbError(f"the link from {pose} to {shape}: keys are pairs of numbers, not {given!r:.60}") from error
