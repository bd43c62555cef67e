"""Draw the pictures of docs/engine.md from the engine itself.

usage: python scripts/plot_engine.py [FOLDER]    (default: docs/img)
"""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from lipdb.curated.folder import read_folder
from lipdb.curves.curve import Curve
from lipdb.curves.lookup import CurveBook
from lipdb.engine import CurveTable, Stages, stages
from lipdb.paths import phonesets_dir
from lipdb.poses import PoseSet

# "Bob may fly": times as a voice might give them, in milliseconds.
PHONES = ("_", "bmp", "aa", "bmp", "bmp", "eh", "ih", "f", "l", "ay", "_")
LENGTHS = (200, 80, 110, 80, 70, 70, 60, 90, 60, 200, 250)
EDGES = np.cumsum((0, *LENGTHS)) * 1000
COLOURS = {"open": "#c44536", "PBM": "#1d5c8a", "FV": "#2a9d6f", "wide": "#b8860b", "ShCh": "#7b4fa3", "W": "#888888"}


def axes(height: float = 2.4) -> tuple[Any, Any]:
    """A picture of the line, its phones written along the top."""
    figure, axis = plt.subplots(figsize=(9, height), layout="constrained")
    for (start, end), phone in zip(pairwise(EDGES / 1e6), PHONES, strict=True):
        axis.axvline(start, color="#dddddd", lw=0.8, zorder=0)
        axis.text((start + end) / 2, 1.02, phone, ha="center", va="bottom", fontsize=9, transform=axis.get_xaxis_transform())
    axis.set(xlim=(0.1, EDGES[-1] / 1e6 - 0.05), ylim=(-0.02, 1.35), yticks=(0, 0.5, 1), xlabel="seconds", ylabel="weight")
    axis.spines[["top", "right"]].set_visible(False)
    return figure, axis


def save(figure: Any, axis: Any, path: Path) -> None:
    """Write one picture without anything that changes from run to run."""
    axis.legend(loc="upper right", fontsize=8, frameon=False, ncols=4)
    figure.savefig(path, dpi=90, metadata={"Software": None})
    plt.close(figure)


def gathered(made: Stages, folder: Path) -> None:
    """Pair curves laid on the time line, and their maximum."""
    figure, axis = axes()
    for pose in ("open", "PBM"):
        for curve in made.curves:
            if curve.pose == pose:
                axis.plot(curve.times, curve.weights, color=COLOURS[pose], lw=1, alpha=0.6)
        axis.plot([], [], color=COLOURS[pose], lw=1, label=f"{pose}: pair curves")
        stitched = made.stitched[:, made.poses.index(pose)]
        axis.plot(made.times, stitched, ".", color=COLOURS[pose], ms=4, label=f"{pose}: stitched")
    save(figure, axis, folder / "engine_stitch.png")


def smoothed(made: Stages, folder: Path) -> None:
    """Valleys filled in the jaw, and left alone in the lips."""
    figure, axis = axes()
    for pose in ("open", "wide", "PBM"):
        before, after = made.stitched[:, made.poses.index(pose)], made.smoothed[:, made.poses.index(pose)]
        axis.plot(made.times, before, color=COLOURS[pose], lw=1, ls=":")
        axis.plot(made.times, after, color=COLOURS[pose], lw=1.5, label=pose)
        axis.fill_between(made.times, before, after, color=COLOURS[pose], alpha=0.3, lw=0)
    save(figure, axis, folder / "engine_smooth.png")


def constrained(made: Stages, rules: PoseSet, folder: Path) -> None:
    """What the lips leave of the jaw."""
    figure, axis = axes()
    jaw = made.poses.index("open")
    bound = np.full(len(made.times), np.inf)
    for higher, threshold in rules.bounds(jaw):
        bound = np.minimum(bound, np.maximum(0, threshold - made.limited[:, higher]))
    axis.plot(made.times, made.limited[:, made.poses.index("PBM")], color=COLOURS["PBM"], lw=1.5, label="PBM, finished")
    axis.plot(made.times, made.limited[:, made.poses.index("FV")], color=COLOURS["FV"], lw=1.5, label="FV, finished")
    axis.plot(made.times, bound, color="black", lw=0.8, ls="--", label="what they leave of open")
    axis.plot(made.times, made.smoothed[:, jaw], color=COLOURS["open"], lw=1, ls=":", label="open, smoothed")
    axis.plot(made.times, made.constrained[:, jaw], color=COLOURS["open"], lw=1.8, label="open, constrained")
    save(figure, axis, folder / "engine_constrain.png")


def limited(made: Stages, folder: Path) -> None:
    """The speed limit from above for lips and from below for the jaw, and the spline."""
    figure, axis = axes()
    for pose in ("PBM", "open"):
        i = made.poses.index(pose)
        axis.plot(made.times, made.smoothed[:, i] if pose == "PBM" else made.constrained[:, i], color=COLOURS[pose], lw=1, ls=":")
        axis.plot(made.times, made.limited[:, i], ".", color=COLOURS[pose], ms=4, label=f"{pose}: control points")
        axis.plot(made.track.times, made.track.weights[:, i], color=COLOURS[pose], lw=1.5, label=f"{pose}: spline")
    save(figure, axis, folder / "engine_limit.png")


def rates(table: CurveTable, rules: PoseSet, folder: Path) -> None:
    """The same motion at three frame rates."""
    figure, axis = axes()
    for fps, mark in ((60, "-"), (30, "s"), (24, "^")):
        track = stages(table, rules, EDGES.tolist(), PHONES, fps=fps).track
        for pose in ("PBM", "open"):
            label = f"{pose}, {fps} fps"
            axis.plot(track.times, track.pose(pose), mark, color=COLOURS[pose], lw=1, ms=4, alpha=1 if fps == 60 else 0.7, label=label)
    save(figure, axis, folder / "engine_rates.png")


def warps(folder: Path) -> None:
    """A key at 0.5 under both warps, for two phones of unequal length."""
    figure, axis = plt.subplots(figsize=(5, 1.9), layout="constrained")
    keys = ((0.2, 0.0), (0.5, 0.9), (0.8, 0.0))
    rules = PoseSet("one", ("p",), (None,), np.array([100.0]), np.array([False]), np.full((1, 1), 2.0), 0.0)
    for warp, style in (("border", "-"), ("linear", "--")):
        curve = replace(Curve(keys), warp=warp)
        laid = stages(CurveTable.build(("a", "b"), ("p",), {("a", "b", "p"): curve}), rules, [0, 300_000, 400_000], ["a", "b"]).curves[0]
        axis.plot(laid.times, laid.weights, style, marker="o", ms=4, color=COLOURS["open"], label=warp)
    for border, phone in ((0.0, "a"), (0.3, "b"), (0.4, "")):
        axis.axvline(border, color="#dddddd", lw=0.8, zorder=0)
        axis.text(border + (0.15 if phone == "a" else 0.05), 0.95, phone, ha="center")
    axis.set(ylim=(0, 1.3), xlabel="seconds", ylabel="weight")
    axis.spines[["top", "right"]].set_visible(False)
    save(figure, axis, folder / "engine_warp.png")


def main() -> None:
    """Draw all pictures."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img")
    records = read_folder(phonesets_dir())
    rules = PoseSet.from_records(records, "facefx")
    table = CurveBook.from_records(records, "facefx").table(PHONES)
    made = stages(table, rules, EDGES.tolist(), PHONES)
    gathered(made, folder)
    smoothed(made, folder)
    constrained(made, rules, folder)
    limited(made, folder)
    rates(table, rules, folder)
    warps(folder)


if __name__ == "__main__":
    main()
