"""Shifting a schedule moves its track, cutting it in a pause gives its parts, and silence is rest."""

from __future__ import annotations

from fractions import Fraction

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import CurveTable, animate

SLOW = settings(max_examples=25, suppress_health_check=[HealthCheck.too_slow])


def whole_shift(fps: float) -> tuple[int, int]:
    """The fewest frames that are a whole number of microseconds, and that number."""
    exact = Fraction(fps).limit_denominator(1001)
    span = 1_000_000 / exact
    return span.denominator, span.numerator


@pytest.mark.parametrize("fps", [rate for rate in cases.RATES if whole_shift(rate)[0] < 4000])
@SLOW
@given(st.data())
def test_a_shift_by_whole_frames_and_microseconds_moves_the_track_and_changes_nothing_else(fps, data):
    rules, table = data.draw(cases.worlds())
    edges, phones = data.draw(cases.schedules(table.phones))
    unit, microseconds = whole_shift(fps)
    times = data.draw(st.integers(1, 7)) if unit < 100 else 1
    moved = animate(table, rules, [edge + times * microseconds for edge in edges], phones, fps=fps)
    still = animate(table, rules, edges, phones, fps=fps)
    assert len(moved.weights) == len(still.weights) + times * unit
    np.testing.assert_allclose(moved.weights[times * unit :], still.weights, atol=1e-9)


@pytest.mark.parametrize("fps", [24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 120.0])
@SLOW
@given(st.data())
def test_a_take_cut_on_a_frame_in_a_pause_of_a_second_equals_its_parts(fps, data):
    rules, table = data.draw(cases.worlds(must=False))
    first, names = data.draw(cases.schedules(table.phones, start=0))
    second, more = data.draw(cases.schedules(table.phones, start=0))
    unit, span = whole_shift(fps)
    rested = first[-2] if names[-1] == "_" else first[-1]  # the cut comes half a second into the pause or later
    cut = -(-max(rested + 500_000, first[-1] + 1) // span) * span
    last = cut + data.draw(st.integers(500_000, 900_000))
    edges = [*first, last, *[last + edge - second[0] for edge in second[1:]]]
    whole = animate(table, rules, edges, [*names, "_", *more], fps=fps).weights
    frame = cut // span * unit
    head = animate(table, rules, [*first, cut], [*names, "_"], fps=fps, frames=frame).weights
    tail = animate(table, rules, [cut, *edges[len(first) :]], ["_", *more], fps=fps).weights[frame:]
    np.testing.assert_allclose(np.concatenate((head, tail)), whole, atol=1e-9)


def test_a_long_pause_is_rest_but_for_a_quarter_of_a_second_at_each_end():
    wide = cases.Drawn(((0.0, 0.2), (1.0, 0.2)))
    table = CurveTable.build(("ah",), cases.POSES, {("ah", "_", "open"): wide, ("_", "ah", "open"): wide})
    track = animate(table, cases.pose_set(), [0, 200_000, 2_200_000, 2_400_000], ["ah", "_", "ah"])
    moved = np.flatnonzero(track.pose("open") > 0) / 60
    assert moved[moved < 1].max() == pytest.approx(0.45, abs=0.02)
    assert moved[moved > 1].min() == pytest.approx(1.95, abs=0.02)


def test_neighbouring_silences_are_one():
    rules, table = cases.pose_set(), cases.articulated()
    one = animate(table, rules, [0, 100_000, 400_000, 500_000], ["ah", "_", "ih"])
    three = animate(table, rules, [0, 100_000, 150_000, 210_000, 400_000, 500_000], ["ah", "_", "_", "_", "ih"])
    np.testing.assert_array_equal(one.weights, three.weights)


def test_speech_without_silence_around_it_gets_a_quarter_of_a_second_clipped_to_the_frames_asked_for():
    rules, table = cases.pose_set(), cases.articulated()
    bare = animate(table, rules, [0, 300_000], ["ah"])
    padded = animate(table, rules, [-250_000, 0, 300_000, 550_000], ["_", "ah", "_"])
    np.testing.assert_array_equal(bare.weights, padded.weights)
    assert len(bare.weights) == 34
    assert bare.weights[0, 0] > 0
    assert not bare.weights[-1].any()


def test_a_track_has_the_frames_asked_for_and_rest_where_nothing_is_said():
    rules, table = cases.pose_set(), cases.articulated()
    long = animate(table, rules, [0, 300_000], ["ah"], frames=500)
    short = animate(table, rules, [0, 300_000], ["ah"], frames=3)
    assert long.weights.shape == (500, 9)
    assert not long.weights[60:].any()
    np.testing.assert_array_equal(short.weights, long.weights[:3])
    assert animate(table, rules, [0, 300_000], ["ah"], frames=0).weights.shape == (0, 9)


def test_silence_alone_is_rest():
    track = animate(cases.articulated(), cases.pose_set(), [0, 400_000, 1_000_000], ["_", "_"], fps=24)
    assert track.weights.shape == (25, 9)
    assert not track.weights.any()


def test_a_frame_on_a_border_takes_the_largest_of_the_pairs_that_meet_there():
    # Between a and b pose p ends at 0.8; between c and d, the next pair of the same parity, it starts at 0.3 on the same frame.
    curves = {("a", "b", "p"): cases.Drawn(((0.2, 0.8), (1.0, 0.8))), ("c", "d", "p"): cases.Drawn(((0.0, 0.3), (1.0, 0.3)))}
    table = CurveTable.build("abcd", ("p",), curves)
    rules = cases.pose_set(("p",), speed=900, must=(), window=0)
    track = animate(table, rules, [0, 100_000, 200_000, 300_000, 400_000], ["a", "b", "c", "d"])
    assert track.weights[[10, 12, 13, 14], 0] == pytest.approx([0.8, (0.8 + 4 * 0.8 + 0.3) / 6, (0.8 + 4 * 0.3 + 0.3) / 6, 0.3])


def test_the_border_warp_keeps_the_middle_key_on_the_border_and_the_linear_warp_does_not():
    keys = ((0.25, 0.0), (0.5, 1.0), (0.75, 0.0))
    rules = cases.pose_set(("p",), speed=900, must=(), window=0)
    peaks = {}
    for warp in ("border", "linear"):
        table = CurveTable.build("ab", ("p",), {("a", "b", "p"): cases.Drawn(keys, warp)})
        peaks[warp] = int(animate(table, rules, [0, 600_000, 800_000], ["a", "b"]).weights[:, 0].argmax())
    assert peaks == {"border": 36, "linear": 24}
