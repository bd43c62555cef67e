"""Languages: those that there are, a further one step by step, and two versions compared and merged."""

from __future__ import annotations

import streamlit as st
from parts.language_begin import step_language
from parts.language_compare import show_compare
from parts.language_finish import step_check, step_common, step_save
from parts.language_review import step_phones
from parts.language_show import show_languages
from parts.language_work import STEP, STEPS, work
from parts.session import shown_errors

SHOW, ADD, COMPARE = "Languages", "Add a language", "Compare and merge"


def add() -> None:
    """The steps, where the visitor is among them, and the step itself."""
    mine = work()
    if "languages_go" in st.session_state:
        st.session_state[STEP] = st.session_state.pop("languages_go")
    if mine is None:
        if st.session_state.get(STEP, STEPS[0]) != STEPS[0]:
            st.toast("Begin with step 1: which language is it?", icon=":material/looks_one:")
        st.session_state[STEP] = STEPS[0]
    step = st.segmented_control("Step", STEPS, key=STEP, persist_state="session", required=True, label_visibility="collapsed") or STEPS[0]
    if mine is None or step == STEPS[0]:
        step_language(mine)
        return
    st.caption(f"{mine.draft.row['name']} ({mine.draft.code}), step {STEPS.index(step) + 1} of {len(STEPS)}")
    {STEPS[1]: step_phones, STEPS[2]: step_common, STEPS[3]: step_check, STEPS[4]: step_save}[step](mine)


with shown_errors():
    view = st.segmented_control(
        "View",
        [SHOW, ADD, COMPARE],
        default=SHOW,
        key="languages_view",
        persist_state="session",
        required=True,
        label_visibility="collapsed",
        help="What you began here stays while you visit other pages.",
    )
    if view == ADD:
        add()
    elif view == COMPARE:
        show_compare()
    else:
        show_languages()
