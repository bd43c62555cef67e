"""The links of a character, edited while the face follows."""

from __future__ import annotations

from typing import Any

import streamlit as st
from parts.lines import spoken
from parts.rows import Rows, hold, save_button, table, text
from parts.session import database
from parts.stage import stage

from lipdb.characters.exercise import raised
from lipdb.characters.own_links import link_rows, links_of, own_table
from lipdb.curated.tsv import Row
from lipdb.errors import LipdbError
from lipdb.performance import Performance

SENTENCE = "the sentence"


def links_editor(name: str, sentence: str, language: str) -> None:
    """The table of links on the left, on the right the face as they are now. Raises `LipdbError`."""
    db = database()
    who = db.character(name)
    poses = db.pose_set(who.pose_set).poses
    shapes = sorted(who.mesh.shape_names if who.mesh else who.pictures)
    held = hold(f"characters_links_{name}", lambda: {"links": _cells(name)})
    left, right = st.columns([3, 2])
    with left:
        doubtful = sum(row["doubtful"] for row in held.tables["links"])
        if doubtful:
            lead = "links lead to shapes" if doubtful > 1 else "link leads to a shape"
            st.warning(f"{doubtful} {lead} of a name that is only alike: look at it, change it, or untick “doubtful”.")
        columns = {
            "pose": st.column_config.SelectboxColumn("Pose", options=list(poses), required=True),
            "shape": st.column_config.SelectboxColumn("Shape", options=shapes, required=True),
            "gain": st.column_config.NumberColumn("Gain", step=0.05, default=1.0, required=True),
            "combine": st.column_config.SelectboxColumn("Combine", options=["sum", "max"], default="sum", required=True),
            "curve": st.column_config.TextColumn("Curve", help="Bends the weight before the gain: 0:0 0.5:0.2 1:1. Empty: straight."),
            "own": st.column_config.CheckboxColumn("Own", disabled=True, help="The character's own, not the shared table's."),
        }
        if doubtful:
            mark = st.column_config.CheckboxColumn("Doubtful", help="Matched by a name that is only alike.")
            columns = {"doubtful": mark, **columns}
        edited = table(f"characters_links_{name}", held, "links", columns, rows="dynamic")
    wanted = [_row(row, held.tables["links"]) for row in edited]
    path = own_table(name)
    rows: Rows = {}
    try:
        rows = {(path, key): row for key, row in link_rows(db.records, name, wanted).items()}
    except LipdbError as error:
        left.error(str(error), icon=":material/error:")
    with left:
        count = len(rows)
        st.caption(f"{count} row{'s' * (count != 1)} to save." if count else "Double-click a cell to change it; the face follows.")
        save_button(f"characters_links_{name}", held, rows, note=f"Links of {name}")
    with right:
        shown = st.selectbox("Show", [*poses, SENTENCE], key=f"characters_shown_{name}", help="A pose is raised and lowered in a loop.")
        performance = _performance(name, shown, sentence, language, db.store.revision, str(sorted(rows.items(), key=str)), rows)
        loop = None if shown == SENTENCE else (0.0, float(performance.track.times[-1]))
        stage([performance], key="characters_links_stage", autoplay=True, loop=loop)


def _cells(name: str) -> list[dict[str, Any]]:
    """The links as the table shows them."""
    return [
        {
            "pose": link.row["pose"],
            "shape": link.row["shape"],
            "gain": float(link.row["gain"]),
            "combine": link.row["combine"],
            "curve": link.row["curve"],
            "own": link.own,
            "doubtful": link.doubtful,
        }
        for link in links_of(database().records, name)
    ]


def _row(cells: dict[str, Any], before: list[dict[str, Any]]) -> Row:
    """The link that *cells* say; its comment stays, unless somebody ended a doubt."""
    row = {column: text(cells.get(column)) for column in ("pose", "shape", "gain", "combine", "curve")}
    doubted = any((one["pose"], one["shape"]) == (row["pose"], row["shape"]) and one["doubtful"] for one in before)
    return {**row, "comment": ""} if doubted and not cells.get("doubtful") else row


@st.cache_resource(max_entries=32, show_spinner=False)
def _performance(name: str, shown: str, sentence: str, language: str, revision: int, rows_key: str, _rows: Rows) -> Performance:  # noqa: ARG001
    """What the face does with *_rows* in place of what is saved."""
    db = database().supposing(_rows) if _rows else database()
    who = db.character(name)
    if shown == SENTENCE:
        return db.animate(spoken(sentence, language), character=who)
    return Performance(raised(db.pose_set(who.pose_set).poses, shown), who)
