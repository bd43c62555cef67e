"""The dashboard: `lipdb dashboard` starts it."""

import streamlit as st

st.set_page_config(page_title="lipdb", page_icon="👄", layout="wide")
st.navigation([st.Page("pages/say.py", title="Say", icon=":material/record_voice_over:", default=True)]).run()
