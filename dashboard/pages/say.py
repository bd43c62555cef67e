"""Say: a sentence or a recording becomes a speaking face; every stage can be looked at, every instant explained."""

from __future__ import annotations

import tempfile
from pathlib import Path

import streamlit as st
from parts.charts import STAGE_COLOURS, stages_chart
from parts.lines import LARGEST, played, recorded, spoken
from parts.session import database, shown_errors
from parts.stage import stage

from lipdb import Line, plugins
from lipdb.errors import InputError
from lipdb.performance import Performance

EXAMPLES = {"en": "Hello! Bob may find five blue whales."}
NOBODY = "nobody"


def example(language: str) -> str:
    """A sentence to begin with: the language's shortest sample."""
    samples = [key[0] for key in database().records.get(f"{language}/sentences.tsv", {})]
    return EXAMPLES.get(language) or min(samples, key=len, default="")


def ask() -> tuple[Line | None, str, str]:
    """What is to be said, the character, and the one beside it."""
    db = database()
    languages = {row["language"]: row["name"] for row in db.languages()}
    characters = {row["character"]: row["title"] or row["character"] for row in db.characters()}
    first, second, third, fourth = st.columns([2, 2, 2, 2])
    source = first.segmented_control("From", ["Text", "Recording"], default="Text", key="say_source") or "Text"
    language = second.selectbox(
        "Language", list(languages), index=list(languages).index("en"), format_func=languages.__getitem__, key="say_language"
    )
    character = third.selectbox(
        "Character", list(characters), index=list(characters).index("robin"), format_func=characters.__getitem__, key="say_character"
    )
    beside = fourth.selectbox(
        "Beside it",
        [NOBODY, *characters, *(f"{character} at revision {r.number}" for r in db.store.history(limit=20))],
        key="say_beside",
        format_func=lambda name: characters.get(name, name),
        help="Another character, or this one as the data were before an edit, on the same clock.",
    )
    if source == "Text":
        text = st.text_input("Sentence", example(language), key=f"say_text_{language}", max_chars=2000)
        return (spoken(text, language) if text.strip() else None), character, beside
    left, right = st.columns(2)
    aligned = left.file_uploader("Aligned phones (TextGrid, or a line's .json)", type=["TextGrid", "json"], key="say_grid")
    audio = right.file_uploader("Recording (WAV)", type=["wav"], key="say_wav")
    if aligned is None:
        return None, character, beside
    if any(file is not None and file.size > LARGEST for file in (aligned, audio)):
        raise InputError(f"a file is larger than {LARGEST // 1_000_000} MB; cut the recording into shorter ones")
    suffix = Path(aligned.name).suffix.lower()
    line = recorded(aligned.getvalue(), suffix, audio.getvalue() if audio else None, language, database().store.revision)
    return line, character, beside


def companion(line: Line, beside: str) -> list[Performance]:
    """The performance of who stands beside, if anybody does."""
    if beside == NOBODY:
        return []
    who, _, revision = beside.partition(" at revision ")
    return [played(line, who, past=int(revision) if revision else None)]


def explain(line: Line, character: str, at: float) -> None:
    """Which pair, layer and curve gave each weight at an instant."""
    duration = len(played(line, character).track.weights) - 1
    at = min(max(at, 0.0), duration / played(line, character).track.fps)
    rows = [cause.to_row() for cause in database().explain(line, at=at, character=character)]
    st.write(f"What made the weights at **{at:.2f} s**")
    st.dataframe([row for row in rows if row["pair"] or row["weight"]], hide_index=True)


def look_inside(line: Line, character: str) -> None:
    """The stages of the engine, one colour a stage."""
    made = database().stages(line, character=character)
    left, right = st.columns([1, 2])
    pose = left.selectbox(
        "Pose", ["all", *made.poses], index=1 + list(made.poses).index("open") if "open" in made.poses else 0, key="say_pose"
    )
    shown = right.pills("Stages", list(STAGE_COLOURS), default=list(STAGE_COLOURS), selection_mode="multi", key="say_stages")
    st.altair_chart(stages_chart(made, line.schedule, list(made.poses) if pose == "all" else [pose], list(shown)), width="stretch")


@st.fragment
def download(performance: Performance) -> None:
    """Any output format; it is made when the button is pressed."""
    left, right = st.columns([1, 2], vertical_alignment="bottom")
    suffix = left.selectbox("Format", sorted(plugins.exporters()), index=sorted(plugins.exporters()).index(".csv"), key="say_format")

    def content() -> bytes:
        with tempfile.TemporaryDirectory(prefix="lipdb-") as folder:
            file = Path(folder) / f"line{suffix}"
            performance.save(file)
            return file.read_bytes()

    right.download_button("Download", content, file_name=f"line{suffix}", on_click="ignore", key=f"say_download_{suffix}")


with shown_errors():
    line, character, beside = ask()
    if line is None:
        st.info("Write a sentence, or upload a recording's TextGrid, to see a face speak it.")
        st.stop()
    shown = [played(line, character), *companion(line, beside)]
    for note in line.notes:
        st.caption(f":material/info: {note}")
    picked = stage(shown, key="say_stage", autoplay=True)
    if picked is not None:
        st.session_state["say_at"] = picked
    explained, inside, files = st.tabs(["This instant", "Stages of the engine", "Download"])
    with explained:
        if "say_at" in st.session_state:
            explain(line, character, st.session_state["say_at"])
        else:
            st.caption("Click into the lanes: you see which pair, layer and curve gave each weight at that instant.")
    with inside:
        look_inside(line, character)
    with files:
        download(shown[0])
