"""Two versions of the curated data side by side: what differs, a choice for each row, and where the result goes."""

from __future__ import annotations

import os
from collections.abc import Sized
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd
import streamlit as st
from parts.language_work import told
from parts.lines import state
from parts.reach import only_from_here
from parts.session import as_typed, database, visitor, writable

from lipdb.curated.tsv import Records
from lipdb.curated.zipped import read_zip
from lipdb.errors import InputError
from lipdb.languages.compare import (
    LEFT,
    RIGHT,
    Difference,
    Place,
    changed_rows,
    chosen_rows,
    completed,
    differences,
    read_version,
    require_version,
)
from lipdb.languages.keep import save_merged, save_rows
from lipdb.paths import expanded, workspace_dir
from lipdb.words import counted

NOW, PAST, WORKSPACE, FOLDER, ZIP, NONE = (
    "The database now", "The database at a revision", "The workspace folder", "Another folder", "A zip that I upload", "Not known",
)  # fmt: skip
BASE = "base"
SIDES = (
    (LEFT, "Left", [NOW, PAST, WORKSPACE, FOLDER, ZIP]),
    (RIGHT, "Right", [WORKSPACE, PAST, NOW, FOLDER, ZIP]),
    (BASE, "What both were made from", [NONE, PAST, NOW, WORKSPACE, FOLDER, ZIP]),
)
EVERYTHING = "everything"
LARGEST = 16_000_000
MOST_ROWS = 2000
MOST_CONFLICTS = 40


@dataclass
class Merging:
    """What a visitor compares, and which side they chose for which row; *mark* says what it is of."""

    mark: str = ""
    found: list[Difference] = field(default_factory=list)
    choices: dict[Place, str] = field(default_factory=dict)
    seen: int = 0
    text: Records = field(default_factory=dict)
    version: int = 0


def show_compare() -> None:
    """Choose two versions, look at the differences, decide, and save."""
    st.caption("Two folders, a folder or a zip against the database, or two revisions: row by row, with a choice for each.")
    if done := st.session_state.pop("languages_merged", ""):
        st.success(done, icon=":material/check_circle:")
    versions: dict[str, Records | None] = {}
    for column, (side, label, kinds) in zip(st.columns(3), SIDES, strict=True):
        with column, told():
            versions[side] = _version(column, label, side, kinds)
    left, right = versions.get(LEFT), versions.get(RIGHT)
    if left is None or right is None or BASE not in versions:
        return
    with told():
        _compare(left, right, versions[BASE])


def _version(column: st.delta_generator.DeltaGenerator, label: str, side: str, kinds: list[str]) -> Records | None:
    """One version: its records, None while there is none yet. Raises `LipdbError`."""
    help_text = "With it, rows that only one side changed settle by themselves, and those that both changed are conflicts."
    if not only_from_here():
        kinds = [kind for kind in kinds if kind != FOLDER]  # Visitors from elsewhere do not look into this machine.
    kind = column.selectbox(label, kinds, key=f"languages_{side}_kind", persist_state="session", help=help_text if NONE in kinds else None)
    if kind == PAST:
        newest = database().store.revision
        number = column.number_input("Revision", 1, newest, max(newest - 1, 1), key=f"languages_{side}_revision", persist_state="session")
        return state(int(number)).records
    if kind == FOLDER:
        path = column.text_input("Folder", key=f"languages_{side}_folder", persist_state="session", placeholder="/home/anna/pl")
        return _read(expanded(path.strip())) if path.strip() else None
    if kind == ZIP:
        return _uploaded(column, side)
    if kind == WORKSPACE:
        return _read(_workspace())
    return database().records if kind == NOW else None


@st.cache_resource(max_entries=8, show_spinner=False)
def _text(folder: Path, mark: tuple[tuple[str, int, int], ...]) -> Records:  # noqa: ARG001  (the mark decides)
    return read_version(folder)


def _read(folder: Path) -> Records:
    """The records in *folder*, read again when one of its files has changed."""
    require_version(folder)
    files = ((file, file.stat()) for file in sorted(folder.rglob("*.tsv")))
    return _text(folder, tuple((str(file), stat.st_mtime_ns, stat.st_size) for file, stat in files))


def _workspace() -> Path:
    return workspace_dir(os.environ.get("LIPDB_PHONESETS"))


