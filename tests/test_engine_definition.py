"""The fast engine does what its plain definition says."""

from __future__ import annotations

import engine_cases as cases
import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import animate

SLOW = settings(max_examples=80, suppress_health_check=[HealthCheck.too_slow])


@SLOW
@given(st.data())
def test_a_track_at_60_fps_is_what_the_definition_gives(data):
    rules, table = data.draw(cases.worlds())
    edges, phones = data.draw(cases.schedules(table.phones))
    track = animate(table, rules, edges, phones)
    plain = cases.plain_track(table, rules, edges, phones, len(track.weights))
    np.testing.assert_allclose(track.weights, plain, atol=1e-9)
