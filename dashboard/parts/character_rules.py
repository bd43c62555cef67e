"""The rules of a pose set: priorities, speed limits and thresholds, with the face as they would make it beside what it does now."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import streamlit as st
from parts.lines import played, spoken
from parts.rows import Cells, Rows, changed, hold, save_button, table, text
from parts.saved import show_saved
from parts.session import database
from parts.stage import stage

from lipdb.curated.tsv import Records, Row
from lipdb.errors import LipdbError, PhonesetError
from lipdb.performance import Performance
from lipdb.poses import PoseSet


def rules_editor(name: str, sentence: str, language: str) -> str:
    """The tables of the character's pose set, and the sentence with and without what was changed; the name of the editor.

    Raises `LipdbError`.
    """
    db = database()
    pose_set = db.character(name).pose_set
    users = [row["character"] for row in db.characters() if row["pose_set"] == pose_set]
    st.info(f"These rules belong to the pose set {pose_set}. They count in every language and every line for {', '.join(users)}.")
    key = f"characters_rules_{pose_set}"
    held = hold(key, f"rules of {pose_set}", lambda: _cells(pose_set))
    left, right = st.columns(2)
    with left:
        st.write("**Poses.** Where two meet, the higher priority wins.")
        poses = table(held, "poses", _pose_columns(), rows="fixed")
    with right:
        st.write("**Thresholds.** Two weights together are at most this.")
        thresholds = table(held, "thresholds", _threshold_columns([row["pose"] for row in poses]), rows="dynamic")
        whole = table(held, "whole", _whole_columns(), rows="fixed")
    rows: Rows = {}
    try:
        rows = _rows(held.base.records, pose_set, poses, thresholds, whole[0])
        PoseSet.from_records(db.supposing(rows).records, pose_set)
    except LipdbError as error:
        rows = {}
        st.error(str(error), icon=":material/error:")
    show_saved(key, key=key)
    save_button(key, held, rows, note=f"Rules of {pose_set}")
    line = spoken(sentence, language)
    performances = [played(line, name)]
    if rows:
        performances.append(_changed(sentence, language, name, db.store.revision, str(sorted(rows.items(), key=str)), rows))
    stage(performances, key="characters_rules_stage")
    return key


@st.cache_resource(max_entries=16, show_spinner=False)
def _changed(sentence: str, language: str, name: str, revision: int, rows_key: str, _rows: Rows) -> Performance:  # noqa: ARG001
    trial = database().supposing(_rows)
    who = trial.character(name)
    return trial.animate(spoken(sentence, language), character=replace(who, title=f"{who.title or name}, changed"))


def _cells(pose_set: str) -> dict[str, Cells]:
    records = database().records
    poses = sorted(records[f"poses/{pose_set}.tsv"].values(), key=lambda row: int(row["position"]))
    whole = records["poses/sets.tsv"][pose_set,]
    return {
        "poses": [
            {
                "pose": row["pose"],
                "priority": int(row["priority"]) if row["priority"] else None,
                "speed": float(row["speed"]),
                "must_reach": row["must_reach"] == "yes",
            }
            for row in poses
        ],
        "thresholds": [
            {"pose": row["pose"], "other": row["other"], "threshold": float(row["threshold"])}
            for _, row in sorted(records.get(f"constraints/{pose_set}.tsv", {}).items())
        ],
        "whole": [{"threshold": float(whole["threshold"]), "window": float(whole["window"])}],
    }


def _rows(records: Records, pose_set: str, poses: Cells, thresholds: Cells, whole: dict[str, Any]) -> Rows:
    """What saving the tables, which were read from *records*, writes. Raises `PhonesetError`."""
    path, constraints = f"poses/{pose_set}.tsv", f"constraints/{pose_set}.tsv"
    known, bounds = records[path], records.get(constraints, {})
    new_poses: dict[tuple[str, ...], Row] = {}
    for cells in poses:
        row = known[cells["pose"],]
        must = "yes" if cells["must_reach"] else "no"
        priority = "" if cells["priority"] is None else str(int(cells["priority"]))
        new_poses[cells["pose"],] = {**row, "priority": priority, "speed": text(cells["speed"]), "must_reach": must}
    new_bounds: dict[tuple[str, ...], Row] = {}
    for cells in thresholds:
        pair = text(cells["pose"]), text(cells["other"])
        if "" in pair or cells["threshold"] is None or pair[0] == pair[1]:
            raise PhonesetError("a threshold needs two different poses and a number")
        if pair in new_bounds or pair[::-1] in new_bounds:
            raise PhonesetError(f"{pair[0]} and {pair[1]} have two thresholds; keep one")
        row = {"pose": pair[0], "other": pair[1], "source": "user", "comment": "", **bounds.get(pair, {})}
        new_bounds[pair] = {**row, "threshold": text(cells["threshold"])}
    sets = records["poses/sets.tsv"]
    one = {**sets[pose_set,], "threshold": text(whole["threshold"]), "window": text(whole["window"])}
    return {
        **changed(known, new_poses, path),
        **changed(bounds, new_bounds, constraints),
        **changed({(pose_set,): sets[pose_set,]}, {(pose_set,): one}, "poses/sets.tsv"),
    }


def _pose_columns() -> dict[str, Any]:
    return {
        "pose": st.column_config.TextColumn("Pose", disabled=True),
        "priority": st.column_config.NumberColumn("Priority", min_value=0, step=1, help="Empty: it yields to all that have one."),
        "speed": st.column_config.NumberColumn("Speed limit", min_value=0.1, step=0.5, help="Largest change of the weight in a second."),
        "must_reach": st.column_config.CheckboxColumn("Must reach", help="Its peaks hold whatever happens, as closed lips do."),
    }


def _threshold_columns(poses: list[str]) -> dict[str, Any]:
    return {
        "pose": st.column_config.SelectboxColumn("Pose", options=poses, required=True),
        "other": st.column_config.SelectboxColumn("Other pose", options=poses, required=True),
        "threshold": _bound("Threshold"),
    }


def _whole_columns() -> dict[str, Any]:
    return {
        "threshold": _bound("All other pairs"),
        "window": st.column_config.NumberColumn("Valleys filled (s)", min_value=0.0, max_value=1.0, step=0.01, required=True),
    }


def _bound(label: str) -> Any:
    return st.column_config.NumberColumn(label, min_value=0.0, max_value=2.0, step=0.05, required=True, help="2 binds nothing.")
