"""Who can reach the dashboard."""

from __future__ import annotations

import streamlit as st
from parts.session import sign_in_configured

from lipdb.network import is_local


def only_from_here() -> bool:
    """Whether visitors sit at this machine, whose files are theirs: no sign-in, localhost, and no proxy that lets others in."""
    return not sign_in_configured() and is_local(st.get_option("server.address")) and "X-Forwarded-For" not in st.context.headers
