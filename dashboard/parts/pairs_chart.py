"""The matrix of all pairs as a heat map, and how many pairs cover how much."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import altair as alt
import pandas as pd
from parts.looks import blue, dark, ink
from parts.pairs import ORIGIN_COLOURS

from lipdb.coverage.reports.frequency import Frequency
from lipdb.coverage.reports.gaps import Gap
from lipdb.coverage.reports.report import ranked
from lipdb.curves.lookup import GENERATED, NEAREST
from lipdb.decisions import ORIGINS, PairUse

OFTEN, ORIGIN, LAYER = "How often", "Origin", "Layer"
COLOURINGS = (OFTEN, ORIGIN, LAYER)
NO_TABLE = "no table"
LEVELS = (0.5, 0.9, 0.991)
LANGUAGE_COLOURS = ("#009e73", "#e69f00", "#56b4e9", "#f0e442", "#999999", "#882255", "#44aa99", "#ddcc77")
CELL, AROUND = 25, 150
"""Pixels of a row of the matrix, and of its legend and axis."""


def layer_of(use: PairUse) -> str:
    """The layer of the pair's curves in a word: ``common``, ``language:en``, ``character:crab``, or that no table has them."""
    name = use.layer.split()[0]
    return NO_TABLE if name in (GENERATED, NEAREST) else name


def table_of(uses: Sequence[PairUse], frequency: Frequency, by_language: Mapping[str, Frequency]) -> pd.DataFrame:
    """One row a pair: its part of running text in per cent, in all and in each language, its curve's origin and layer."""
    rank = {pair: k for k, pair in enumerate(frequency.pairs, 1)}
    several = by_language if len(by_language) > 1 else {}
    rows = [
        {
            "left": use.left,
            "right": use.right,
            "pair": f"{use.left}-{use.right}",
            "percent": 100 * frequency.share(use.pair),
            "rank": rank.get(use.pair),
            "origin": use.origin,
            "layer": layer_of(use),
            "open": use.gap,
            **({"languages": ", ".join(f"{name} {100 * one.share(use.pair):.2f} %" for name, one in several.items())} if several else {}),
        }
        for use in uses
    ]
    return pd.DataFrame(rows)


def heat_map(table: pd.DataFrame, colouring: str, order: Sequence[str]) -> alt.Chart:
    """The pairs of *table* by their phones in *order*; a click selects one as ``pair``. What never occurs is empty or pale."""
    click = alt.selection_point(name="pair", fields=["left", "right"], on="click", clear=False)
    tooltip = [
        alt.Tooltip("pair:N"),
        alt.Tooltip("percent:Q", title="% of running text", format=".4f"),
        alt.Tooltip("rank:Q", title="rank"),
        *([alt.Tooltip("languages:N")] if "languages" in table else []),
        alt.Tooltip("origin:N"),
        alt.Tooltip("layer:N"),
    ]
    axis = alt.Axis(labelAngle=0, labelOverlap=False, labelFlush=False, labelFontSize=12, ticks=False, domain=False, grid=False)
    base = alt.Chart(table, height=CELL * len(order) + AROUND).encode(
        x=alt.X("right:N", sort=list(order), title="to", axis=axis, scale=alt.Scale(domain=list(order), paddingInner=0.06)),
        y=alt.Y("left:N", sort=list(order), title="from", axis=axis, scale=alt.Scale(domain=list(order), paddingInner=0.06)),
        tooltip=tooltip,
    )
    # The edge shows where a cell is that has no colour, and makes it one to click on. A text for each would be a quarter of the work.
    cells = base.mark_rect(
        stroke="#888888", strokeOpacity=0.35, strokeWidth=0.5, cornerRadius=2, cursor="pointer", aria=False
    ).add_params(click)  # fmt: skip
    if colouring == OFTEN:
        return cells.encode(color=alt.condition("datum.percent > 0", _often(table), alt.value("transparent")))
    names, colours = _palette(table, colouring)
    scale = alt.Scale(domain=names, range=colours)
    return cells.encode(
        color=alt.Color(
            f"{colouring.lower()}:N", scale=scale, legend=alt.Legend(title=None, orient="top", symbolStrokeWidth=0, symbolSize=160)
        ),
        fillOpacity=alt.condition("datum.percent > 0", alt.value(1), alt.value(0.3)),
    )


