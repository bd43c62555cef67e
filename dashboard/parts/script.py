"""A visitor's own script: which pairs it needs that nobody has drawn yet, and in which lines. It stays in the visitor's session."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from functools import partial

import pandas as pd
import streamlit as st
from parts.pairs import open_pair
from parts.pairs_table import keep, pairs_table
from parts.session import database

from lipdb.coverage.reports.gaps import gaps
from lipdb.coverage.reports.script import Script, decoded, read_script
from lipdb.decisions import PairUse
from lipdb.errors import InputError
from lipdb.progress import reported
from lipdb.words import counted

LARGEST = 1_000_000
"""Bytes of a script: two long novels."""
LISTED, NUMBERS = 5, 40
"""Lines left out that are told one by one, and numbers of lines told for a pair."""
READ = "coverage_script_read"


def ask_script(languages: Sequence[str], character: str, *, silence: bool) -> None:
    """Ask for a script and show what it needs. Raises `InputError`."""
    left, right = st.columns([3, 2], gap="medium")
    names = {row["language"]: row["name"] for row in database().languages()}
    language = right.selectbox(
        "Language of the script", languages, format_func=names.__getitem__, key=keep(f"coverage_script_language {languages}", languages[0])
    )
    pasted = left.text_area(
        "Script",
        key=keep("coverage_script", ""),
        height=180,
        placeholder="Paste a scene here: each line as somebody will speak it.",
    )
    file = right.file_uploader(
        "Or a text file", type=["txt"], key="coverage_script_file", help="UTF-8.", max_upload_size=LARGEST // 1_000_000
    )
    if (file.size if file else len(pasted.encode())) > LARGEST:
        raise InputError(f"a script of more than {LARGEST // 1_000_000} MB is a corpus: count it under Corpora")
    text = decoded(file.getvalue()) if file else pasted
    if not text.strip():
        st.info("Paste a scene, or upload it: you see at once which of its pairs have no authored curves yet, and in which lines.")
        return
    show_script(_read(text, language), language, character, silence=silence)


def _read(text: str, language: str) -> Script:
    """The script, read once in this session as long as the data stay."""
    key = hashlib.sha256(text.encode()).hexdigest(), language, database().store.revision
    if st.session_state.get(READ, ("",))[0] != key:
        bar = st.progress(0.0, "Reading…")

        def told(_: str, done: int, total: int) -> None:
            bar.progress(done / total, f"Reading: {done:,} of {total:,} lines")

        try:
            with reported(told):
                script = read_script(text, database().voice(language), database().phoneset(language))
        finally:
            bar.empty()
        st.session_state[READ] = key, script
    found: Script = st.session_state[READ][1]
    return found


def show_script(script: Script, language: str, character: str, *, silence: bool) -> None:
    """How many pairs the script needs, which are missing, and the lines that need them."""
    uses = database().uses(script.frequency(silence=silence).counts, language=language, character=character)
    missing = [gap.use for gap in gaps(uses)]
    spoken = len(script.lines) - len(script.left_out)
    st.subheader(f"This scene: {counted(len(uses), 'pair')}, {len(uses) - len(missing)} authored or fitted")
    st.caption(f"Lines read as {database().language(language)['name']}: {spoken} of {len(script.lines)}.")
    for line in script.left_out[:LISTED]:
        st.caption(f":material/info: line {line.number} is left out: {line.left_out}")
    if len(script.left_out) > LISTED:
        st.caption(f":material/info: {counted(len(script.left_out) - LISTED, 'more line is', 'more lines are')} left out")
    if not missing:
        st.success("Every pair of this script has authored or fitted curves.", icon=":material/done_all:")
        return
    left, right = st.columns([2, 3], gap="medium")
    with left:
        st.write("**Pairs without authored curves**, the most needed first")
        pairs_table(
            _by_pair(script, missing),
            [use.pair for use in missing],
            partial(open_pair, language=language, character=character),
            key="coverage_missing",
        )
    with right:
        st.write("**Lines** and the pairs that they still need")
        st.dataframe(
            _by_line(script, missing),
            hide_index=True,
            key="coverage_lines",
            # What is pinned keeps its width: the room that is left is for what is said and what it needs.
            column_config={
                "line": st.column_config.NumberColumn(width=50, pinned=True),
                "open": st.column_config.NumberColumn(width=55, pinned=True, help="Pairs that nobody has drawn or fitted"),
                "text": st.column_config.TextColumn(width=220),
                "missing": st.column_config.ListColumn("pairs", width=230),
            },
        )


def _by_pair(script: Script, missing: Sequence[PairUse]) -> pd.DataFrame:
    rows = []
    for use in missing:
        lines = script.needing(use.pair)
        numbers = ", ".join(str(line.number) for line in lines[:NUMBERS]) + (
            f" and {len(lines) - NUMBERS:,} more" if len(lines) > NUMBERS else ""
        )
        rows.append(
            {
                "pair": "-".join(use.pair),
                "count": use.count,
                "lines": numbers,
                "origin": use.origin,
                "layer": use.layer,
            }
        )
    return pd.DataFrame(rows)


def _by_line(script: Script, missing: Sequence[PairUse]) -> pd.DataFrame:
    pairs = [use.pair for use in missing]
    rows = [
        {"line": line.number, "open": len(needed), "text": line.text, "missing": needed}
        for line in script.lines
        for needed in [["-".join(pair) for pair in pairs if pair in line.pairs]]
        if not line.left_out
    ]
    return pd.DataFrame(rows)
