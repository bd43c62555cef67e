"""Range, speed limits and constraints hold at every frame, at every frame rate, for any curves and rules."""

from __future__ import annotations

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import animate

SLOW = settings(max_examples=150, suppress_health_check=[HealthCheck.too_slow])
RATES = st.sampled_from(cases.RATES)


@SLOW
@given(RATES, st.data())
def test_every_promise_holds_at_every_frame_for_random_rules_curves_and_schedules(fps, data):
    rules, table = data.draw(cases.worlds())
    edges, phones = data.draw(cases.schedules(table.phones))
    track = animate(table, rules, edges, phones, fps=fps)
    assert cases.broken(track.weights, rules, fps) == []


@SLOW
@given(RATES, st.data())
def test_every_promise_holds_for_curves_as_an_artist_draws_them(fps, data):
    rules, table = cases.pose_set(), cases.articulated()
    edges, phones = data.draw(cases.schedules(table.phones, size=40))
    track = animate(table, rules, edges, phones, fps=fps)
    assert cases.broken(track.weights, rules, fps) == []


def test_a_promise_that_is_broken_would_be_seen():
    rules = cases.pose_set()
    weights = np.zeros((4, 9))
    weights[2, [0, 3]] = 0.9, 1.0
    assert any("open breaks its constraint with PBM" in word for word in cases.broken(weights, rules, 60))
    assert any("PBM is too fast" in word for word in cases.broken(weights, rules, 60))


def test_poses_without_a_priority_yield_to_those_before_them_in_the_set():
    rules = cases.pose_set(("first", "second"), priority={}, must=(), limits={("first", "second"): 1.0}, speed=60)
    keys = cases.Drawn(((0.1, 0.0), (0.4, 0.9), (0.6, 0.9), (0.9, 0.0)))
    table = cases.CurveTable.build(("a",), rules.poses, {("a", "a", pose): keys for pose in rules.poses})
    track = animate(table, rules, [0, 500_000, 1_000_000], ["a", "a"])
    assert track.weights[30] == pytest.approx([0.9, 0.1])


def test_must_reach_poses_are_never_lowered_whatever_their_priority():
    rules = cases.pose_set(("low", "high"), priority={"low": 1, "high": 2}, must=("low",), limits={("low", "high"): 0.5}, speed=60)
    keys = cases.Drawn(((0.1, 0.0), (0.4, 0.9), (0.6, 0.9), (0.9, 0.0)))
    table = cases.CurveTable.build(("a",), rules.poses, {("a", "a", pose): keys for pose in rules.poses})
    assert animate(table, rules, [0, 500_000, 1_000_000], ["a", "a"]).weights[30] == pytest.approx([0.9, 0.0])