def _often(table: pd.DataFrame) -> alt.Color:
    """Blues over the logarithm: pairs differ by factors of thousands. The most frequent one stands out most in either theme."""
    there = table.percent[table.percent > 0]
    high = float(there.max()) if len(there) else 1.0
    low = min(float(there.min()), high / 10) if len(there) else 0.1
    scale = alt.Scale(type="log", domain=[low, high], scheme="blues", reverse=dark())
    return alt.Color("percent:Q", scale=scale, legend=alt.Legend(title="% of running text", orient="top", format="~g", gradientLength=260))


def _palette(table: pd.DataFrame, colouring: str) -> tuple[list[str], list[str]]:
    if colouring == ORIGIN:
        names = [origin for origin in ORIGINS if (table.origin == origin).any()]
        return names, [ORIGIN_COLOURS[name] for name in names]
    fixed = {"common": "#0072b2", NO_TABLE: "#d55e00"}
    names = sorted(set(table.layer), key=lambda name: (name not in fixed, name))
    languages = [name for name in names if name.startswith("language")]
    own = {name: LANGUAGE_COLOURS[k % len(LANGUAGE_COLOURS)] for k, name in enumerate(languages)}
    return names, [fixed.get(name) or own.get(name, "#cc79a7") for name in names]


def figure_two(frequency: Frequency) -> alt.LayerChart:
    """The paper's Figure 2: what each pair has of running text, by rank, and what the most frequent ones cover."""
    rows = [
        {"rank": row.rank, "pair": f"{row.left}-{row.right}", "percent": row.percent, "covered": row.cumulative}
        for row in ranked(frequency)
    ]
    marks = [
        {"rank": count, "covered": 100 * level, "text": f"{100 * level:g} %: {count}", "last": level == LEVELS[-1]}
        for level in LEVELS
        for count in [frequency.covering(level)]
    ]
    rank = alt.X("rank:Q", title="pairs, the most frequent first", scale=alt.Scale(domain=[0, len(frequency) + 1], nice=False))
    base = alt.Chart(pd.DataFrame(rows)).encode(x=rank)
    tooltip = ["rank:Q", "pair:N", alt.Tooltip("percent:Q", format=".3f"), alt.Tooltip("covered:Q", format=".2f")]
    bars = base.mark_area(color="#56b4e9", interpolate="step").encode(y=alt.Y("percent:Q", title="% that each pair has"))
    cover = alt.Y("covered:Q", title="% covered so far", scale=alt.Scale(domain=[0, 100]))
    line = base.mark_line(color="#d55e00", strokeWidth=2.5).encode(y=cover)
    at = alt.Chart(pd.DataFrame(marks)).encode(x=rank, y=cover)
    dots = at.mark_point(color="#d55e00", filled=True, size=70, opacity=1)
    places: tuple[tuple[bool, Literal["left", "center"], int, int], ...] = ((False, "left", 9, 12), (True, "center", 0, 20))
    words = [
        at.transform_filter(alt.datum["last"] == last).mark_text(align=align, dx=dx, dy=dy, fontSize=13, color=ink()).encode(text="text:N")
        for last, align, dx, dy in places
    ]
    touch = base.mark_rule(strokeWidth=4, opacity=0).encode(tooltip=tooltip)
    return alt.layer(bars, alt.layer(line, dots, *words), touch).resolve_scale(y="independent").properties(height=480)


def work_chart(gaps: Sequence[Gap], *, covered: float) -> alt.Chart:
    """What will be covered by hand after so many hours, from the *covered* per cents of today on."""
    rows = [{"hours": 0.0, "covered": covered, "pair": "today"}]
    rows += [{"hours": gap.hours, "covered": gap.covered, "pair": f"{gap.use.left}-{gap.use.right}"} for gap in gaps]
    return (
        alt.Chart(pd.DataFrame(rows), height=260)
        .mark_area(line={"color": blue()}, color=blue(), fillOpacity=0.15)
        .encode(
            x=alt.X("hours:Q", title="hours of work"),
            y=alt.Y("covered:Q", title="% covered by hand", scale=alt.Scale(domain=[0, 100])),
            tooltip=[alt.Tooltip("pair:N", title="with"), alt.Tooltip("hours:Q", format=".1f"), alt.Tooltip("covered:Q", format=".2f")],
        )
    )
