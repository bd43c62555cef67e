"""Choosing a phone pair: by a word, by its two phones, or in the matrix of all pairs; and text that needs it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import altair as alt
import pandas as pd
import streamlit as st
from parts.lines import spoken
from parts.session import database, in_words, shown_errors
from streamlit.delta_generator import DeltaGenerator

from lipdb import Database, Line
from lipdb.curves.draft import KINDS, Place
from lipdb.curves.rehearse import usual_lengths
from lipdb.decisions import ORIGINS, PairUse
from lipdb.errors import LipdbError
from lipdb.languages.examples import Examples, pairs_in_order
from lipdb.schedule import SILENCE

WORD = "low"
CHOICE, ADDRESS, PICKED = "curves_choice", "curves_address", "curves_picked"
CURVES = str(Path(__file__).parents[1] / "pages" / "curves.py")
LISTENED = 4
"""Sentences from which the usual lengths of a pair's phones are taken."""
CELL = 25
"""Pixels of a pair in the matrix."""
ORIGIN_COLOURS = dict(zip(ORIGINS, ("#009e73", "#56b4e9", "#0072b2", "#e69f00", "#d55e00"), strict=True))


@dataclass
class Choice:
    """What the visitor looks at; it outlives the widgets, which Streamlit forgets when another page is shown."""

    left: str = "l"
    right: str = "ow"
    language: str = "en"
    character: str = "robin"
    kind: str = KINDS[0]
    word: str = WORD

    @property
    def pair(self) -> str:
        """The pair as people write it."""
        return f"{self.left}-{self.right}"

    @property
    def address(self) -> dict[str, str]:
        """The choice as the address of the page has it."""
        return {"pair": self.pair, "language": self.language, "character": self.character, "kind": self.kind}


def choice() -> Choice:
    """The visitor's choice: as the address says, if it is one that this page has not written itself, or as it was."""
    chosen: Choice = st.session_state.setdefault(CHOICE, Choice())
    address = st.query_params.to_dict()
    # Another page, a link, or back and forth in the browser. What was just picked counts: the address still comes after it.
    if not st.session_state.pop(PICKED, False) and address and address != st.session_state.get(ADDRESS):
        for name in ("language", "character", "kind"):
            setattr(chosen, name, address.get(name, getattr(chosen, name)))
        left, dash, right = address.get("pair", "").partition("-")
        if dash:
            chosen.left, chosen.right, chosen.word = left, right, ""
    return chosen


def open_pair(left: str, right: str, **where: str) -> None:
    """Go to the page Curves, to this pair; *where* may name ``language``, ``character`` and ``kind`` of layer."""
    chosen: Choice = st.session_state.get(CHOICE, Choice())
    # The whole address goes along: if Curves had to complete it, the browser's way back would lead to Curves once more.
    st.switch_page(CURVES, query_params={**chosen.address, **where, "pair": f"{left}-{right}"})


def take(left: str, right: str) -> None:
    """Choose a pair."""
    chosen: Choice = st.session_state[CHOICE]
    chosen.left, chosen.right = left, right
    st.session_state[PICKED] = True


def remember(chosen: Choice, *, arrived: bool) -> None:
    """Put the choice into the address, so that it can be loaded again or sent to somebody.

    Who goes back to an address without a choice and has not *arrived* from another page is on the way out: it stays.
    """
    if st.query_params.to_dict() != chosen.address and (arrived or chosen.address != st.session_state.get(ADDRESS)):
        st.query_params.from_dict(chosen.address)
    st.session_state[ADDRESS] = chosen.address


def ask() -> Place:
    """Ask for language, character, layer and pair. Raises `LipdbError`."""
    db, chosen = database(), choice()
    arrived = "curves_word" not in st.session_state  # Streamlit forgets the widgets of a page that is left
    languages = {row["language"]: row["name"] for row in db.languages()}
    characters = {row["character"]: row["title"] or row["character"] for row in db.characters()}
    phones = sorted((key[0] for key in db.records["common.tsv"]), key=lambda phone: (phone == SILENCE, phone))
    _keep_known(chosen, languages, characters, phones)
    columns = st.columns([9, 5, 5, 7, 9, 12], vertical_alignment="bottom")
    asked: tuple[tuple[DeltaGenerator, str, str, list[str], dict[str, str]], ...] = (
        (columns[1], "left", "From", phones, {}),
        (columns[2], "right", "To", phones, {}),
        (columns[4], "language", "Language", list(languages), languages),
        (columns[5], "character", "Character", list(characters), characters),
    )
    for column, name, label, options, shown in asked:
        st.session_state[f"curves_{name}"] = getattr(chosen, name)
        value = column.selectbox(label, options, key=f"curves_{name}", format_func=partial(_shown, shown), on_change=picked, args=(name,))
        setattr(chosen, name, value)
    st.session_state["curves_word"] = chosen.word
    columns[0].text_input("A word, and its pairs", key="curves_word", max_chars=200, placeholder="low", on_change=_typed)
    if columns[3].button("All pairs", icon=":material/grid_on:", key="curves_matrix", width="stretch"):
        _matrix(chosen.language, chosen.character)
    _pairs_of_word(chosen)
    remember(chosen, arrived=arrived)
    return Place(chosen.left, chosen.right, db.character(chosen.character).pose_set, chosen.language, chosen.character, chosen.kind)


def _keep_known(chosen: Choice, languages: dict[str, str], characters: dict[str, str], phones: list[str]) -> None:
    """An address may name what there is not, or no longer."""
    usual = Choice()
    for name, known in (("language", languages), ("character", characters), ("left", phones), ("right", phones), ("kind", KINDS)):
        if getattr(chosen, name) not in known:
            setattr(chosen, name, getattr(usual, name))


