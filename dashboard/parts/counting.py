"""The scans of the register, and counting a corpus that a visitor uploads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import streamlit as st
from parts.corpora import Corpus, corpora
from parts.session import database, visitor, writable

from lipdb.coverage.apart import kept, scan_apart
from lipdb.coverage.register import CURRENT, EXACT, FAST
from lipdb.coverage.result import read_result
from lipdb.errors import InputError
from lipdb.progress import reported

LARGEST = 32_000_000
"""Bytes of all files of a corpus together."""
SUFFIXES = {".txt": ".txt", ".textgrid": ".TextGrid"}
MODES = {EXACT: "exact: every line as it is said", FAST: "fast: every word once, for millions of words"}
DONE = "coverage_done"
NUMBER = st.column_config.NumberColumn(format="localized")


def show_scans(languages: Sequence[str]) -> None:
    """The scans of *languages*: a click shows what was left out, a button counts a stale one again."""
    found = [corpus for corpus in corpora(languages, every=True) if corpus.scan]
    if done := st.session_state.pop(DONE, None):
        show_done(done)
    if not found:
        below = " Count a text of your own below." if visitor().editor else ""
        st.info(f"Nothing is counted in these languages yet: what you see is of their example sentences.{below}")
        return
    event = st.dataframe(
        pd.DataFrame([_row(corpus) for corpus in found]),
        hide_index=True,
        key="coverage_scans",
        column_config=dict.fromkeys(("pairs", "lines", "documents"), NUMBER),
        on_select="rerun",
        selection_mode="single-cell",
    )
    st.caption("Click a scan to see what was left out.")
    for corpus in found:
        if corpus.state != CURRENT:
            _offer_again(corpus)
    for row, _ in event.selection.cells[:1]:
        st.write(f"**{found[row].title}**")
        show_findings(_told(found[row]).get("findings", []))


def _row(corpus: Corpus) -> dict[str, Any]:
    scan = corpus.scan
    assert scan is not None
    totals = {name: scan.totals.get(name) for name in ("pairs", "lines", "documents")}
    return {
        "number": scan.id,
        "corpus": corpus.title,
        "language": scan.language,
        "mode": scan.mode,
        "state": corpus.state,
        **totals,
        "counted (UTC)": scan.time.replace("T", " ")[:16],
    }


def _told(corpus: Corpus) -> Mapping[str, Any]:
    try:
        return read_result(Path(corpus.scan.path)) if corpus.scan else {}
    except (OSError, ValueError):
        return {}


def _offer_again(corpus: Corpus) -> None:
    scan = corpus.scan
    assert scan is not None
    left, right = st.columns([5, 1], vertical_alignment="center")
    why = "its phones are mapped differently now" if corpus.state != "missing" else "its result is no longer there"
    left.warning(f"{corpus.title} ({scan.language}) is {corpus.state}: {why}.", icon=":material/update:")
    if right.button("Count again", key=f"coverage_again_{scan.id}", width="stretch", disabled=not visitor().editor):
        run(scan.corpus, language=scan.language, mode=scan.mode, title=corpus.title)


def ask_corpus(languages: Sequence[str]) -> None:
    """Ask for a corpus and count it. Raises `LipdbError`."""
    st.write("**Count a corpus**")
    if not visitor().editor:
        st.info("Only editors count corpora, for the result is there for everybody. Your own script can be read under Your script.")
        return
    names = {row["language"]: row["name"] for row in database().languages()}
    with st.form("coverage_count", border=True):
        left, right = st.columns([3, 2], gap="medium")
        files = left.file_uploader(
            "Texts, or aligned recordings (TextGrid)", type=["txt", "TextGrid"], accept_multiple_files=True, key="coverage_files"
        )
        language = right.selectbox("Language", languages, format_func=names.__getitem__, key="coverage_count_language")
        mode = right.radio("How", list(MODES), format_func=MODES.__getitem__, key="coverage_mode")
        left.caption(
            f"Up to {LARGEST // 1_000_000} MB together; more with `lipdb coverage scan`. Texts and counts stay with the database, for all."
        )
        asked = right.form_submit_button("Count", type="primary", width="stretch")
    if asked:
        count(files, language=language, mode=mode)


def count(files: Sequence[Any], *, language: str, mode: str) -> None:
    """Count uploaded *files*. Raises `LipdbError`."""
    db, _ = writable()
    if not files:
        raise InputError("there is nothing to count yet; choose a text file first")
    if sum(file.size for file in files) > LARGEST:
        raise InputError(f"the files are larger than {LARGEST // 1_000_000} MB together; count them with `lipdb coverage scan`")
    suffixes = [SUFFIXES.get(Path(file.name).suffix.lower(), ".txt") for file in files]
    paths = [kept(file.getvalue(), db.store.scans_folder, suffix=suffix) for file, suffix in zip(files, suffixes, strict=True)]
    run([str(path) for path in paths], language=language, mode=mode, title=", ".join(file.name for file in files)[:200])


def run(paths: Sequence[str], *, language: str, mode: str, title: str) -> None:
    """Count in a process of its own, with a bar; leaving the page stops it, and what is counted is kept. Raises `LipdbError`."""
    writable()
    bar = st.progress(0.0, "Starting to count…")

    def told(_: str, done: int, total: int) -> None:
        bar.progress(done / total, f"Counting: {done / 1e6:.1f} of {total / 1e6:.1f} MB")

    with reported(told):
        st.session_state[DONE] = scan_apart(paths, language=language, mode=mode, title=title)
    st.rerun()


def show_done(done: Mapping[str, Any]) -> None:
    """What came of counting."""
    spoken, lines = f"{done['spoken']:,}", f"{done['lines']:,}"
    if done["pairs"]:
        st.success(f"{done['pairs']:,} pairs in {spoken} of {lines} lines. It is chosen above now.", icon=":material/check:")
    else:
        st.error("Nothing in it can be counted; give text in the language that you chose.", icon=":material/error:")
    if error := done.get("error"):
        st.caption(f"Fast: total variation distance from exact {error['total_variation']:.4f} ± {error['spread']:.4f}.")
    show_findings(done["findings"])


def show_findings(findings: Sequence[Mapping[str, Any]]) -> None:
    """What was left out or read otherwise than a person may expect."""
    if not findings:
        st.caption("Nothing was left out.")
        return
    rows = [
        {
            "": "left out" if row["left_out"] else "read so",
            "count": row["count"],
            "of": row["unit"],
            "why": row["meaning"],
            "for example": row["example"],
        }
        for row in findings
    ]
    st.dataframe(pd.DataFrame(rows), hide_index=True, column_config={"count": NUMBER})
