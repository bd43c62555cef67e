"""The chart of the engine's stages, in colours that everybody can tell apart (Okabe and Ito 2008)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import altair as alt
import numpy as np
import pandas as pd
from numpy.typing import NDArray
from parts.looks import dark, ink

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
    "splined": "#cc79a7",
    "final": "#0072b2",
}
FINAL_ON_DARK = "#f0e442"
"""There a blue that is light enough to be seen can't be told from that of *stitched*."""
ROOM = 1.15
"""What a pose has of the height, in weights: 1 and the names of the phones."""
LETTER = 0.007
"""What a letter takes of the width: on a window of 1280 pixels."""
STRAIGHT = 1e-4
"""A point that is nearer than this to the line between its neighbours is not sent to the browser."""


def stages_chart(
    made: Stages, schedule: Schedule, poses: list[str], shown: list[str], *, window: tuple[float, float]
) -> alt.LayerChart | alt.FacetChart:
    """Each stage of *shown* for each of *poses* within *window* seconds, with the common phones (the paper's Figures 6 to 10).

    Poses stand over each other in one plot, each on a floor of its own: plots in a column would not keep to the page's width.
    """
    order = [stage for stage in STAGE_COLOURS if stage in shown]
    colours = [FINAL_ON_DARK if stage == "final" and dark() else STAGE_COLOURS[stage] for stage in order]
    floors = {pose: ROOM * k for k, pose in enumerate(reversed(poses))}
    data = pd.concat([_stage(made, pose, stage, window).assign(pose=pose) for pose in poses for stage in order], ignore_index=True)
    data["height"] = data.weight + data.pose.map(floors)
    if len(poses) == 1:
        axis = alt.Axis(values=[0, 0.5, 1])
    else:
        names = " : ".join(f"datum.value == {floor} ? '{pose}'" for pose, floor in floors.items())
        axis = alt.Axis(values=list(floors.values()), labelExpr=f"{names} : ''", labelBaseline="bottom")
    lines = (
        alt.Chart(data)
        .mark_line(strokeWidth=1.6, clip=True)
        .encode(
            x=alt.X(
                "seconds:Q",
                title="seconds",
                scale=alt.Scale(domain=list(window), nice=False),
                axis=alt.Axis(grid=False, tickCount=10),  # the lines across are the phones'
            ),
            y=alt.Y(
                "height:Q",
                title=poses[0] if len(poses) == 1 else "each from 0 to 1",
                scale=alt.Scale(domain=[0, ROOM * len(poses)], nice=False),
                axis=axis,
            ),
            color=alt.Color("stage:N", scale=alt.Scale(domain=order, range=colours), legend=alt.Legend(orient="top", title=None)),
            detail=["curve:N", "pose:N"],
            tooltip=["pose:N", "stage:N", "curve:N", alt.Tooltip("seconds:Q", format=".3f"), alt.Tooltip("weight:Q", format=".3f")],
        )
    )
    return alt.layer(*_phones(schedule, window), lines).properties(height=320 if len(poses) == 1 else 80 + 70 * len(poses))


def _phones(schedule: Schedule, window: tuple[float, float]) -> list[alt.Chart]:
    """A line where each common phone begins, and its name where there is room."""
    edges, names = schedule.common()
    seconds = np.array(edges) / 1e6
    phones = pd.DataFrame({"start": seconds[:-1], "seconds": (seconds[:-1] + seconds[1:]) / 2, "wide": np.diff(seconds), "phone": names})
    seen = phones[(phones.start < window[1]) & (phones.start >= window[0])]
    borders = alt.Chart(seen).mark_rule(opacity=0.2, color=ink()).encode(x=alt.X("start:Q", title="seconds"))
    wide = seen[seen.wide > LETTER * seen.phone.str.len() * (window[1] - window[0])]
    text = alt.Chart(wide).mark_text(baseline="top", dy=2, fontSize=11, color=ink(), opacity=0.7)
    return [borders, text.encode(x="seconds:Q", y=alt.value(0), text="phone:N")]


def _stage(made: Stages, pose: str, stage: str, window: tuple[float, float]) -> pd.DataFrame:
    """The lines of one stage of one pose: columns seconds, weight, curve, stage."""
    k = made.poses.index(pose)
    if stage == "curves":
        laid = [curve for curve in made.curves if curve.pose == pose]
        lines = [(np.asarray(curve.times), np.asarray(curve.weights), f"{curve.left}-{curve.right} ({n})") for n, curve in enumerate(laid)]
    elif stage in ("splined", "final"):
        drawn = made.splined if stage == "splined" else made.track.weights
        lines = [(np.arange(len(drawn)) / made.track.fps, drawn[:, k], stage)]
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
