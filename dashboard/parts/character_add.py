"""Add a character from uploaded files."""

from __future__ import annotations

import streamlit as st
from parts.session import visitor, writable
from parts.uploads import contents, scratch

from lipdb.characters.add import Added
from lipdb.characters.uploaded import LARGEST, lay_out
from lipdb.errors import InputError

ADDED = "characters_added"


def add_form() -> None:
    """The form, and what came of it: every link with how certain it is. Raises `LipdbError`."""
    if not visitor().editor:
        st.info("You may look, but not add.")
        return
    with st.form("characters_add", border=False):
        left, right = st.columns([1, 2])
        name = left.text_input("Short name", key="characters_add_name", placeholder="bob", help="Small letters, digits and _.")
        title = right.text_input("Title", key="characters_add_title", placeholder="Bob, a robot", max_chars=80)
        files = st.file_uploader(
            "A .glb or .vrm file, or pictures named after their shapes (.svg, .png, or a .zip of them)",
            type=["glb", "vrm", "svg", "png", "zip"],
            accept_multiple_files=True,
            max_upload_size=LARGEST // 1_000_000,
            key="characters_add_files",
        )
        pressed = st.form_submit_button("Add", type="primary")
    if pressed:
        db, author = writable()
        if not name.strip():
            raise InputError("give the character a short name")
        with scratch() as folder, st.spinner("Reading the face"):
            path = lay_out(contents(files), folder)
            st.session_state[ADDED] = db.add_character(path, name=name.strip(), title=title.strip(), author=author)
        st.rerun()
    if ADDED in st.session_state:
        _tell(st.session_state[ADDED])


def _tell(added: Added) -> None:
    """What a character was taken for, and what somebody should look at."""
    st.success(f"{added.name} is here. Its shapes are named as those of {added.shape_set} ({added.match.share:.0%} of what speech needs).")
    if added.match.doubtful or added.match.missing:
        doubtful, missing = len(added.match.doubtful), len(added.match.missing)
        st.warning(f"{doubtful} of its shapes are doubtful, {missing} were not found: choose it above and look at its links.")
    marks = {"sure": "", "doubtful": "⚠ doubtful", "missing": "✗ not found"}
    rows = [
        {"": marks[row["certainty"]], **{column: row[column] for column in ("pose", "shape", "gain", "comment")}} for row in added.rows()
    ]
    st.dataframe(sorted(rows, key=lambda row: row[""] == ""), hide_index=True)
