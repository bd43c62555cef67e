"""Step 2 of adding a language: its phones, those to look at first; listen, and correct in place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pandas as pd
import streamlit as st
from parts.language_work import STEPS, Work, digest, go, hear, told
from parts.session import database

from lipdb.languages.begin import TYPING, typed_entries
from lipdb.languages.draft import Entry
from lipdb.languages.trial import Trial
from lipdb.schedule import SILENCE
from lipdb.words import counted

LOOK, DONE, PROPOSED = "⚠ look", "✓ decided", "proposed"


def step_phones(mine: Work) -> None:
    """The table of phones, and beside it the one that is looked at."""
    draft = mine.draft
    doubtful = sum(one.doubtful for one in draft.entries.values())
    decided = sum(one.decided for one in draft.entries.values())
    todo = f"**{doubtful} to look at**" if doubtful else "none left that must be looked at"
    st.write(f"{counted(len(draft.entries), 'phone')}, {todo}, {decided} decided by you. The others map as the rule says.")
    left, right = st.columns([3, 2], gap="medium")
    with left:
        _table(mine)
        _add(mine)
    with right:
        _panel(mine)


def common_titles() -> Callable[[str], str]:
    """What names a common phone as people know it: ``sh (she, chin)``. Many are named at once: the database is asked once."""
    rows = database().records["common.tsv"]

    def title(name: str) -> str:
        example = rows.get((name,), {}).get("example", "")
        return f"{name} ({', '.join(example.split(', ')[:2])})" if example else name

    return title


def _table(mine: Work) -> None:
    entries = mine.draft.in_order()
    rows = [
        {
            "": LOOK if one.doubtful else DONE if one.decided else PROPOSED,
            "phone": one.phone.ipa,
            "common": " ".join(one.common),
            "sure": 100 * one.phone.proposal.confidence,
            "second": " ".join(one.phone.proposal.second),
            "example": one.example,
            "heard": one.phone.count,
        }
        for one in entries
    ]
    names = [one.phone.ipa for one in entries]
    key = mine.key("table")

    def picked() -> None:
        chosen = st.session_state[key].selection.rows
        if chosen:
            mine.phone = names[chosen[0]]

    st.dataframe(
        pd.DataFrame(rows),
        key=key,
        hide_index=True,
        on_select=picked,
        selection_mode="single-row",
        height=min(38 + 35 * len(rows), 560),
        column_config={
            "": st.column_config.TextColumn(width=75),
            "phone": st.column_config.TextColumn(width=60),
            "common": st.column_config.TextColumn(width=75, help="The classes of sounds that look alike to which it is mapped"),
            "sure": st.column_config.ProgressColumn(min_value=0, max_value=100, format="%.0f%%", width=80, color="blue"),
            "second": st.column_config.TextColumn("2nd choice", width=75),
            "example": st.column_config.TextColumn(width=100),
            "heard": st.column_config.NumberColumn(width=60, help="How often the voice said it in the text"),
        },
    )


def _add(mine: Work) -> None:
    with st.form(mine.key("add_form"), clear_on_submit=True, border=False):
        left, right = st.columns([3, 1], vertical_alignment="bottom")
        typed = left.text_input("Add phones that are missing, in IPA", key=mine.key("add"), help=f"{TYPING}.")
        if right.form_submit_button("Add", width="stretch", icon=":material/add:"):
            with told():
                records = mine.draft.overlay(database().records)
                added = mine.draft.add(typed_entries(typed, records))
                mine.phone = added[0] if added else mine.phone
                st.rerun()


def _panel(mine: Work) -> None:
    draft = mine.draft
    names = [one.phone.ipa for one in draft.in_order()]
    mine.phone = mine.phone if mine.phone in draft.entries else names[0]
    choice = mine.key("phone")
    st.session_state[choice] = mine.phone

    def chosen() -> None:
        mine.phone = st.session_state[choice]

    def titled(name: str) -> str:
        return f"{name}  {LOOK}" if draft.entries[name].doubtful else name

    st.selectbox("Phone", names, format_func=titled, key=choice, on_change=chosen)
    entry = draft.entries[mine.phone]
    _proposal(entry)
    common = _common(mine, entry)
    buttons, face = st.container(), st.container()
    example, spelt, note = _fields(mine, entry)
    with buttons:
        _buttons(mine, entry, common, example, spelt, note)
    with face:
        _listen(mine, entry, common, example, spelt)


def _proposal(entry: Entry) -> None:
    proposal = entry.phone.proposal
    if entry.doubtful:
        st.warning(f"Look at this one: {entry.phone.review}.", icon=":material/visibility:")
    second = f" Second choice: **{' '.join(proposal.second)}**." if proposal.second else ""
    heard = f" Heard {entry.phone.count}× as {', '.join(entry.phone.labels[:4])}." if entry.phone.count else ""
    st.caption(f"Proposed **{' '.join(proposal.common)}**. {entry.phone.reason}.{second}{heard}")


def _common(mine: Work, entry: Entry) -> list[str]:
    key = mine.key(f"common_{entry.phone.ipa}")
    options = [name for (name,) in mine.draft.overlay(database().records)["common.tsv"] if name != SILENCE]
    standing = st.session_state.get(key, entry.common)
    st.session_state[key] = [one for one in standing if one in options]
    return st.multiselect(
        "Common phones",
        options,
        key=key,
        format_func=common_titles(),
        persist_state="session",
        help="What is seen when it is said: lips first, then the jaw, then the tongue. A diphthong or an affricate may have several.",
    )


def _fields(mine: Work, entry: Entry) -> tuple[str, str, str]:
    """The example, how the phone is spelt for the silent voice, and why the person decided so."""
    name = entry.phone.ipa
    keys = {field: mine.key(f"{field}_{name}") for field in ("example", "spelt", "note")}
    for field, key in keys.items():
        st.session_state.setdefault(key, getattr(entry, field))
    left, right = st.columns(2)
    example = left.text_input("Example word", key=keys["example"], persist_state="session", max_chars=80)
    spelt = ""
    if mine.draft.silent:
        spelt = right.text_input("Spelt in texts", key=keys["spelt"], persist_state="session", placeholder=name, max_chars=12)
    where = st if mine.draft.silent else right
    note = where.text_input("Why (for those who differ)", key=keys["note"], persist_state="session", max_chars=200)
    return example, spelt, note


def _buttons(mine: Work, entry: Entry, common: list[str], example: str, spelt: str, note: str) -> None:
    draft, name, second = mine.draft, entry.phone.ipa, list(entry.phone.proposal.second)
    left, middle = st.columns(2)
    if left.button("Right so", type="primary", icon=":material/check:", key=mine.key("decide"), width="stretch"):
        with told():
            draft.decide(name, common=common, example=example, spelt=spelt, note=note)
            mine.phone = draft.next_doubtful or name
            st.rerun()

    def take(value: list[str]) -> None:
        st.session_state[mine.key(f"common_{name}")] = value

    middle.button(
        f"Take {' '.join(second)}" if second else "No second choice",
        disabled=not second or common == second,
        key=mine.key("second"),
        on_click=take,
        args=(second,),
        width="stretch",
    )
    leave, onward = st.columns(2)
    if leave.button(
        "Leave it out", type="tertiary", icon=":material/close:", key=mine.key("leave"), help="The language has no such phone."
    ):
        with told():
            draft.leave_out(name)
            mine.phone = draft.next_doubtful
            st.rerun()
    if onward.button(
        "Next step", type="tertiary", icon=":material/arrow_forward:", key=mine.key("next_common"), disabled=bool(draft.next_doubtful)
    ):
        go(STEPS[2])
        st.rerun()


def _listen(mine: Work, entry: Entry, common: list[str], example: str, spelt: str) -> None:
    """The example word, with the phone as it is being changed."""
    if not common or not example.strip():
        return
    name = entry.phone.ipa
    changed = replace(entry, common=tuple(common), spelt="".join(spelt.split()))
    tried = replace(mine.draft, entries={**mine.draft.entries, name: changed})
    own = tried.tables(database().records, author="")
    hear(Trial(database(), own), f"{digest(own)} {name}", example, mine.draft.code, key=mine.key("hear"))
