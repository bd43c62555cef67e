"""The database behind the pages: one for all visitors."""

from __future__ import annotations

import os

import streamlit as st

import lipdb
from lipdb import Database


@st.cache_resource
def database() -> Database:
    """The database that `lipdb dashboard` was started with."""
    return lipdb.open(os.environ.get("LIPDB_URL"), phonesets=os.environ.get("LIPDB_PHONESETS"))
