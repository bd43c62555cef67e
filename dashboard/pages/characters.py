"""Characters: add one, edit its links while the face follows, see its poses, its rules and what it has of its own."""

from __future__ import annotations

import streamlit as st
from parts.character_add import add_form
from parts.character_links import links_editor
from parts.character_overrides import overrides_table
from parts.character_rules import rules_editor
from parts.conflict import ask_again
from parts.gallery import gallery
from parts.rows import names, unsaved
from parts.session import database, shown_errors

from lipdb.characters.overrides import overrides
from lipdb.database import DEFAULT_CHARACTER

LINKS, POSES, RULES, OWN, ADD = "Links", "Poses", "Rules", "Overrides", "Add one"
NAME, SECTION, ADDRESS = "characters_name", "characters_section", "characters_address"


def chosen() -> tuple[str, str, str]:
    """The character, and the sentence and language in which it is looked at."""
    db = database()
    characters, languages = names(db.characters(), "character"), names(db.languages(), "language")
    asked = st.query_params.get("character")
    if asked in characters and asked != st.session_state.get(ADDRESS):  # another page or a link; the page itself writes it below
        st.session_state[NAME] = asked
    elif st.session_state.get(NAME) not in characters:
        st.session_state[NAME] = DEFAULT_CHARACTER if DEFAULT_CHARACTER in characters else min(characters)
    first, second, third = st.columns([2, 2, 4])
    name = first.selectbox("Character", list(characters), format_func=characters.__getitem__, key=NAME, persist_state="session")
    language = second.selectbox(
        "Language",
        list(languages),
        index=list(languages).index("en"),
        format_func=languages.__getitem__,
        key="characters_language",
        persist_state="session",
    )
    samples = [key[0] for key in db.records.get(f"{language}/sentences.tsv", {})]
    said = third.text_input(
        "Sentence",
        min(samples, key=len, default="mama"),
        key=f"characters_sentence_{language}",
        persist_state="session",
    )
    st.query_params["character"] = st.session_state[ADDRESS] = name
    return name, said.strip() or "mama", language


def look_at(name: str) -> None:
    """Choose a character, and look at its links."""
    st.session_state[NAME], st.session_state[SECTION] = name, LINKS


with shown_errors():
    ask_again()
    name, sentence, language = chosen()
    own = len(overrides(database().records, name, language))
    counted = {OWN: f"{OWN} ({own})"}
    st.session_state.setdefault(SECTION, LINKS)
    section = st.segmented_control(
        "Section",
        [LINKS, POSES, RULES, OWN, ADD],
        key=SECTION,
        required=True,
        persist_state="session",
        format_func=lambda one: counted.get(one, one),
        label_visibility="collapsed",
    )
    waiting = st.empty()
    edited = ""
    if section == POSES:
        gallery(name)
    elif section == RULES:
        edited = rules_editor(name, sentence, language)
    elif section == OWN:
        overrides_table(name, sentence, language)
    elif section == ADD:
        add_form(look_at)
    else:
        edited = links_editor(name, sentence, language)
    if titles := unsaved(other_than=edited):
        waiting.caption(f":material/edit: Not saved yet elsewhere: {', '.join(titles)}.")
