"""Every stage of a line can be looked at, and each weight explained."""

from __future__ import annotations

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipdb.engine import animate, explain, stages
from lipdb.errors import InputError

BOB = [0, 300_000, 400_000, 520_000, 620_000, 900_000], ["_", "bmp", "ah", "bmp", "_"]


@pytest.mark.parametrize("fps", [60.0, 24.0])
@settings(max_examples=30)
@given(st.data())
def test_the_stages_end_in_the_track(fps, data):
    rules, table = data.draw(cases.worlds())
    edges, phones = data.draw(cases.schedules(table.phones, size=10))
    made = stages(table, rules, edges, phones, fps=fps)
    np.testing.assert_allclose(made.track.weights, animate(table, rules, edges, phones, fps=fps).weights, atol=1e-12)
    assert (made.smoothed >= made.stitched).all()
    held = rules.must_reach
    assert (made.constrained[:, held] >= made.smoothed[:, held]).all()
    assert (made.limited[:, held] >= made.constrained[:, held]).all()
    assert (made.constrained[:, ~held] <= made.smoothed[:, ~held]).all()
    assert (made.limited[:, ~held] <= made.constrained[:, ~held]).all()


@settings(max_examples=30)
@given(st.data())
def test_stitched_weights_are_the_largest_of_the_laid_curves(data):
    rules, table = data.draw(cases.worlds(must=False))
    edges, phones = data.draw(cases.schedules(table.phones, size=10))
    made = stages(table, rules, edges, phones)
    drawn = [(table.poses.index(curve.pose), curve.times, curve.weights) for curve in made.curves]
    np.testing.assert_allclose(made.stitched.T, cases.at_times(drawn, len(table.poses), made.times), atol=1e-6)


def test_an_explanation_names_pairs_curves_stage_and_what_a_pose_yields_to():
    table, rules = cases.articulated(), cases.pose_set()
    told = explain(table, rules, *BOB, at=0.46)
    assert (told.frame, told.time) == (28, pytest.approx(28 / 60))
    assert told.pairs == (("bmp", "ah"), ("ah", "bmp"))
    story = {pose.pose: pose for pose in told.poses}
    jaw = story["open"]
    assert {(left, right) for left, right, _ in jaw.curves} == {("bmp", "ah"), ("ah", "bmp")}
    assert jaw.weights["curve"] == pytest.approx(0.9, abs=0.01)
    assert jaw.weights["final"] == pytest.approx(float(animate(table, rules, *BOB).weights[28, 0]))
    assert jaw.stage == "constrained"
    assert "PBM" in jaw.yields_to
    assert story["W"].weights["final"] == 0
    assert story["W"].stage == ""


def test_a_valley_that_was_filled_is_told_so():
    table, rules = cases.articulated(), cases.pose_set(limits={}, must=())
    told = explain(table, rules, [0, 90_000, 150_000, 240_000], ["ah", "bmp", "ah"], at=0.12)
    assert next(pose for pose in told.poses if pose.pose == "open").stage == "smoothed"


def test_in_rest_there_is_nothing_to_tell():
    told = explain(cases.articulated(), cases.pose_set(), *BOB, at=0.0)
    assert told.pairs == ()
    assert all(not pose.curves and pose.stage == "" and pose.yields_to == () for pose in told.poses)


@pytest.mark.parametrize("at", [-0.1, 3.0, float("nan")])
def test_a_time_outside_the_track_is_refused(at):
    with pytest.raises(InputError, match=r"the track lasts from 0 to 0\.9 s"):
        explain(cases.articulated(), cases.pose_set(), *BOB, at=at)
