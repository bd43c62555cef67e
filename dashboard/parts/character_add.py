"""Add a character from uploaded files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path, PureWindowsPath

import streamlit as st
from parts.session import visitor, writable
from parts.uploads import contents, scratch

from lipdb.characters.add import Added
from lipdb.characters.pictures import picture_files
from lipdb.characters.uploaded import LARGEST, lay_out
from lipdb.errors import InputError, LipdbError
from lipdb.words import counted

ADDED = "characters_added"


def add_form(look_at: Callable[[str], None]) -> None:
    """The form, and what came of it: every link with how certain it is; a button calls *look_at*. Raises `LipdbError`."""
    if not visitor().editor:
        st.info("You may look, but not add; ask an editor.")
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
            try:
                st.session_state[ADDED] = db.add_character(path, name=name.strip(), title=title.strip(), author=author)
            except LipdbError as error:
                error.args = (_renamed(str(error), path, files[0].name),)
                raise
        st.rerun()
    if ADDED in st.session_state:
        _tell(st.session_state[ADDED], look_at)


def _renamed(told: str, path: Path, first: str) -> str:
    """*told* with the names that files have where they come from, *first* for a mesh, in place of those of the copies at *path*."""
    if path.is_file():
        return told.replace(path.name, PureWindowsPath(first).name[:60])
    for shape, file in picture_files(path).items():
        told = told.replace(str(file), f"{shape}{file.suffix}")
    return told


def _tell(added: Added, look_at: Callable[[str], None]) -> None:
    """What a character was taken for, and what somebody should look at."""
    said, button = st.columns([3, 1], vertical_alignment="center")
    said.success(
        f"{added.name} is here. Its shapes are named as those of {added.shape_set} ({added.match.share:.0%} of what speech needs).",
        icon=":material/check:",
    )
    button.button(
        f"Look at {added.name}", key="characters_look", icon=":material/face:", on_click=look_at, args=(added.name,), width="stretch"
    )
    found = [
        counted(len(shapes), *what)
        for shapes, what in (
            (added.match.doubtful, ("doubtful shape",)),
            (added.match.missing, ("shape that was not found", "shapes that were not found")),
        )
        if shapes
    ]
    if found:
        st.warning(f"{' and '.join(found)}: look at its links.")
    marks = {"sure": "", "doubtful": "⚠ doubtful", "missing": "✗ not found"}
    # What is not found gets no link, so it has no gain either.
    rows = [
        {
            "": marks[row["certainty"]],
            "pose": row["pose"],
            "shape": row["shape"],
            **{column: "" if row["certainty"] == "missing" else row[column] for column in ("gain", "comment")},
        }
        for row in added.rows()
    ]
    rows.sort(key=lambda row: row[""] == "")
    st.dataframe(rows, hide_index=True, column_order=[name for name in rows[0] if name or rows[0][""]])
