"""Characters: add one, edit its links while the face follows, see its poses, its rules and what it has of its own."""

from __future__ import annotations

import streamlit as st
from parts.character_add import add_form
from parts.character_links import links_editor
from parts.character_overrides import overrides_table
from parts.character_rules import rules_editor
from parts.conflict import ask_again
from parts.rows import names, unsaved
from parts.session import database, shown_errors

from lipdb.characters.overrides import overrides
from lipdb.render.gallery import pose_gallery

LINKS, POSES, RULES, OWN, ADD = "Links", "Poses", "Rules", "Overrides", "Add one"
ACROSS = 5


@st.cache_resource(max_entries=12, show_spinner="Drawing every pose at full weight")
def pictures(name: str, drawn: str, revision: int) -> dict[str, bytes]:  # noqa: ARG001  (what it is drawn of decides)
    """The pose gallery of the character *name*, drawn once for each revision."""
    who = database().character(name)
    return pose_gallery(who, database().pose_set(who.pose_set).poses)


def gallery(name: str) -> None:
    """Each pose at full weight."""
    db = database()
    who = db.character(name)
    rows = {row["pose"]: row["description"] for row in db.records[f"poses/{who.pose_set}.tsv"].values()}
    drawn = pictures(name, who.drawing, db.store.revision)
    for start in range(0, len(drawn), ACROSS):
        row = list(drawn.items())[start : start + ACROSS]
        for column, (pose, picture) in zip(st.columns(ACROSS), row, strict=False):
            column.image(picture, caption=f"**{pose}** {rows.get(pose, '')}", width="stretch")


def chosen() -> tuple[str, str, str]:
    """The character, and the sentence and language in which it is looked at."""
    db = database()
    characters, languages = names(db.characters(), "character"), names(db.languages(), "language")
    asked = st.query_params.get("character", "robin")
    first, second, third = st.columns([2, 2, 4])
    start = list(characters).index(asked) if asked in characters else 0
    name = first.selectbox("Character", list(characters), index=start, format_func=characters.__getitem__, key="characters_name")
    language = second.selectbox(
        "Language", list(languages), index=list(languages).index("en"), format_func=languages.__getitem__, key="characters_language"
    )
    samples = [key[0] for key in db.records.get(f"{language}/sentences.tsv", {})]
    said = third.text_input("Sentence", min(samples, key=len, default="mama"), key=f"characters_sentence_{language}", max_chars=500)
    st.query_params["character"] = name
    return name, said.strip() or "mama", language


with shown_errors():
    ask_again()
    name, sentence, language = chosen()
    own = len(overrides(database().records, name, language))
    counted = {OWN: f"{OWN} ({own})"}
    section = st.segmented_control(
        "Section",
        [LINKS, POSES, RULES, OWN, ADD],
        default=LINKS,
        key="characters_section",
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
        add_form()
    else:
        edited = links_editor(name, sentence, language)
    if titles := unsaved(other_than=edited):
        waiting.caption(f":material/edit: Not saved yet elsewhere: {', '.join(titles)}.")
