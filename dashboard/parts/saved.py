"""What was saved last at some place, and the button beside it that takes exactly that back."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass

import streamlit as st
from parts.session import undo, visitor

from lipdb.errors import LipdbError

LAST = "saved_last"


@dataclass(frozen=True, slots=True)
class Saved:
    """What was done, in words, and the *revision* that it made; None when there was nothing to do."""

    text: str
    revision: int | None


def tell(place: Hashable, text: str, revision: int | None) -> None:
    """Remember for `show_saved` what was saved at *place*."""
    st.session_state.setdefault(LAST, {})[place] = Saved(text, revision)


def show_saved(place: Hashable, *, key: str) -> None:
    """Say what was saved last at *place*, with a button that takes it back, through the gate that it went through."""
    last: Saved | None = st.session_state.get(LAST, {}).get(place)
    if last is None:
        return
    said, button = st.columns([3, 1], vertical_alignment="center")
    said.success(last.text, icon=":material/check:")
    if last.revision is None or not visitor().editor:
        return
    if button.button("Undo save", key=f"{key}_undo", icon=":material/undo:", help=f"Take revision {last.revision} back", width="stretch"):
        try:
            made = undo(last.revision)
        except LipdbError as error:
            st.error(str(error), icon=":material/error:")
            return
        text = f"Revision {made} takes revision {last.revision} back." if made else f"Nothing of revision {last.revision} is left to undo."
        tell(place, text, made)
        st.rerun()
