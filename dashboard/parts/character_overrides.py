"""What a character has of its own: against what it would inherit, side by side, and back to that."""

from __future__ import annotations

from dataclasses import replace

import streamlit as st
from parts.compare import draw_versions
from parts.lines import played, spoken
from parts.rows import Rows, save_rows
from parts.saved import show_saved
from parts.session import database, visitor
from parts.stage import stage

from lipdb.characters.overrides import REST, Override, overrides, with_siblings
from lipdb.curves.curve import Curve
from lipdb.curves.keys import parse_keys
from lipdb.errors import LipdbError
from lipdb.languages.examples import Examples
from lipdb.performance import Performance
from lipdb.words import counted

TICKED = "characters_ticked"
"""Where a visitor's ticks stay while other pages are shown: the character, and the rows."""


def overrides_table(name: str, sentence: str, language: str) -> None:
    """The table, what was chosen in it as curves and as faces, and the buttons that take it away. Raises `LipdbError`."""
    db = database()
    seen = db.store.revision
    show_saved(_place(name), key=_place(name))
    found = overrides(db.records, name, language)
    if not found:
        st.info("This character has nothing of its own. In Curves, save to the layer of this character.")
        return
    of, before = st.session_state.get(TICKED, ("", set()))
    ticked = [row for row, one in enumerate(found) if of == name and (one.table, one.key) in before]
    picked = st.dataframe(
        [one.to_row() for one in found],
        hide_index=True,
        on_select="rerun",
        selection_mode="multi-row",
        key=f"characters_overrides_{name}_{language}_{seen}",
        selection_default={"selection": {"rows": ticked}},
        column_config={
            "what": st.column_config.TextColumn(width=70),
            "name": st.column_config.TextColumn(width=140),
            "own": st.column_config.TextColumn("this character's value", width=280),
            "inherited": st.column_config.TextColumn("inherited value", width=280),
            "layer": st.column_config.TextColumn("from", width=120),
        },
    )
    chosen = [found[row] for row in picked.selection.rows]
    st.session_state[TICKED] = name, {(one.table, one.key) for one in chosen}
    _resets(name, found, chosen, seen)
    if not chosen:
        st.caption("Tick rows to see and hear them against what would be inherited.")
        return
    curves = {one.name: (_curve(one.inherited), _curve(one.own)) for one in chosen if one.what == "curve"}
    if curves:
        draw_versions(curves, "inherited", "own")
    said = _example(chosen[0], name, language, seen) or sentence
    st.write(f"“{said}”")
    rows = with_siblings(db.records, chosen)
    without = _without(said, language, name, seen, str(sorted(rows)), rows)
    stage([played(spoken(said, language), name), without], key="characters_overrides_stage")


def _place(name: str) -> str:
    """What was reset last is told for each character."""
    return f"characters_overrides_{name}"


def _resets(name: str, found: list[Override], chosen: list[Override], seen: int) -> None:
    if not visitor().editor:
        return
    records = database().records
    left, right, _ = st.columns([2, 2, 4])
    count = len(with_siblings(records, chosen))
    label = f"Reset {counted(count, 'row')}" if count else "Reset what is ticked"
    if left.button(label, key="characters_reset", icon=":material/undo:", disabled=not chosen, width="stretch"):
        what = ", ".join(one.name for one in chosen[:3]) + (" …" if len(chosen) > 3 else "")
        save_rows(with_siblings(records, chosen), note=f"Reset of {name}: {what}", seen=seen, name=_place(name))
    with right.popover("Reset all", icon=":material/restart_alt:", width="stretch"):
        st.write(f"{counted(len(found), 'row goes', 'rows go')} back to what is inherited. History can take that back.")
        if st.button("Reset all of them", key="characters_reset_all", type="primary"):
            save_rows(with_siblings(records, found), note=f"Reset everything of {name}", seen=seen, name=_place(name))


@st.cache_resource(max_entries=16, show_spinner=False)
def _without(sentence: str, language: str, name: str, revision: int, rows_key: str, _rows: Rows) -> Performance:  # noqa: ARG001
    trial = database().supposing(_rows)
    who = trial.character(name)
    return trial.animate(spoken(sentence, language), character=replace(who, title=f"{who.title or name}, inherited"))


@st.cache_resource(max_entries=8, show_spinner="Listening to the sample sentences")
def _examples(language: str, name: str, revision: int) -> Examples:  # noqa: ARG001
    return Examples(database(), language, name)


def _example(one: Override, name: str, language: str, revision: int) -> str:
    """A short sentence that needs the pair of *one*; empty when there is none."""
    if one.pair is None:
        return ""
    try:
        return next(iter(_examples(language, name, revision).containing(*one.pair)), "")
    except LipdbError:
        return ""


def _curve(keys: str) -> Curve:
    return Curve(() if keys == REST else parse_keys(keys))
