"""The languages that there are: phones and what they map to, aliases, the check, and what is taken over from others."""

from __future__ import annotations

import pandas as pd
import streamlit as st
from parts.conflict import ask_again
from parts.language_aliases import show_aliases
from parts.language_edit import SAVED, fill, forget, picked, save_one
from parts.language_reuse import show_check, show_reuse
from parts.language_review import common_titles
from parts.language_work import hear, told
from parts.session import Edited, database, visitor

from lipdb import Database
from lipdb.curated.tsv import Row
from lipdb.errors import InputError
from lipdb.schedule import SILENCE

NOBODY = "the language itself"
WIDE = (60, 50, 80, 90, 100, 80, 75)
"""Pixels of the columns of phones: together what a page of 1280 has room for."""


def show_languages() -> None:
    """Choose a language, and look at it."""
    ask_again()
    db = database()
    languages = {row["language"]: row for row in db.languages()}
    left, middle, right = st.columns([2, 2, 3], vertical_alignment="bottom")
    code = left.selectbox(
        "Language",
        list(languages),
        index=list(languages).index("en") if "en" in languages else 0,
        format_func=lambda one: f"{languages[one]['name']} ({one})",
        key="languages_code_shown",
        persist_state="session",
    )
    row = languages[code]
    characters = {one["character"]: one["title"] or one["character"] for one in db.characters()}
    character = middle.selectbox(
        "As it is said by",
        [NOBODY, *characters],
        format_func=lambda one: characters.get(one, one),
        key="languages_character",
        persist_state="session",
        help="A character may say a phone in its own way; the layer shows where a mapping comes from.",
    )
    told_of = f"Phones in {row['notation']}; spoken by {row['speech']}, voice {row['voice']}; script {row['script']}. {row['comment']}"
    right.caption(told_of)
    if note := st.session_state.pop(SAVED, ""):
        st.success(note, icon=":material/check_circle:")
    for tab, show in zip(
        st.tabs(["Phones", "Aliases", "Check", "What it takes over"], key="languages_tab", on_change="rerun"),
        (_phones, show_aliases, show_check, show_reuse),
        strict=True,
    ):
        if tab.open:
            with tab:
                show(code, None if character == NOBODY else character)


def _phones(code: str, character: str | None) -> None:
    db = database()
    mapped = list(db.phoneset(code, character=character))
    left, right = st.columns([3, 2], gap="medium")
    columns = ("phone", "ipa", "common", "layer", "example", "origin", "source")
    rows = pd.DataFrame([{name: one.to_row()[name] for name in columns} for one in mapped])
    names = [one.phone for one in mapped]
    key, chosen = f"languages_phones_{code}", f"languages_phone_of_{code}"
    left.dataframe(
        rows,
        key=key,
        hide_index=True,
        height=560,
        on_select=lambda: picked(key, names, chosen),
        selection_mode="single-row",
        column_config={name: st.column_config.TextColumn(width=wide) for name, wide in zip(columns, WIDE, strict=True)},
    )
    with right:
        one, two = st.columns([1, 2])
        name = one.selectbox("Phone", names, key=chosen, persist_state="session")
        _edit_phone(two, code, db.records[f"{code}/phones.tsv"][name,])


def _edit_phone(beside: st.delta_generator.DeltaGenerator, code: str, row: Row) -> None:
    db, place = database(), f"phone {code} {row['phone']}"
    options = [key[0] for key in db.records["common.tsv"] if key[0] != SILENCE]
    fill(place, {"common": row["common"].split(), "ipa": row["ipa"], "example": row["example"], "comment": row["comment"]})
    common = beside.multiselect("Common phones", options, format_func=common_titles(), key=f"{place} common", persist_state="session")
    left, right = st.columns(2)
    ipa = left.text_input("IPA", key=f"{place} ipa", persist_state="session", max_chars=20)
    example = right.text_input("Example word", key=f"{place} example", persist_state="session", max_chars=80)
    left, right = st.columns(2)
    comment = left.text_input("Comment", key=f"{place} comment", persist_state="session", max_chars=400)
    note = right.text_input("Why (for the history)", key=f"{place} note", persist_state="session", max_chars=200)
    edited = {**row, "common": " ".join(common), "ipa": ipa.strip(), "example": example.strip(), "comment": " ".join(comment.split())}
    changed = edited != row
    first, second = st.columns(2)
    if first.button("Save", type="primary", key=f"{place} save", disabled=not changed or not visitor().editor, width="stretch"):
        with told():
            if not common:
                raise InputError(f"{row['phone']}: choose at least one common phone")
            what = f"{row['phone']} of {code} maps to {edited['common']}"
            save_one(Edited(f"{code}/phones.tsv", (row["phone"],), edited), note=note or what, place=place, what=what)
    if second.button("Undo", key=f"{place} undo", disabled=not changed, width="stretch"):
        forget(place)
        st.rerun()
    if changed:
        st.caption(":material/edit: Not saved yet" + ("; it is heard as you changed it." if common else "."))
    trial = _tried(code, edited) if changed and common else db
    if words := (edited["example"] or row["example"]).replace(",", " ").split():
        hear(trial, f"{db.store.revision} {edited}", words[0], code, key="languages_hear")


def _tried(code: str, row: Row) -> Database:
    from lipdb.languages.trial import Trial

    return Trial(database(), {f"{code}/phones.tsv": {(row["phone"],): row}})
