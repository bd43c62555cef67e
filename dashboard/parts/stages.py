"""The chart of the engine's stages, in colours that everybody can tell apart (Okabe and Ito 2008)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import altair as alt
import numpy as np
import pandas as pd
from numpy.typing import NDArray

if TYPE_CHECKING:
    from lipdb.engine import Stages
    from lipdb.schedule import Schedule

Floats = NDArray[np.float64]

STAGE_COLOURS = {
    "curves": "#999999",
    "stitched": "#56b4e9",
    "smoothed": "#009e73",
    "constrained": "#e69f00",
    "limited": "#d55e00",
    "final": "#0072b2",
}
GREY = "#8a8a8a"
"""Can be read on light and on dark pages."""
STRAIGHT = 1e-4
"""A point that is nearer than this to the line between its neighbours is not sent to the browser."""


def stages_chart(
    made: Stages, schedule: Schedule, poses: list[str], shown: list[str], *, window: tuple[float, float]
) -> alt.LayerChart | alt.VConcatChart:
    """Each stage of *shown* for each of *poses* within *window* seconds, with the common phones (the paper's Figures 6 to 10)."""
    order = [stage for stage in STAGE_COLOURS if stage in shown]
    scale = alt.Scale(domain=order, range=[STAGE_COLOURS[stage] for stage in order])
    time = alt.X("seconds:Q", title="seconds", scale=alt.Scale(domain=list(window), nice=False))
    colour = alt.Color("stage:N", scale=scale, legend=alt.Legend(orient="top", title=None))
    single = len(poses) == 1

    def panel(pose: str) -> alt.LayerChart:
        data = pd.concat([_stage(made, pose, stage, window) for stage in order], ignore_index=True)
        lines = (
            alt.Chart(data)
            .mark_line(strokeWidth=1.6, clip=True)
            .encode(
                x=time if single or pose == poses[-1] else time.axis(labels=False, title=None),
                y=alt.Y("weight:Q", title=pose, scale=alt.Scale(domain=[0, 1.15]), axis=alt.Axis(values=[0, 0.5, 1])),
                color=colour,
                detail="curve:N",
                tooltip=["stage:N", "curve:N", alt.Tooltip("seconds:Q", format=".3f"), alt.Tooltip("weight:Q", format=".3f")],
            )
        )
        named = single or pose == poses[0]
        return alt.layer(*_phones(schedule, window, named=named), lines).properties(height=320 if single else 90, width="container")

    return panel(poses[0]) if single else alt.vconcat(*map(panel, poses), spacing=4)


def _phones(schedule: Schedule, window: tuple[float, float], *, named: bool) -> list[alt.Chart]:
    """A line where each common phone begins, and its name where there is room."""
    edges, names = schedule.common()
    seconds = np.array(edges) / 1e6
    borders = pd.DataFrame({"start": seconds[:-1], "seconds": (seconds[:-1] + seconds[1:]) / 2, "wide": np.diff(seconds), "phone": names})
    seen = borders[(borders.start < window[1]) & (borders.start >= window[0])]
    charts = [alt.Chart(seen).mark_rule(opacity=0.3, color=GREY).encode(x=alt.X("start:Q", title="seconds"))]
    if named:
        roomy = seen[seen.wide > 0.008 * (window[1] - window[0])]
        text = alt.Chart(roomy).mark_text(baseline="top", dy=2, fontSize=11, color=GREY)
        charts.append(text.encode(x="seconds:Q", y=alt.value(0), text="phone:N"))
    return charts


def _stage(made: Stages, pose: str, stage: str, window: tuple[float, float]) -> pd.DataFrame:
    """The lines of one stage of one pose: columns seconds, weight, curve, stage."""
    k = made.poses.index(pose)
    if stage == "curves":
        laid = [curve for curve in made.curves if curve.pose == pose]
        lines = [(np.asarray(curve.times), np.asarray(curve.weights), f"{curve.left}-{curve.right} ({n})") for n, curve in enumerate(laid)]
    elif stage == "final":
        track = made.track
        lines = [(np.arange(len(track.weights)) / track.fps, track.weights[:, k], stage)]
    else:
        lines = [(made.times, getattr(made, stage)[:, k], stage)]
    frames = [
        pd.DataFrame({"seconds": times, "weight": weights, "curve": name})
        for times, weights, name in ((*_bends(times, weights, window), name) for times, weights, name in lines)
        if len(times)
    ]
    empty = pd.DataFrame({"seconds": pd.Series(dtype=float), "weight": pd.Series(dtype=float), "curve": pd.Series(dtype=str)})
    return (pd.concat(frames, ignore_index=True) if frames else empty).assign(stage=stage)


def _bends(times: Floats, weights: Floats, window: tuple[float, float]) -> tuple[Floats, Floats]:
    """The points of a line within *window* (and one on each side) that are not on the straight line between their neighbours."""
    first = max(int(np.searchsorted(times, window[0])) - 1, 0)
    last = int(np.searchsorted(times, window[1], side="right")) + 1
    times, weights = times[first:last], weights[first:last]
    if len(times) < 3:
        return times, weights
    before, after = times[1:-1] - times[:-2], times[2:] - times[1:-1]
    line = (weights[:-2] * after + weights[2:] * before) / np.maximum(before + after, 1e-12)
    kept = np.concatenate([[True], np.abs(weights[1:-1] - line) > STRAIGHT, [True]])
    return times[kept], weights[kept]
