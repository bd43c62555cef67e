"""Coverage: which pairs real text needs, which curves they use today, what to draw next, what a script still lacks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd
import streamlit as st
from parts.corpora import Corpus, corpora, usual
from parts.counting import ask_corpus, show_scans
from parts.pairs import every_pair, open_pair
from parts.pairs_chart import COLOURINGS, OFTEN, figure_two, heat_map, table_of, work_chart
from parts.pairs_table import keep, one_of, pairs_table
from parts.script import ask_script
from parts.session import as_typed, database, shown_errors

from lipdb.coverage.reports.frequency import Frequency
from lipdb.coverage.reports.gaps import MINUTES, gaps, outlook
from lipdb.coverage.reports.named import named_frequency
from lipdb.coverage.reports.report import LEVELS, Summary, by_curve, ranked
from lipdb.coverage.reports.several import balanced, summed, together
from lipdb.curated.schema import BY_HAND
from lipdb.decisions import PairUse
from lipdb.schedule import SILENCE

MATRIX, FREQUENCY, TO_DO, SCRIPT, CORPORA = VIEWS = ("Pairs", "Frequency", "To do", "Your script", "Corpora")
TABLE_TWO = 21
PAPER = "xu2013"


@dataclass(frozen=True)
class Chosen:
    """What the visitor looks at: *frequency* of all that is chosen, and that of each of *languages*."""

    languages: Sequence[str]
    character: str
    corpora: Sequence[Corpus]
    by_language: Mapping[str, Frequency]
    frequency: Frequency
    uses: Sequence[PairUse]

    def go(self, left: str, right: str) -> None:
        """Open a pair in Curves, in the language that needs it most."""
        language = max(self.languages, key=lambda name: self.by_language[name].share((left, right)))
        open_pair(left, right, language=language, character=self.character)

    @property
    def needed(self) -> list[PairUse]:
        """The pairs that occur."""
        return [use for use in self.uses if use.count]


def ask() -> Chosen:
    """Ask for languages, texts and character. Stops the page when there is nothing to show."""
    db = database()
    names = {row["language"]: row["name"] for row in db.languages()}
    characters = {row["character"]: row["title"] or row["character"] for row in db.characters()}
    first, second, third, fourth = st.columns([3, 4, 3, 2])
    languages = first.multiselect(
        "Languages",
        list(names),
        format_func=names.__getitem__,
        key=keep("coverage_languages", ["en"] if "en" in names else list(names)[:1], among=names),
        wrap=True,
    )
    offered = {corpus.key: corpus for corpus in corpora(languages)}
    among = "coverage_text " + " ".join(offered)
    picked = second.multiselect(
        "Text",
        list(offered),
        format_func=lambda key: offered[key].label,
        key=keep(among, usual(list(offered.values()))),
        wrap=True,
        help="What is counted: scans of corpora, or a language's example sentences. Texts of one language add up; "
        "several languages weigh the same.",
    )
    character = third.selectbox(
        "Character",
        list(characters),
        format_func=characters.__getitem__,
        key=keep("coverage_character", "robin" if "robin" in characters else next(iter(characters), None), among=characters),
        help="Whose curves: a character may have curves of its own.",
    )
    fourth.space(20)  # With the gap below it: a label's height, and half of what a field is higher than a switch.
    silence = fourth.toggle(
        "Silence", key=keep("coverage_silence", True), help="Pairs at pauses, such as _-bmp; the paper leaves them out."
    )
    if not languages or character is None:
        st.info("Choose a language to see which pairs of phones it needs.")
        st.stop()
    return chosen(languages, character, [offered[key] for key in picked], silence=silence)


def chosen(languages: Sequence[str], character: str, texts: Sequence[Corpus], *, silence: bool) -> Chosen:
    """What there is to show of *texts*. Raises `LipdbError`."""
    db = database()
    counted = {language: summed([one.frequency() for one in texts if one.language == language]) for language in languages}
    if not silence:
        counted = {name: Frequency.of(((*pair, n) for pair, n in one.counts.items()), silence=False) for name, one in counted.items()}
    frequency = balanced(list(counted.values()))
    uses = []
    for language in languages:
        phones = (
            {phone for mapped in db.phoneset(language) for phone in mapped.common}
            | counted[language].phones
            | ({SILENCE} if silence else set())
        )
        every = every_pair(language, character, db.store.revision)
        uses.append({use.pair: use for use in every if {use.left, use.right} <= phones})
    return Chosen(languages, character, texts, counted, frequency, together(uses, frequency))


def show_matrix(now: Chosen) -> None:
    """The heat map, and how much uses which curves."""
    left, right = st.columns([3, 1], gap="medium")
    with left:
        colouring = one_of("Colour shows", COLOURINGS, key="coverage_colouring")
    kinds = {key[0]: row["kind"] for key, row in database().records["common.tsv"].items()}
    order = sorted({use.left for use in now.uses}, key=lambda phone: (phone != SILENCE, kinds.get(phone) != "vowel", phone))
    chart = heat_map(table_of(now.uses, now.frequency, now.by_language), colouring, order)
    event = left.altair_chart(
        chart, key="coverage_matrix", on_select="rerun", selection_mode="pair", width="stretch",
        alt=f"All pairs of phones as a matrix, whose colour shows: {colouring.lower()}. The view Frequency lists the pairs.",
    )  # fmt: skip
    never = "empty" if colouring == OFTEN else "faint"
    left.caption(f"Click a pair to open it in Curves. Vowels come first. Pairs that the chosen text does not have are {never}.")
    for cell in event.selection.get("pair") or []:
        now.go(cell["left"], cell["right"])
    with right:
        show_sums(now)


def show_sums(now: Chosen) -> None:
    """How many pairs there are, and by origin and layer what part of running text they carry."""
    possible = len(now.uses)
    st.metric("Pairs that occur", f"{len(now.needed)} of {possible}", help="Of all that the phones could make.")
    if not now.needed:
        return
    st.metric(
        "Covered by hand", f"{outlook(now.needed).covered:.1f} %", help="The part of running text whose curves are authored or fitted."
    )
    for what, rows in by_curve(now.needed).items():
        head = f"| {what} | pairs | of\N{NO-BREAK SPACE}text |", "| --- | ---: | ---: |"
        cells = [f"| {as_typed(row[what])} | {row['pairs']} | {row['percent']:.1f}\N{NO-BREAK SPACE}% |" for row in rows]
        st.markdown("\n".join([*head, *cells]))


def show_frequency(now: Chosen) -> None:
    """The paper's Figure 2 and Table 2."""
    phones = {phone for use in now.uses for phone in use.pair} - {SILENCE}
    summary = Summary.of(now.frequency, len(phones))
    told = ", ".join(f"**{summary.covering[level]}** cover {100 * level:g} %" for level in LEVELS)
    st.write(f"Of {summary.possible} possible pairs, {summary.seen} occur: {told}.")
    left, right = st.columns(2, gap="medium")
    left.altair_chart(figure_two(now.frequency), width="stretch", key="coverage_figure")
    every = right.toggle(f"All pairs, not only the first {TABLE_TWO}", key=keep("coverage_every", False))
    rows = pd.DataFrame([row.to_row() for row in ranked(now.frequency, None if every else TABLE_TWO)])
    if list(now.languages) == ["en"]:
        paper = named_frequency(database(), PAPER)
        rows["paper"] = [f"{100 * paper.share(pair):.2f}" if pair in paper.counts else "" for pair in now.frequency.pairs[: len(rows)]]
    with right:
        pairs_table(rows.drop(columns="count") if len(now.languages) > 1 else rows, now.frequency.pairs, now.go, key="coverage_table")