def picked(name: str) -> None:
    """Take over what the visitor chose in the widget of *name*."""
    setattr(st.session_state[CHOICE], name, st.session_state[f"curves_{name}"])
    st.session_state[PICKED] = True


def _typed() -> None:
    chosen: Choice = st.session_state[CHOICE]
    chosen.word = st.session_state["curves_word"].strip()
    try:
        pairs = pairs_in_order(spoken(chosen.word, chosen.language)) if chosen.word else []
    except LipdbError:
        return  # It is shown where the pairs would be.
    if pairs:
        take(*next((pair for pair in pairs if SILENCE not in pair), pairs[0]))


def _pairs_of_word(chosen: Choice) -> None:
    if not chosen.word:
        return
    try:
        pairs = pairs_in_order(spoken(chosen.word, chosen.language))
    except LipdbError as error:
        st.caption(f":material/error: {in_words(error)}")
        return
    names = {f"{left}-{right}": (left, right) for left, right in pairs}
    st.session_state["curves_of_word"] = chosen.pair if chosen.pair in names else None

    def other() -> None:
        if st.session_state["curves_of_word"]:
            take(*names[st.session_state["curves_of_word"]])

    st.pills("Pairs of the word", list(names), key="curves_of_word", on_change=other, label_visibility="collapsed")


@st.dialog("All pairs", width="medium")
def _matrix(language: str, character: str) -> None:
    """Every pair by where its curves come from; a click chooses one."""
    with shown_errors():
        uses = every_pair(language, character, database().store.revision)
    st.caption("Click a pair to edit its curves; the dot marks the one that is open.")
    event = st.altair_chart(_matrix_chart(uses, choice()), key="curves_cells", on_select="rerun", selection_mode="pair", width="content")
    cells = event.selection.get("pair") or []
    if cells:
        take(cells[0]["left"], cells[0]["right"])
        st.session_state[CHOICE].word = ""
        st.rerun()


@st.cache_resource(max_entries=16, show_spinner=False)
def every_pair(language: str, character: str, revision: int) -> list[PairUse]:  # noqa: ARG001  (the revision decides)
    """What every pair of common phones uses today, without counts."""
    names = [key[0] for key in database().records["common.tsv"]]
    counts = {(left, right): 0.0 for left in names for right in names if (left, right) != (SILENCE, SILENCE)}
    return database().uses(counts, language=language, character=character)


def _shown(titles: Mapping[str, str], name: str) -> str:
    return titles.get(name, name)


def _matrix_chart(uses: list[PairUse], chosen: Choice) -> alt.LayerChart | alt.FacetChart:
    rows = [{"left": use.left, "right": use.right, "origin": use.origin, "layer": use.layer} for use in uses]
    order = sorted({use.left for use in uses}, key=lambda phone: (phone == SILENCE, phone))
    click = alt.selection_point(name="pair", fields=["left", "right"], on="click", clear=False)
    there = [origin for origin in ORIGINS if any(row["origin"] == origin for row in rows)]
    colours = alt.Scale(domain=there, range=[ORIGIN_COLOURS[origin] for origin in there])
    legend = alt.Legend(orient="bottom", title="where its curves come from", symbolStrokeWidth=0)
    cells = alt.Chart(pd.DataFrame(rows), width=alt.Step(CELL), height=alt.Step(CELL)).encode(
        x=alt.X("right:N", sort=order, title="to", axis=alt.Axis(orient="top", labelAngle=0, labelOverlap=False, labelFlush=False)),
        y=alt.Y("left:N", sort=order, title="from", axis=alt.Axis(labelOverlap=False, labelFlush=False)),
        tooltip=["left:N", "right:N", "origin:N", "layer:N"],
    )
    here = (alt.datum.left == chosen.left) & (alt.datum.right == chosen.right)
    return alt.layer(
        cells.mark_rect(stroke="white", strokeWidth=1, cursor="pointer")
        .encode(color=alt.Color("origin:N", scale=colours, legend=legend))
        .add_params(click),
        cells.mark_point(shape="circle", color="black", filled=True, size=60).transform_filter(here),
    )


@st.cache_resource(max_entries=24, show_spinner="Reading the sample sentences…")
def _examples(_db: Database, language: str, character: str, digest: int) -> Examples:  # noqa: ARG001  (the digest decides)
    return Examples(_db, language, character)


def examples(db: Database, language: str, character: str) -> Examples:
    """The sample sentences of *language* as *character* says them; edits of curves do not make them anew."""
    shared = ("common.tsv", "ipa.tsv", f"characters/{character}/mapping.tsv")
    decisive = [
        (path, rows) for path, rows in db.records.items() if path in shared or (path.startswith(f"{language}/") and "/curves/" not in path)
    ]
    return _examples(db, language, character, hash(repr(decisive)))


def usual(place: Place) -> tuple[float, float]:
    """How long the two phones usually last, where the language's sentences have them as a pair."""
    known: dict[tuple[str, ...], tuple[float, float]] = st.session_state.setdefault("curves_usual", {})
    key = place.left, place.right, place.language
    if key not in known:
        lines = heard(place.left, place.right, language=place.language, character=place.character)
        known[key] = usual_lengths((line.schedule for line in lines), place.left, place.right)
    return known[key]


def heard(left: str, right: str, *, language: str, character: str) -> list[Line]:
    """Sentences that have the pair, as *language*'s own voice says them: a few that tell how long its phones last."""
    return [spoken(sentence, language) for sentence in examples(database(), language, character).containing(left, right)[:LISTENED]]
