"""The dashboard: `lipdb dashboard` starts it."""

import streamlit as st
from parts.session import greet

st.set_page_config(page_title="lipdb", page_icon=":material/record_voice_over:", layout="wide")
page = st.navigation(
    [
        st.Page("pages/say.py", title="Say", icon=":material/record_voice_over:", default=True),
        st.Page("pages/curves.py", title="Curves", icon=":material/timeline:"),
    ]
)
greet()
page.run()
