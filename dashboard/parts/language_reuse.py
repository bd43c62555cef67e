"""The check of a language, and what it takes over from others."""

from __future__ import annotations

import streamlit as st
from parts.language_finish import show_checked
from parts.language_work import told
from parts.pairs import open_pair
from parts.session import database

from lipdb.database import DEFAULT_CHARACTER
from lipdb.languages.reuse import Reuse, reuse
from lipdb.languages.reuse_text import frequency_of
from lipdb.languages.trial import Checked, check_records

LONGEST_LIST = 300
_number, _text = st.column_config.NumberColumn, st.column_config.TextColumn
TOLD = {
    "pairs of": _text(help="The phones of all languages, its own, its syllables, or a text"),
    "shared": _number("taken over", help="A language chosen above has both phones of the pair"),
    "new": _number(help="No language chosen above has them"),
    "inherited": _number(help="New, but a coarser phone's curves serve until somebody draws their own"),
    "_ shared": _number("at pauses", help="Pairs with silence that are taken over"),
    "_ new": _number("new at pauses", help="Pairs with silence that are new"),
    "text in new": _text("text in new", help="What part of the running text the new pairs make"),
}


@st.cache_resource(max_entries=24, show_spinner="The voice reads the sample; every row is checked…")
def _checked(code: str, revision: int) -> Checked:  # noqa: ARG001  (the revision decides)
    return check_records(code, database().records)


def show_check(code: str, _character: str | None) -> None:
    """What the conformance kit says of it."""
    st.caption("The same check that every language that ships must pass. Notes are for a person to look at.")
    with told():
        show_checked(_checked(code, database().store.revision), database().language(code)["name"], key=f"languages_findings_{code}")


@st.cache_resource(max_entries=24, show_spinner="Reading the sample sentences…")
def _reused(code: str, donors: tuple[str, ...], revision: int) -> Reuse:  # noqa: ARG001  (the revision decides)
    text = frequency_of(database(), code)
    return reuse(database().records, code, donors, {text.name: text.frequency} if text.frequency.counts else {})


def show_reuse(code: str, _character: str | None) -> None:
    """Which pairs it takes over from languages that are chosen, and those that only it has."""
    names = {row["language"]: row["name"] for row in database().languages() if row["language"] != code}
    usual = ["en"] if "en" in names else list(names)
    donors = st.multiselect(
        "Taken over from",
        list(names),
        default=usual,
        format_func=lambda one: f"{names[one]} ({one})",
        key=f"languages_donors_{code}",
        persist_state="session",
        help="The first language that has both phones of a pair counts.",
    )
    if not donors:
        st.info("Choose a language to take pairs over from.")
        return
    with told():
        found = _reused(code, tuple(donors), database().store.revision)
        st.dataframe(
            [{**part.to_row(), **{f"from {donor}": count for donor, count in part.shared.items()}} for part in found.parts],
            hide_index=True,
            column_config=TOLD,
        )
        if found.own:
            phones = "common phone" if len(found.own) == 1 else "common phones"
            st.write(f"Only {database().language(code)['name']} has the {phones} **{' '.join(found.own)}**.")
        _new_pairs(code, found)


def _new_pairs(code: str, found: Reuse) -> None:
    fresh = [pair for pair in found.pairs if not pair.over][:LONGEST_LIST]
    if not fresh:
        st.caption(":material/check: Every pair that it can have is taken over.")
        return
    st.caption("Pairs that only it has, the most frequent in its sample sentences first. Choose one to open it in Curves.")
    key = f"languages_new_{code}"
    event = st.dataframe(
        [{"pair": f"{one.left}-{one.right}", "share of the text": 100 * one.share, "in": ", ".join(one.parts)} for one in fresh],
        key=key,
        hide_index=True,
        on_select="rerun",
        selection_mode="single-row",
        column_config={"share of the text": st.column_config.NumberColumn(format="%.2f %%")},
    )
    if event.selection.rows:
        pair = fresh[event.selection.rows[0]]
        if st.button(f"Open {pair.left}-{pair.right} in Curves", icon=":material/timeline:", key=f"languages_open_{code}"):
            open_pair(pair.left, pair.right, language=code, character=DEFAULT_CHARACTER)
