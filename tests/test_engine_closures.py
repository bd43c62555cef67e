"""Lips close where they must, and open in between."""

from __future__ import annotations

from itertools import pairwise

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import CurveTable, animate
from lipdb.engine.smooth import valleys

SLOW = settings(max_examples=25, suppress_health_check=[HealthCheck.too_slow])


def reached(track, edges, phones, phone, pose):
    """The largest weight of *pose* within half a frame of every *phone* of 60 ms or more."""
    times, half = track.times, 0.5 / track.fps + 1e-9
    for (start, end), name in zip(pairwise(edges), phones, strict=True):
        if name == phone and end - start >= 60_000:
            near = (times >= start / 1e6 - half) & (times <= end / 1e6 + half)
            yield float(track.pose(pose)[near].max())


@pytest.mark.parametrize("fps", cases.RATES)
@SLOW
@given(st.data())
def test_closures_reach_their_authored_peak_whatever_stands_around_them(fps, data):
    rules, table = cases.pose_set(), cases.articulated()
    edges, phones = data.draw(cases.schedules(table.phones, size=40))
    track = animate(table, rules, edges, phones, fps=fps)
    for phone, pose, peak in (("bmp", "PBM", 1.0), ("f", "FV", 0.95)):
        assert all(value >= 0.98 * peak for value in reached(track, edges, phones, phone, pose))


@pytest.mark.parametrize("fps", cases.RATES)
@SLOW
@given(st.data())
def test_closures_reach_sharp_peaks_that_fall_between_frames(fps, data):
    spike = cases.Drawn(((0.6, 0.0), (0.75, 1.0), (0.9, 0.0)))
    opening = cases.Drawn(((0.0, 1.0), (1.0, 1.0)))
    curves = {("ah", "bmp", "PBM"): spike, ("ah", "bmp", "open"): opening, ("bmp", "ah", "open"): opening}
    table, rules = CurveTable.build(("ah", "bmp"), cases.POSES, curves), cases.pose_set()
    lengths = data.draw(st.lists(st.integers(60_000, 300_000), min_size=2, max_size=12))
    edges = np.cumsum([data.draw(st.integers(0, 99_999)), *lengths]).tolist()
    phones = ["ah" if i % 2 == 0 else "bmp" for i in range(len(lengths))]
    track = animate(table, rules, edges, phones, fps=fps)
    assert all(value >= 0.98 for value in reached(track, edges, phones, "bmp", "PBM"))
    assert cases.broken(track.weights, rules, fps) == []


@pytest.mark.parametrize("word", ["bmp-ah-bmp", "bmp-ih-bmp-ih", "bmp-ah-bmp-ah", "f-ah-f", "bmp-ah-f-ah-bmp"])
@pytest.mark.parametrize("fps", [30.0, 60.0])
@given(
    lengths=st.lists(st.integers(80_000, 250_000), min_size=5, max_size=5), stop=st.integers(60_000, 120_000), start=st.integers(0, 100_000)
)
@settings(max_examples=25)
def test_the_mouth_opens_between_closures_of_bob_baby_mama_papa(word, fps, lengths, stop, start):
    phones = ["_", *word.split("-"), "_"]
    closed = ("_", "bmp", "f")
    stop = max(stop, 80_000) if fps < 60 else stop  # two frames of 30 a second are as long as a short stop
    spans = [300_000, *[stop if p in closed else length for p, length in zip(phones[1:-1], lengths, strict=False)], 300_000]
    edges = np.cumsum([start, *spans]).tolist()
    track = animate(cases.articulated(), cases.pose_set(), edges, phones, fps=fps)
    opening = track.pose("open")
    for (begin, end), phone in zip(pairwise(edges), phones, strict=True):
        if phone not in closed:
            during = opening[(track.times >= begin / 1e6) & (track.times <= end / 1e6)]
            assert during.max() > 0.25 * opening.max() > 0.02


def test_a_must_reach_pose_lets_go_in_every_phone_that_does_not_close_it():
    table, rules = cases.articulated(), cases.pose_set(window=0.4)
    track = animate(table, rules, [0, 80_000, 160_000, 240_000], ["bmp", "ah", "bmp"])
    lips = track.pose("PBM")
    assert lips[5:10].min() < 0.2 < 0.98 < min(lips[:5].max(), lips[10:15].max())


def test_a_valley_across_closing_phones_alone_is_filled():
    peaks = cases.Drawn(((0.55, 0.0), (0.7, 1.0), (0.85, 0.0)))
    curves = {(a, "bmp", "PBM"): peaks for a in ("_", "ah", "bmp")}
    table, rules = CurveTable.build(("ah", "bmp"), cases.POSES, curves), cases.pose_set()
    twice = animate(table, rules, [0, 60_000, 120_000], ["bmp", "bmp"]).pose("PBM")
    assert twice[2:5].min() > 0.98


def test_closing_phones_follow_from_the_curves():
    table = cases.articulated()
    found = {pose: [p for p, on in zip(table.phones, table.closing[i], strict=True) if on] for i, pose in enumerate(table.poses)}
    assert (found["PBM"], found["FV"]) == (["bmp"], ["f"])
    renamed = CurveTable.build(("x", "y"), ("shut",), {("x", "y", "shut"): cases.Drawn(((0.4, 0), (0.7, 0.8), (1, 0)))})
    assert renamed.closing.tolist() == [[False, False, False]]  # one pair of many is not a habit
    every = {(a, "y", "shut"): cases.Drawn(((0.4, 0), (0.7, 0.8), (1, 0.8))) for a in ("_", "x", "y")}
    every |= {("y", a, "shut"): cases.Drawn(((0, 0.8), (0.3, 0.8), (0.6, 0))) for a in ("_", "x")}
    assert CurveTable.build(("x", "y"), ("shut",), every).closing.tolist() == [[False, False, True]]


def test_valleys_lie_between_neighbouring_peaks_and_plateaus():
    weights = np.array([[0, 1, 1, 0.2, 0.2, 0.8, 0, 0, 0, 0.5, 0.4, 0.4, 0.4, 0.4, 0.1, 0.6, 0.0]])
    assert [part.tolist() for part in valleys(weights, 3)] == [[13], [15]]  # the level stretch of three steps ends it
    assert [part.tolist() for part in valleys(weights, 3.5)] == [[2], [5]]
    assert [part.tolist() for part in valleys(weights, 7)] == [[2, 5, 9], [5, 9, 15]]
