"""Frame rates sample one and the same motion."""

from __future__ import annotations

from dataclasses import replace

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import animate
from lipdb.engine.timeline import rate_of
from lipdb.errors import InputError

SLOW = settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])


@SLOW
@given(st.data())
def test_30_fps_is_every_second_frame_of_60_fps_within_a_twentieth(data):
    rules, table = cases.pose_set(), cases.articulated()
    edges, phones = data.draw(cases.schedules(table.phones, size=40))
    coarse = animate(table, rules, edges, phones, fps=30).weights
    fine = animate(table, rules, edges, phones, fps=60, frames=2 * len(coarse)).weights[::2]
    np.testing.assert_allclose(coarse, fine, atol=0.05)


@SLOW
@given(st.data())
def test_30_fps_equals_60_fps_for_any_curves_and_rules_with_the_papers_speed_limit(data):
    rules, table = data.draw(cases.worlds())
    rules = replace(rules, speed=np.full(len(rules.poses), 15.0))
    edges, phones = data.draw(cases.schedules(table.phones))
    coarse = animate(table, rules, edges, phones, fps=30).weights
    fine = animate(table, rules, edges, phones, fps=60, frames=2 * len(coarse)).weights[::2]
    np.testing.assert_allclose(coarse, fine, atol=0.05)


@given(
    st.sampled_from([(23.976, 2997, 125), (29.97, 2997, 100), (24000 / 1001, 24000, 1001), (59.94, 2997, 50), (12.5, 25, 2), (60, 60, 1)])
)
def test_a_frame_rate_is_read_as_the_simplest_fraction_that_it_is(case):
    fps, over, under = case
    rate = rate_of(fps)
    assert rate.second * under == rate.frame * over
    assert rate.second == 60 * rate.control == 1_000_000 * rate.microsecond


@pytest.mark.parametrize("fps", [0.0, -24.0, float("nan"), float("inf"), 0.5, 2000.0])
def test_a_frame_rate_that_cannot_be_is_refused(fps):
    with pytest.raises(InputError, match="frame rate"):
        animate(cases.articulated(), cases.pose_set(), [0, 100_000], ["ah"], fps=fps)


def test_an_odd_frame_rate_is_played_too():
    edges, phones = [0, 200_000, 400_000, 600_000], ["ah", "bmp", "ih"]
    track = animate(cases.articulated(), cases.pose_set(), edges, phones, fps=np.pi * 10)
    assert cases.broken(track.weights, cases.pose_set(), np.pi * 10) == []
    assert track.pose("PBM").max() > 0.98
