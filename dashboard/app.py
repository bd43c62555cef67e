"""The dashboard: `lipdb dashboard` starts it."""

from pathlib import Path

import streamlit as st
from parts.ahead import fetch_ahead
from parts.leaving import tell_browser
from parts.looks import theme
from parts.session import greet

# An icon of its own: Streamlit would fetch one by name from the internet.
PARTS = Path(__file__).parent / "parts"
SIDEBAR = 220  # pixels; faces, lanes and tables need the rest
st.set_page_config(page_title="lipdb", page_icon=str(PARTS / "mark.svg"), layout="wide", initial_sidebar_state=SIDEBAR)
st.logo(str(PARTS / "wordmark.svg"), size="large", icon_image=str(PARTS / "mark.svg"))
st.html(PARTS / "page.css")
# Dialogs and popovers stand beside the app, which alone has the scheme of the theme.
st.html(f"<style>:root {{ color-scheme: {theme()}; }}</style>")
st.html(f"<script>{(PARTS / 'page.js').read_text('utf-8')}</script>", unsafe_allow_javascript=True)
page = st.navigation(
    [
        st.Page("pages/say.py", title="Say", icon=":material/record_voice_over:", default=True),
        st.Page("pages/curves.py", title="Curves", icon=":material/timeline:"),
        st.Page("pages/coverage.py", title="Coverage", icon=":material/grid_on:"),
        st.Page("pages/languages.py", title="Languages", icon=":material/translate:"),
        st.Page("pages/characters.py", title="Characters", icon=":material/face:"),
        st.Page("pages/history.py", title="History", icon=":material/history:"),
    ]
)
greet()
told = st.container()  # above the page, so that it stays where it is
try:
    page.run()
finally:  # also of a page that stops
    with told:
        tell_browser()
fetch_ahead()