def _uploaded(column: st.delta_generator.DeltaGenerator, side: str) -> Records | None:
    file = column.file_uploader("Zip of a folder of text", type=["zip"], key=f"languages_{side}_zip", max_upload_size=LARGEST // 1_000_000)
    kept: dict[str, Records] = st.session_state.setdefault("languages_zips", {})
    if file is not None:
        if file.size > LARGEST:
            raise InputError(f"the zip is larger than {LARGEST // 1_000_000} MB; send the language's folder only")
        kept[side] = read_zip(file.getvalue())
    return kept.get(side)


def _compare(left: Records, right: Records, base: Records | None) -> None:
    left, right = completed(left, right), completed(right, left)
    base = completed(base, left) if base is not None else None
    codes = sorted({path.split("/")[0] for side in (left, right) for path in side if path.endswith("/language.tsv")})
    scope = st.selectbox("Compare", [EVERYTHING, *codes], key="languages_scope", persist_state="session")
    below = "" if scope == EVERYTHING else f"{scope}/"
    mine: Merging = st.session_state.setdefault("languages_merging", Merging())
    found = differences(left, right, base, below=below)
    mark = repr([(one.path, one.key, one.left, one.right, one.taken) for one in found])
    if mark != mine.mark:
        # Choices for rows that still differ in the same way stay.
        same = {one.place for one in found} & {one.place for one in mine.found}
        choices = {place: side for place, side in mine.choices.items() if place in same}
        text = _read(_workspace()) if _workspace().is_dir() else {}
        mine = Merging(mark, found, choices, database().store.revision, text, mine.version + 1)
        st.session_state["languages_merging"] = mine
    if not found:
        st.success("They are the same.", icon=":material/check_circle:")
        return
    _summary(found)
    _conflicts(mine)
    _rows(mine)
    _result(mine)


def _summary(found: list[Difference]) -> None:
    kinds = ("added", "changed", "removed")
    counts = {kind: sum(one.kind == kind for one in found) for kind in kinds}
    conflicts = sum(one.conflict for one in found)
    for column, (label, value) in zip(st.columns(4), [*counts.items(), ("conflicts", conflicts)], strict=True):
        column.metric(label.capitalize(), value)
    st.caption("Added: only the right one has the row. Removed: only the left one has it.")


def _conflicts(mine: Merging) -> None:
    conflicts = [one for one in mine.found if one.conflict]
    if not conflicts:
        return
    st.subheader("Both sides changed these")
    for number, one in enumerate(conflicts[:MOST_CONFLICTS]):
        with st.container(border=True):
            shown = one.to_row()
            first, second, third = st.columns([2, 5, 2], vertical_alignment="center")
            first.write(f"**{as_typed(' '.join(one.key))}**  \n{as_typed(one.path)}")
            second.write(f"Left: {as_typed(str(shown[LEFT]))}  \nRight: {as_typed(str(shown[RIGHT]))}")
            key = f"languages_conflict_{mine.version}_{number}"
            side = third.segmented_control(
                "Take", [LEFT, RIGHT], default=mine.choices.get(one.place), key=key, label_visibility="collapsed"
            )
            if side:
                mine.choices[one.place] = side
    if len(conflicts) > MOST_CONFLICTS:
        st.caption(f"{counted(len(conflicts) - MOST_CONFLICTS, 'more follows', 'more follow')} when these are saved.")


def _rows(mine: Merging) -> None:
    rows = [one for one in mine.found if not one.conflict]
    if not rows:
        return
    first, second, _ = st.columns([1, 1, 3])

    def take_all(side: str) -> None:
        mine.choices |= {one.place: side for one in rows}
        mine.version += 1

    first.button("Take the left for all", on_click=take_all, args=(LEFT,), key="languages_all_left", width="stretch")
    second.button("Take the right for all", on_click=take_all, args=(RIGHT,), key="languages_all_right", width="stretch")
    frame = pd.DataFrame([{"take": mine.choices.get(one.place, one.taken), **one.to_row()} for one in rows[:MOST_ROWS]])
    base_key = f"languages_rows_{mine.version}"

    def taken() -> None:
        for place, cells in st.session_state[base_key]["edited_rows"].items():
            if "take" in cells:
                mine.choices[rows[int(place)].place] = cells["take"] or rows[int(place)].taken

    st.data_editor(
        frame,
        key=base_key,
        hide_index=True,
        disabled=[name for name in frame.columns if name != "take"],
        height=min(38 + 35 * len(frame), 520),
        on_change=taken,
        column_config={
            # What is pinned keeps its width: the room that is left is for what differs.
            "take": st.column_config.SelectboxColumn("take", options=[LEFT, RIGHT], required=True, width=80, pinned=True),
            "what": st.column_config.TextColumn(width=80, pinned=True),
            "table": st.column_config.TextColumn(width=130),
            "row": st.column_config.TextColumn(width=100),
            LEFT: st.column_config.TextColumn(width=215),
            RIGHT: st.column_config.TextColumn(width=215),
        },
    )
    if len(rows) > MOST_ROWS:
        st.caption(f"The first {MOST_ROWS} of {len(rows)} rows; compare one language to see all of it.")


def _rows_of(changes: Sized) -> str:
    return counted(len(changes), "row")


def _result(mine: Merging) -> None:
    st.subheader("The result")
    open_conflicts = sum(one.conflict and one.place not in mine.choices for one in mine.found)
    if open_conflicts:
        st.info(f"{counted(open_conflicts, 'conflict waits', 'conflicts wait')} for your choice.", icon=":material/call_split:")
        return
    chosen = chosen_rows(mine.found, mine.choices)
    left, right = st.columns(2, gap="large")
    with left:
        changes = changed_rows(database().records, chosen)
        st.write(f"{_rows_of(changes)} of the database would change.")
        note = st.text_input("Why (for the history)", key="languages_merge_note", persist_state="session", max_chars=200)
        locked = not changes or not visitor().editor
        if st.button("Save to the database", type="primary", disabled=locked, key="languages_merge_rows", icon=":material/database:"):
            with told():
                db, author = writable()
                number = save_rows(changes, db.store, author=author, note=note or "Merge two versions", seen=mine.seen)
                st.session_state["languages_merged"] = f"Revision {number}: {_rows_of(changes)}. History can take it back."
                st.rerun()
    with right:
        folder = _workspace()
        changes = changed_rows(mine.text, chosen)
        st.write(f"{_rows_of(changes)} of the workspace `{folder}` would change.")
        locked = not changes or not mine.text or not visitor().editor
        if st.button("Save to the workspace", disabled=locked, key="languages_merge_text", icon=":material/folder:"):
            with told():
                writable()
                files = save_merged(changes, folder, seen=mine.text)
                st.session_state["languages_merged"] = (
                    f"Written: {', '.join(str(file.relative_to(folder)) for file in files)}. Review it with `git diff` in {folder}."
                )
                st.rerun()
