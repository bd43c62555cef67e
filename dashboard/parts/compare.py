"""Two versions of the curves of a pair over each other, pose by pose."""

from __future__ import annotations

from collections.abc import Mapping

import altair as alt
import pandas as pd
import streamlit as st
from parts.looks import blue

from lipdb.curves.curve import Curve

COLUMNS = 3
OLD = "#e69f00"


def draw_versions(poses: Mapping[str, tuple[Curve, Curve]], old: str, new: str) -> None:
    """A small chart a pose: the *old* version dashed, the *new* one drawn through; the time is that of the pair, 0 to 1."""
    columns = st.columns(COLUMNS)
    for k, (pose, versions) in enumerate(poses.items()):
        columns[k % COLUMNS].altair_chart(_chart(pose, dict(zip((old, new), versions, strict=True))), width="stretch")


def _chart(pose: str, versions: Mapping[str, Curve]) -> alt.Chart:
    points = [
        {"time": time, "weight": weight, "version": name, "order": k}
        for name, curve in versions.items()
        for k, (time, weight) in enumerate(curve.keys or ((0.0, 0.0), (1.0, 0.0)))
    ]
    names = list(versions)
    return (
        alt.Chart(pd.DataFrame(points), height=230, title=alt.Title(pose, anchor="start", offset=4))
        .mark_line(point=alt.OverlayMarkDef(size=40), strokeWidth=2)
        .encode(
            x=alt.X("time:Q", title=None, scale=alt.Scale(domain=[0, 1]), axis=alt.Axis(values=[0, 0.5, 1], format="~g")),
            y=alt.Y("weight:Q", title=None, scale=alt.Scale(domain=[0, 1]), axis=alt.Axis(values=[0, 0.5, 1], format="~g")),
            color=alt.Color(
                "version:N",
                scale=alt.Scale(domain=names, range=[OLD, blue()]),
                legend=alt.Legend(title=None, orient="top", symbolType="stroke", symbolSize=300, offset=4, padding=0),
            ),
            strokeDash=alt.StrokeDash("version:N", scale=alt.Scale(domain=names, range=[[5, 3], [1, 0]]), legend=None),
            order="order:O",
            tooltip=["version:N", "time:Q", "weight:Q"],
        )
    )
