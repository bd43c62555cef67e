"""Step 1 of adding a language: which one, who speaks it, and a text of it."""

from __future__ import annotations

import streamlit as st
from parts.language_work import WORK, Work, begin, progress, told
from parts.session import as_typed, database, in_words

from lipdb.curated.schema import CODE, USER_SOURCE
from lipdb.errors import InputError
from lipdb.languages.begin import TYPING, draft_of_phones, draft_of_voice
from lipdb.speech.espeak_list import espeak_voices
from lipdb.words import counted

VOICE, TYPED = "A voice of espeak-ng", "No voice: I type the phones"
LARGEST = 4_000_000
"""Bytes of a text; the first 50,000 sentences are looked at."""


def step_language(mine: Work | None) -> None:
    """Ask which language it is, and propose its phones; or say which one is under way."""
    if mine is not None:
        _under_way(mine)
        return
    how = st.segmented_control(
        "Who speaks it?",
        [VOICE, TYPED],
        default=VOICE,
        key="languages_how",
        persist_state="session",
        required=True,
        help="A language without a voice of its own may borrow that of a near one; an invented one may have none, and moves in silence.",
    )
    code, name, voice = _names(spoken=how == VOICE)
    typed = ""
    if how == TYPED:
        typed = st.text_area(
            "Its phones, in IPA", key="languages_typed", persist_state="session", placeholder="p m k l a i u ʃ=sh tʃ=ch", help=f"{TYPING}."
        )
    text, source = _text(needed=how == VOICE)
    if st.button("Propose the phones", type="primary", icon=":material/auto_awesome:", key="languages_propose"):
        with told():
            db = database()
            if how == TYPED:
                begin(draft_of_phones(code, records=db.records, name=name, ipa=typed, text=text or None, source=source))
            elif not voice:
                raise InputError("choose a voice, or type the phones of a language that has none")
            else:
                with progress("The voice reads the text"):
                    begin(draft_of_voice(code, records=db.records, voice=voice, name=name, text=text or None, source=source))
            st.rerun()


def _names(*, spoken: bool) -> tuple[str, str, str]:
    """Code, name and voice, as they were typed or as the voice suggests them."""
    voices = dict(sorted(espeak_voices().items(), key=lambda item: item[1])) if spoken else {}
    columns = st.columns([3, 3, 2] if spoken else [3, 2])
    voice = ""
    if spoken:
        voice = (
            columns[0].selectbox(
                "Voice",
                list(voices),
                index=None,
                format_func=lambda one: f"{voices[one]} ({one})",
                key="languages_voice",
                persist_state="session",
                placeholder="Type to search: Polish, Swahili, …",
                help="Its own, or that of a language that sounds alike: what it says is then mapped for yours.",
            )
            or ""
        )
    there = {row["language"] for row in database().languages()}
    own = voice.replace("-", "_") if voice else ""
    suggested = own if CODE.fullmatch(own) and own not in there else ""
    name = columns[-2].text_input(
        "Name", key="languages_name", persist_state="session", placeholder=voices.get(voice, "What it is called in English"), max_chars=80
    )
    code = columns[-1].text_input(
        "Code",
        key="languages_code",
        persist_state="session",
        placeholder=suggested or "pl, or qpa if invented",
        max_chars=16,
        help="Two or three small letters (ISO 639; qaa to qtz are free for invented ones), with a word behind it for a variety: pl_east.",
    )
    if voice in there:
        st.caption(f":material/info: {voices[voice]} is there already; give yours another code, or edit that one under Languages.")
    return code.strip() or suggested, name.strip() or voices.get(voice, ""), voice


def _text(*, needed: bool) -> tuple[str, str]:
    """A text of the language, pasted and uploaded, and whose it is. Without one a voice reads numbers and letters."""
    help_text = "A few hundred sentences, if you can: every phone should occur. Up to 200 that show most become its sample sentences."
    typed = st.text_area("A text of the language", key="languages_text", persist_state="session", height=160, help=help_text)
    left, right = st.columns(2)
    file = left.file_uploader("Or a file (UTF-8)", type=["txt", "md", "csv", "tsv"], key="languages_file", max_upload_size=4)
    sources = {key[0]: row["title"] for key, row in database().records.get("sources.tsv", {}).items()}
    source = right.selectbox(
        "Whose text is it?",
        list(sources),
        index=list(sources).index(USER_SOURCE) if USER_SOURCE in sources else 0,
        format_func=lambda one: f"{one}: {sources[one]}",
        key="languages_source",
        persist_state="session",
        help="It is kept beside every sentence. `user` is your own work.",
    )
    with told():
        if file is not None:
            typed = f"{typed}\n{_read(file.getvalue(), file.name)}"
    if needed and not typed.strip():
        st.caption(":material/info: Without a text the voice reads numbers and letters: most phones of most languages, but no sentences.")
    return typed.strip(), source


def _read(data: bytes, name: str) -> str:
    if len(data) > LARGEST:
        raise InputError(f"{name} is larger than {LARGEST // 1_000_000} MB; a few hundred sentences are enough")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{name} is no UTF-8 text (byte {error.start + 1}); save it as UTF-8") from error


def _under_way(mine: Work) -> None:
    draft = mine.draft
    voice = "no voice, its text is read in silence" if draft.silent else f"voice {draft.row['voice']}"
    st.write(
        f"You are adding **{as_typed(draft.row['name'])}** (`{draft.code}`; {voice}): {counted(len(draft.entries), 'phone')}, "
        f"{counted(len(draft.sentences), 'sample sentence')}."
    )
    for note in draft.notes:
        st.caption(f":material/info: {in_words(note)}")
    with st.popover("Begin another language", icon=":material/delete:"):
        st.write("What is saved stays." if mine.kept else f"Nothing of {draft.row['name']} is saved yet; it would be gone.")
        if st.button("Put it away" if mine.kept else "Throw it away", key="languages_discard", type="primary"):
            del st.session_state[WORK]
            for field in ("languages_name", "languages_code", "languages_typed", "languages_text", "languages_voice"):
                st.session_state.pop(field, None)
            st.rerun()
