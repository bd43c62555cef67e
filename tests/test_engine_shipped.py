"""The shipped curves keep every promise of the engine, close where lips must close, and open in between."""

from __future__ import annotations

from itertools import pairwise

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.curated.folder import read_folder
from lipdb.curves.lookup import CurveBook
from lipdb.engine import animate
from lipdb.paths import phonesets_dir
from lipdb.poses import PoseSet

SLOW = settings(max_examples=20, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
CLOSURES = (("bmp", "PBM"), ("f", "FV"))


@pytest.fixture(scope="module")
def shipped():
    records = read_folder(phonesets_dir())
    phones = [phone for (phone,) in records["common.tsv"]]
    return PoseSet.from_records(records, "facefx"), CurveBook.from_records(records, "facefx").table(phones)


def authored(table, edges, phones, i, pose):
    """The largest key of *pose* within phone *i* of a line."""
    drawn, _ = cases.polygons(table, edges, phones)
    start, end, number = edges[i] / 1e6, edges[i + 1] / 1e6, table.poses.index(pose)
    return max((y for p, xs, ys in drawn if p == number for x, y in zip(xs, ys, strict=True) if start <= x <= end), default=0.0)


@pytest.mark.parametrize("fps", cases.RATES)
@SLOW
@given(data=st.data())
def test_shipped_curves_keep_every_promise_and_every_closure(shipped, fps, data):
    rules, table = shipped
    edges, phones = data.draw(cases.schedules(table.phones, size=25))
    track = animate(table, rules, edges, phones, fps=fps)
    assert cases.broken(track.weights, rules, fps) == []
    half = 0.5 / fps + 1e-9
    for i, (start, end) in enumerate(pairwise(edges)):
        for phone, pose in CLOSURES:
            if phones[i] == phone and end - start >= 60_000:
                near = (track.times >= start / 1e6 - half) & (track.times <= end / 1e6 + half)
                assert track.pose(pose)[near].max() >= 0.98 * authored(table, edges, phones, i, pose)


def test_shipped_closures_are_authored_at_nine_tenths_and_more(shipped):
    _, table = shipped
    for phone, pose in CLOSURES:
        for other in table.phones:
            for pair, border in (((other, phone), 1), ((phone, other), 0)):
                edges, i = ([0, 200_000, 400_000], border)
                assert authored(table, edges, list(pair), i, pose) >= 0.9 - 1e-9


def test_bmp_and_f_close_and_nothing_else_does(shipped):
    rules, table = shipped
    closing = {rules.poses[i]: table.closing[i] for i in np.flatnonzero(rules.must_reach)}
    found = {pose: [phone for phone, on in zip(table.phones, row, strict=True) if on] for pose, row in closing.items()}
    assert found == {"PBM": ["bmp"], "FV": ["f"]}


@pytest.mark.parametrize("word", ["bmp-aa-bmp", "bmp-eh-bmp-ih", "bmp-aa-bmp-ah", "bmp-ah-bmp-ah", "f-aa-f"])
@SLOW
@given(vowel=st.integers(80_000, 200_000), stop=st.integers(60_000, 120_000), start=st.integers(200_000, 300_000))
def test_the_mouth_opens_between_the_closures_of_bob_baby_mama_papa(shipped, word, vowel, stop, start):
    rules, table = shipped
    phones = ["_", *word.split("-"), "_"]
    lengths = [start, *[stop if p in ("bmp", "f") else vowel for p in phones[1:-1]], 300_000]
    edges = np.cumsum([0, *lengths]).tolist()
    track = animate(table, rules, edges, phones)
    opening = track.pose("open")
    for (begin, end), phone in zip(pairwise(edges), phones, strict=True):
        if phone not in ("_", "bmp", "f"):
            during = opening[(track.times >= begin / 1e6) & (track.times <= end / 1e6)]
            assert during.max() > 0.25 * opening.max() > 0.02


@SLOW
@given(data=st.data())
def test_30_fps_equals_60_fps_with_shipped_curves(shipped, data):
    rules, table = shipped
    edges, phones = data.draw(cases.schedules(table.phones, size=25))
    coarse = animate(table, rules, edges, phones, fps=30).weights
    fine = animate(table, rules, edges, phones, fps=60, frames=2 * len(coarse)).weights[::2]
    np.testing.assert_allclose(coarse, fine, atol=0.05)
