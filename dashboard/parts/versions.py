"""Versions of one curve in one chart, in colours that everybody can tell apart (Okabe and Ito 2008)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import altair as alt
import pandas as pd
from parts.looks import blue

VERSION_DASHES = {"mine": [1, 0], "theirs": [6, 3], "before": [2, 2]}


def curves_chart(versions: Mapping[str, Sequence[tuple[float, float]] | None]) -> alt.Chart:
    """The versions of one curve, ``mine``, ``theirs`` and ``before``, over normalised time; None is not drawn."""
    drawn = {who: keys or [(0.0, 0.0), (1.0, 0.0)] for who, keys in versions.items() if keys is not None}
    points = [
        {"time": time, "weight": weight, "version": who, "order": k} for who, keys in drawn.items() for k, (time, weight) in enumerate(keys)
    ]
    colours = {"mine": "#d55e00", "theirs": blue(), "before": "#999999"}
    domain = list(colours)
    return (
        alt.Chart(pd.DataFrame(points, columns=["time", "weight", "version", "order"]), height=200)
        .mark_line(point=True)
        .encode(
            x=alt.X("time:Q", title=None, scale=alt.Scale(domain=[0, 1]), axis=alt.Axis(values=[0, 0.5, 1])),
            y=alt.Y("weight:Q", title=None, scale=alt.Scale(domain=[0, 1]), axis=alt.Axis(values=[0, 0.5, 1])),
            color=alt.Color(
                "version:N",
                scale=alt.Scale(domain=domain, range=list(colours.values())),
                legend=alt.Legend(title=None, orient="top", symbolType="stroke"),
            ),
            strokeDash=alt.StrokeDash("version:N", scale=alt.Scale(domain=domain, range=list(VERSION_DASHES.values())), legend=None),
            order="order:O",
            tooltip=["version:N", "time:Q", "weight:Q"],
        )
    )
