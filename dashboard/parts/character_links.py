"""The links of a character, edited while the face follows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import streamlit as st
from parts.character_bends import bends_editor
from parts.lines import spoken
from parts.rows import Cells, Held, Rows, hold, save_button, table, text
from parts.saved import show_saved
from parts.session import database, visitor
from parts.stage import stage

from lipdb.characters.exercise import raised
from lipdb.characters.own_links import link_rows, links_of, own_table
from lipdb.curated.tsv import Row
from lipdb.errors import LipdbError
from lipdb.performance import Performance
from lipdb.words import counted

SENTENCE = "the sentence"


def links_editor(name: str, sentence: str, language: str) -> str:
    """The table of links on the left, on the right the face as they are now; the name of the editor. Raises `LipdbError`."""
    db = database()
    who = db.character(name)
    poses = db.pose_set(who.pose_set).poses
    shapes = sorted(who.mesh.shape_names if who.mesh else who.pictures)
    key = f"characters_links_{name}"
    held = hold(key, f"links of {name}", lambda: {"links": _cells(name)})
    left, right = st.columns([3, 2])
    with right:
        pose, speaking = _ask_shown(name, poses)
    with left:
        edited = _links_table(held, poses, shapes)
        try:
            given = held.base.records
            rows: Rows = {(own_table(name), link): row for link, row in link_rows(given, name, _wanted(edited, held)).items()}
            bends_editor(name, held, pose)
        except LipdbError as error:
            rows = {}
            st.error(str(error), icon=":material/error:")
        count = len(rows)
        if visitor().editor:  # others have been told below the curves
            st.caption(f"{counted(count, 'row')} to save." if count else "Double-click a cell to change it; the face follows.")
            show_saved(key, key=key)
            save_button(key, held, rows, note=f"Links of {name}")
    with right:
        shown = SENTENCE if speaking else pose
        performance = _performance(name, shown, sentence, language, db.store.revision, str(sorted(rows.items(), key=str)), rows)
        loop = None if speaking else (0.0, float(performance.track.times[-1]))
        stage([performance], key="characters_links_stage", autoplay=True, loop=loop)
    return key


def _ask_shown(name: str, poses: Sequence[str]) -> tuple[str, bool]:
    """The pose whose links are looked at, and whether the sentence is played instead of it."""
    left, right = st.columns(2, vertical_alignment="bottom")
    pose = left.selectbox("Pose", poses, key=f"characters_pose_{name}", persist_state="session", help="It is raised and lowered in a loop.")
    return pose, right.toggle("Play the sentence", key="characters_speaking", persist_state="session")


def _links_table(held: Held, poses: Sequence[str], shapes: Sequence[str]) -> Cells:
    doubtful = sum(row.get("doubtful", False) for row in held.tables["links"])
    if doubtful:
        lead = "links lead to shapes" if doubtful > 1 else "link leads to a shape"
        st.warning(f"{doubtful} {lead} of a name that is only alike: look at it, change it, or untick “doubtful”.")
    columns = {
        "pose": st.column_config.SelectboxColumn("Pose", options=list(poses), required=True),
        "shape": st.column_config.SelectboxColumn("Shape", options=list(shapes), required=True),
        "gain": st.column_config.NumberColumn("Gain", step=0.05, default=1.0, required=True),
        "combine": st.column_config.SelectboxColumn("Combine", options=["sum", "max"], default="sum", required=True),
        "curve": st.column_config.TextColumn(
            "Curve", width=75 if doubtful else 130, help="Bends the weight before the gain; drawn below. Empty: straight."
        ),
        "own": st.column_config.CheckboxColumn("Own", disabled=True, help="The character's own, not the shared table's."),
    }
    if doubtful:
        mark = st.column_config.CheckboxColumn("Doubtful", help="Matched by a name that is only alike.")
        columns = {"doubtful": mark, **columns}
    return table(held, "links", columns, rows="dynamic")


def _wanted(edited: Cells, held: Held) -> list[Row]:
    return [_row(row, held.tables["links"]) for row in edited]


def _cells(name: str) -> Cells:
    """The links as the table shows them; doubts have a column where there are any."""
    links = links_of(database().records, name)
    doubts = any(link.doubtful for link in links)
    return [
        {
            "pose": link.row["pose"],
            "shape": link.row["shape"],
            "gain": float(link.row["gain"]),
            "combine": link.row["combine"],
            "curve": link.row["curve"],
            "own": link.own,
            **({"doubtful": link.doubtful} if doubts else {}),
        }
        for link in links
    ]


def _row(cells: dict[str, Any], before: Cells) -> Row:
    """The link that *cells* say; its comment stays, unless somebody ended a doubt."""
    row = {column: text(cells.get(column)) for column in ("pose", "shape", "gain", "combine", "curve")}
    doubted = any((one["pose"], one["shape"]) == (row["pose"], row["shape"]) and one.get("doubtful") for one in before)
    return {**row, "comment": ""} if doubted and not cells.get("doubtful") else row


@st.cache_resource(max_entries=32, show_spinner=False)
def _performance(name: str, shown: str, sentence: str, language: str, revision: int, rows_key: str, _rows: Rows) -> Performance:  # noqa: ARG001
    """What the face does with *_rows* in place of what is saved."""
    db = database().supposing(_rows) if _rows else database()
    who = db.character(name)
    if shown == SENTENCE:
        return db.animate(spoken(sentence, language), character=who)
    return Performance(raised(db.pose_set(who.pose_set).poses, shown), who)
