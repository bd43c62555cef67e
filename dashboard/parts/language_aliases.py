"""The aliases of a language: what other notations and tools write for its phones."""

from __future__ import annotations

from difflib import get_close_matches

import pandas as pd
import streamlit as st
from parts.language_edit import fill, forget, picked, save_one
from parts.language_work import told
from parts.session import Edited, database, visitor

from lipdb.curated.tsv import Key, Row
from lipdb.errors import InputError
from lipdb.schedule import SILENCE

NEW = "a new one"


def show_aliases(code: str, _character: str | None) -> None:
    """Look for aliases, and edit one."""
    db = database()
    rows = db.records.get(f"{code}/aliases.tsv", {})
    notations = sorted({key[0] for key in rows})
    first, second = st.columns(2)
    notation = first.selectbox("Notation", ["all", *notations], key=f"languages_notation_{code}", persist_state="session")
    wanted = second.text_input("Find", key=f"languages_find_{code}", persist_state="session", placeholder="a symbol, or a phone")
    found = [
        key
        for key, row in sorted(rows.items())
        if notation in ("all", key[0]) and (not wanted.strip() or wanted.strip() in (key[1], *row["phones"].split()))
    ]
    left, right = st.columns([3, 2], gap="medium")
    titles = {" ".join(key): key for key in found}
    key, chosen = f"languages_aliases_{code}", f"languages_alias_of_{code}"
    left.dataframe(
        pd.DataFrame([rows[one] for one in found], columns=["notation", "symbol", "phones", "source", "comment"]),
        key=key,
        hide_index=True,
        height=520,
        on_select=lambda: picked(key, list(titles), chosen),
        selection_mode="single-row",
    )
    left.caption(f"{len(found)} of {len(rows)} aliases")
    with right:
        title = st.selectbox("Alias", [NEW, *titles], key=chosen, persist_state="session")
        _edit_alias(code, titles.get(title), rows, notations)


def _edit_alias(code: str, key: Key | None, rows: dict[Key, Row] | object, notations: list[str]) -> None:
    phones = [SILENCE, *(name for (name,) in database().records[f"{code}/phones.tsv"])]
    row: Row = dict(rows[key]) if key else {"notation": "", "symbol": "", "phones": "", "source": "user", "comment": ""}  # type: ignore[index]
    place = " ".join(["alias", code, *(key or ("", ""))])
    fill(place, {"notation": row["notation"] or None, "symbol": row["symbol"], "phones": row["phones"], "comment": row["comment"]})
    left, right = st.columns(2)
    notation = left.selectbox(
        "Notation",
        notations,
        key=f"{place} notation",
        persist_state="session",
        accept_new_options=True,
        disabled=key is not None,
        placeholder="ipa",
    )
    symbol = right.text_input("Symbol", key=f"{place} symbol", persist_state="session", disabled=key is not None, max_chars=40)
    stands = st.text_input(
        "Stands for",
        key=f"{place} phones",
        persist_state="session",
        max_chars=80,
        help=f"One phone of the language or several with spaces between them; {SILENCE} is a pause.",
    ).split()
    comment = st.text_input("Comment", key=f"{place} comment", persist_state="session", max_chars=200)
    edited = {
        **row,
        "notation": notation or "",
        "symbol": "".join(symbol.split()),
        "phones": " ".join(stands),
        "comment": " ".join(comment.split()),
    }
    changed, may = edited != row, visitor().editor
    first, second, third = st.columns(3)
    what = f"{edited['notation']} {edited['symbol']} of {code} stands for {edited['phones']}"
    if first.button("Save", type="primary", key=f"{place} save", disabled=not changed or not may, width="stretch"):
        with told():
            if not edited["notation"] or not edited["symbol"] or not stands:
                raise InputError("give the notation, the symbol and what it stands for")
            if strange := [phone for phone in stands if phone not in phones]:
                near = get_close_matches(strange[0], phones, 1)
                raise InputError(f"{code} has no phone {strange[0]!r}" + (f"; did you mean {near[0]!r}?" if near else ""))
            if key is None and (edited["notation"], edited["symbol"]) in rows:  # type: ignore[operator]
                raise InputError(f"{edited['symbol']!r} of {edited['notation']} is there already; choose it in the list to change it")
            save_one(Edited(f"{code}/aliases.tsv", (edited["notation"], edited["symbol"]), edited), note=what, place=place, what=what)
    if second.button("Undo", key=f"{place} undo", disabled=not changed, width="stretch"):
        forget(place)
        st.rerun()
    if key is not None and third.button("Delete", key=f"{place} delete", disabled=not may, width="stretch"):
        with told():
            gone = f"{' '.join(key)} of {code} is gone"
            save_one(Edited(f"{code}/aliases.tsv", key, None), note=gone, place=place, what=gone)