def show_to_do(now: Chosen) -> None:
    """What to draw next, the hours left, and what the next ten change."""
    minutes = st.number_input("Minutes a pair", 0.5, 120.0, step=0.5, format="%g", key=keep("coverage_minutes", MINUTES), width=160)
    found, told = gaps(now.needed, minutes=minutes), outlook(now.needed, minutes=minutes)
    columns = st.columns(4)
    columns[0].metric("Pairs to draw", f"{told.gaps} of {told.pairs}")
    columns[1].metric("Hours left", f"{told.hours:.1f}")
    columns[2].metric("Covered by hand today", f"{told.covered:.1f} %")
    columns[3].metric(f"After the next {told.next}", f"{told.then:.1f} %", f"{told.then - told.covered:+.1f} points")
    if not found:
        st.success("Nothing is left to draw: every pair that occurs has authored or fitted curves.", icon=":material/done_all:")
        return
    left, right = st.columns([2, 1], gap="medium")
    rows = pd.DataFrame([gap.to_row() for gap in found])
    rows["done"] = [f"{sum(one.curve.origin in BY_HAND for one in gap.use.moving)} of {len(gap.use.moving)}" for gap in found]
    with left:
        pairs_table(rows.drop(columns="count"), [gap.use.pair for gap in found], now.go, key="coverage_to_do")
    right.altair_chart(work_chart(found, covered=told.covered), width="stretch", key="coverage_work")


with shown_errors():
    now = ask()
    view = one_of("View", VIEWS, key="coverage_view", hidden=True)
    stale = [corpus.title for corpus in now.corpora if corpus.state != "current"]
    if stale and view != CORPORA:
        st.warning(
            f"{', '.join(stale)}: counted with a mapping that has changed since. Count again under Corpora.", icon=":material/update:"
        )
    if not now.frequency.counts and view in (MATRIX, FREQUENCY, TO_DO):
        st.info("No text is chosen, so nothing is counted: choose one above, or count one of your own under Corpora.")
    if view == MATRIX:
        show_matrix(now)
    elif view == FREQUENCY and now.frequency.counts:
        show_frequency(now)
    elif view == TO_DO and now.frequency.counts:
        show_to_do(now)
    elif view == SCRIPT:
        ask_script(now.languages, now.character, silence=st.session_state["coverage_silence"])
    elif view == CORPORA:
        show_scans(now.languages)
        ask_corpus(now.languages)
