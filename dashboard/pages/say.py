"""Say: a sentence or a recording becomes a speaking face; every stage can be looked at, every instant explained."""

from __future__ import annotations

from pathlib import Path

import streamlit as st
from parts.downloads import download
from parts.instant import explain
from parts.lines import EXAMPLES, LARGEST, key_of, played, recorded, spoken, staged
from parts.session import database, in_words, shown_errors
from parts.stage import stage

from lipdb import Line, plugins
from lipdb.database import DEFAULT_CHARACTER, DEFAULT_LANGUAGE

LONG = 12.0  # seconds of a line that the chart of the stages shows at once

Beside = tuple[str, int | None]  # a character, and the revision of the data that moves it; None for today's
NOBODY: Beside = ("", None)  # not None: Streamlit takes that for an empty field, and offers to clear it


def example(language: str) -> str:
    """A sentence to begin with: the language's shortest sample."""
    samples = [key[0] for key in database().records.get(f"{language}/sentences.tsv", {})]
    return EXAMPLES.get(language) or min(samples, key=len, default="")


def voice_title(name: str) -> str:
    """A voice as people read it: ``en-us+f2`` is *en-us, f2*."""
    return name.replace("+", ", ")


def ask() -> tuple[Line | None, str, Beside]:
    """What is to be said, the character, and who stands beside."""
    db = database()
    languages = {row["language"]: row["name"] for row in db.languages()}
    characters = {row["character"]: row["title"] or row["character"] for row in db.characters()}
    first, second, third, fourth, fifth = st.columns([14, 15, 13, 19, 19])
    source = first.segmented_control("From", ["Text", "Recording"], default="Text", key="say_source") or "Text"
    language = second.selectbox(
        "Language",
        languages,
        index=_place(languages, st.session_state.get("say_open", DEFAULT_LANGUAGE)),
        format_func=languages.__getitem__,
        key="say_language",
    )
    voices = db.voices(language)
    voice = third.selectbox("Voice", voices, format_func=voice_title, key=f"say_voice_{language}", disabled=source != "Text")
    character = fourth.selectbox(
        "Character", characters, index=_place(characters, DEFAULT_CHARACTER), format_func=characters.__getitem__, key="say_character"
    )
    beside = fifth.selectbox(
        "Beside it",
        [NOBODY, *((name, None) for name in characters if name != character), *_versions(character)],
        format_func=lambda one: _beside_title(one, characters),
        key="say_beside",
        help="Another character, or this one as the data were before an edit, on the same clock.",
    )
    if source == "Text":
        text = st.text_input("Sentence", example(language), key=f"say_text_{language}")
        return (spoken(text, language, voice) if text.strip() else None), character, beside
    return _recording(language), character, beside


def _place(names: dict[str, str], name: str) -> int:
    return list(names).index(name) if name in names else 0


def _versions(character: str) -> list[Beside]:
    """The character before each of the last edits."""
    return [(character, revision.number - 1) for revision in database().store.history(limit=20) if revision.number > 1]


def _beside_title(one: Beside, characters: dict[str, str]) -> str:
    if one == NOBODY:
        return "nobody"
    name, past = one
    return characters.get(name, name) if past is None else f"as it was at revision {past}"


def _recording(language: str) -> Line | None:
    """The uploaded recording with its phones, once there is one."""
    left, right = st.columns(2)
    suffixes = sorted({*plugins.readers(), ".json"})
    aligned = left.file_uploader(
        f"Aligned phones ({', '.join(suffixes)})",
        type=[suffix[1:] for suffix in suffixes],
        key="say_grid",
        max_upload_size=LARGEST // 1_000_000,
    )
    audio = right.file_uploader("Recording (.wav)", type=["wav"], key="say_wav", max_upload_size=LARGEST // 1_000_000)
    guess = left.checkbox("Map unknown symbols by articulation", key="say_guess", help="Otherwise the line stops at the first one.")
    if aligned is None:
        return None
    suffix = Path(aligned.name).suffix.lower()
    sound = audio.getvalue() if audio else None
    return recorded(aligned.getvalue(), suffix, sound, language, database().store.revision, allow_unknown=guess)


def look_inside(line: Line, character: str) -> None:
    """The stages of the engine, one colour a stage."""
    # Imported here: Altair takes seconds to import, and the first face should not wait for it.
    from parts.stages import STAGE_COLOURS, stages_chart

    made = staged(line, character)
    left, right = st.columns([1, 3])
    poses = list(made.poses)
    pose = left.selectbox("Pose", ["all", *poses], index=1 + poses.index("open") if "open" in poses else 0, key="say_pose")
    shown = right.pills("Stages", list(STAGE_COLOURS), default=list(STAGE_COLOURS), selection_mode="multi", key="say_stages")
    seconds = len(made.track.weights) / made.track.fps
    window = (0.0, seconds)
    if seconds > LONG:
        window = st.slider("Seconds", 0.0, round(seconds, 1), (0.0, LONG), key="say_window")
    if not shown:
        st.info("Choose a stage to see it.")
        return
    chosen = poses if pose == "all" else [pose]
    st.altair_chart(stages_chart(made, line.schedule, chosen, list(shown), window=window), width="stretch", key="say_chart")


@st.fragment
def show(line: Line, character: str, beside: Beside) -> None:
    """The player, and under it what can be asked of the line. A click into the lanes runs this part only."""
    with shown_errors():
        shown = [played(line, character)]
        if beside != NOBODY:
            shown.append(played(line, beside[0], past=beside[1]))
        picked = stage(shown, key="say_stage", autoplay=True)
        if picked is not None:
            st.session_state["say_at"] = key_of(line), picked
        instant, inside, files = st.tabs(["This instant", "Stages of the engine", "Download"], key="say_tab", on_change="rerun")
        if instant.open:
            with instant:
                of, at = st.session_state.get("say_at", ("", 0.0))
                if of == key_of(line):
                    explain(line, character, at)
                else:
                    st.caption("Click into the lanes: you see which pair, layer and curve gave each weight at that instant.")
        if inside.open:
            with inside:
                look_inside(line, character)
        if files.open:
            with files:
                download(shown[0], key="say")


with shown_errors():
    line, character, beside = ask()
    if line is None:
        if st.session_state["say_source"] == "Recording":
            st.info(
                "Upload the phones of a recording, and the recording itself to hear it. An aligner, such as the Montreal Forced Aligner, "
                "writes them as a Praat TextGrid.",
                icon=":material/upload_file:",
            )
        else:
            st.info("Write a sentence to see a face speak.", icon=":material/keyboard:")
        st.stop()
for note in line.notes:
    st.caption(f":material/info: {in_words(note)}")
show(line, character, beside)
