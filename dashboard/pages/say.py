"""Say: a sentence becomes a speaking face."""

import streamlit as st
from parts.data import database
from parts.stage import stage

db = database()
languages = {row["language"]: row["name"] for row in db.languages()}
characters = {row["character"]: row["title"] for row in db.characters()}
left, middle, right = st.columns([4, 1, 1])
text = left.text_input("Sentence", "Hello! Bob may find five blue whales.")
language = middle.selectbox("Language", languages, index=list(languages).index("en"), format_func=languages.get)
character = right.selectbox("Character", characters, index=list(characters).index("robin"))
line = db.say(text, language=language)
picked = stage([db.animate(line, character=character)], key="stage")
if picked is not None:
    st.write(picked)
