"""Charts of lines and stages, in colours that everybody can tell apart (Okabe and Ito 2008)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import altair as alt
import numpy as np
import pandas as pd

if TYPE_CHECKING:
    from lipdb.engine import Stages
    from lipdb.schedule import Schedule

STAGE_COLOURS = {
    "curves": "#999999",
    "stitched": "#56b4e9",
    "smoothed": "#009e73",
    "constrained": "#e69f00",
    "limited": "#d55e00",
    "final": "#0072b2",
}

VERSION_COLOURS = {"mine": "#d55e00", "theirs": "#0072b2", "before": "#999999"}
VERSION_DASHES = {"mine": [1, 0], "theirs": [6, 3], "before": [2, 2]}


def curves_chart(title: str, versions: Mapping[str, Sequence[tuple[float, float]] | None]) -> alt.Chart:
    """The versions of one curve, ``mine``, ``theirs`` and ``before``, over normalised time; None is not drawn."""
    drawn = {who: keys or [(0.0, 0.0), (1.0, 0.0)] for who, keys in versions.items() if keys is not None}
    points = [
        {"time": time, "weight": weight, "version": who, "order": k} for who, keys in drawn.items() for k, (time, weight) in enumerate(keys)
    ]
    domain = list(VERSION_COLOURS)
    return (
        alt.Chart(pd.DataFrame(points, columns=["time", "weight", "version", "order"]), title=title, height=130)
        .mark_line(point=True)
        .encode(
            x=alt.X("time:Q", title=None, scale=alt.Scale(domain=[0, 1])),
            y=alt.Y("weight:Q", title=None, scale=alt.Scale(domain=[0, 1]), axis=alt.Axis(values=[0, 0.5, 1])),
            color=alt.Color(
                "version:N", scale=alt.Scale(domain=domain, range=list(VERSION_COLOURS.values())), legend=alt.Legend(title=None)
            ),
            strokeDash=alt.StrokeDash("version:N", scale=alt.Scale(domain=domain, range=list(VERSION_DASHES.values())), legend=None),
            order="order:O",
            tooltip=["version:N", "time:Q", "weight:Q"],
        )
    )


def stages_chart(made: Stages, schedule: Schedule, poses: list[str], shown: list[str]) -> alt.LayerChart | alt.FacetChart:
    """Each stage of *shown* for each of *poses* over time, with the borders of the common phones (the paper's Figures 6 to 10)."""
    edges, names = schedule.common()
    seconds = np.array(edges) / 1e6
    borders = pd.DataFrame({"seconds": (seconds[:-1] + seconds[1:]) / 2, "start": seconds[:-1], "phone": names})
    order = [stage for stage in STAGE_COLOURS if stage in shown]
    parts = [_stage(made, made.poses.index(pose), stage) for pose in poses for stage in order]
    data = (
        pd.concat(parts, ignore_index=True) if parts else pd.DataFrame({"seconds": [], "weight": [], "stage": [], "curve": [], "pose": []})
    )
    colours = alt.Scale(domain=order, range=[STAGE_COLOURS[stage] for stage in order])
    time = alt.X("seconds:Q", title="seconds", scale=alt.Scale(domain=[float(seconds[0]), float(seconds[-1])], nice=False))
    rules = alt.Chart(borders).mark_rule(opacity=0.2).encode(x="start:Q")
    labels = alt.Chart(borders).mark_text(baseline="top", dy=2, fontSize=11).encode(x="seconds:Q", y=alt.value(0), text="phone:N")
    lines = (
        alt.Chart(data)
        .mark_line(strokeWidth=1.6)
        .encode(
            x=time,
            y=alt.Y("weight:Q", scale=alt.Scale(domain=[0, 1.12]), axis=alt.Axis(values=[0, 0.5, 1])),
            color=alt.Color("stage:N", scale=colours, legend=alt.Legend(orient="top", title=None)),
            detail="curve:N",
            tooltip=["stage:N", "curve:N", alt.Tooltip("seconds:Q", format=".3f"), alt.Tooltip("weight:Q", format=".3f")],
        )
    )
    if len(poses) == 1:
        return alt.layer(rules, labels, lines).properties(height=320)
    rows = [alt.layer(rules, labels, lines.transform_filter(alt.datum.pose == pose)).properties(height=110, title=pose) for pose in poses]
    return alt.vconcat(*rows).resolve_scale(x="shared")


def _stage(made: Stages, pose: int, stage: str) -> pd.DataFrame:
    name = made.poses[pose]
    if stage == "curves":
        laid = [curve for curve in made.curves if curve.pose == name]
        frames = [
            pd.DataFrame({"seconds": curve.times, "weight": curve.weights, "curve": f"{curve.left}-{curve.right} ({k})"})
            for k, curve in enumerate(laid)
        ]
        data = pd.concat(frames, ignore_index=True) if frames else pd.DataFrame({"seconds": [], "weight": [], "curve": []})
    elif stage == "final":
        track = made.track
        data = pd.DataFrame({"seconds": np.arange(len(track.weights)) / track.fps, "weight": track.weights[:, pose], "curve": stage})
    else:
        data = pd.DataFrame({"seconds": made.times, "weight": getattr(made, stage)[:, pose], "curve": stage})
    return data.assign(stage=stage, pose=name)
