"""Many lines in one call equal each alone; long takes in stretches equal the whole; memory grows with the output only."""

from __future__ import annotations

import tracemalloc

import engine_cases as cases
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipdb.engine import animate, animate_lines, play

SLOW = settings(max_examples=40, suppress_health_check=[HealthCheck.too_slow])


@pytest.mark.parametrize("fps", [60.0, 24.0, 120.0])
@SLOW
@given(st.data())
def test_a_batch_equals_its_lines_one_by_one(fps, data):
    rules, table = data.draw(cases.worlds())
    lines = data.draw(st.lists(cases.schedules(table.phones, size=8), min_size=1, max_size=5))
    tracks = animate_lines(table, rules, lines, fps=fps)
    assert len(tracks) == len(lines)
    for line, track in zip(lines, tracks, strict=True):
        np.testing.assert_allclose(track.weights, animate(table, rules, *line, fps=fps).weights, atol=1e-9)


@pytest.mark.parametrize("fps", [60.0, 30.0, 25.0])
@SLOW
@given(st.data())
def test_a_take_played_in_short_stretches_equals_the_whole(fps, data):
    rules, table = data.draw(cases.worlds())
    edges, phones = data.draw(cases.schedules(table.phones, size=30))
    whole = animate(table, rules, edges, phones, fps=fps).weights
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(play, "CHUNK", 37)
        parts = animate(table, rules, edges, phones, fps=fps).weights
    np.testing.assert_allclose(parts, whole, atol=1e-9)


def test_frames_can_be_asked_for_line_by_line_and_tracks_sliced():
    table, rules = cases.articulated(), cases.pose_set()
    tracks = animate_lines(table, rules, [([0, 100_000], ["ah"]), ([0, 50_000, 90_000], ["ih", "d"])], frames=[5, 9])
    assert [len(track.weights) for track in tracks] == [5, 9]
    assert [len(track.weights) for track in tracks[1:]] == [9]
    assert tracks[-1].poses == rules.poses
    assert tracks[-1].fps == 60


def test_no_lines_are_no_tracks():
    assert list(animate_lines(cases.articulated(), cases.pose_set(), [])) == []


def test_edges_may_be_arrays():
    table, rules = cases.articulated(), cases.pose_set()
    line = [0, 100_000, 200_000], ["ah", "bmp"]
    np.testing.assert_array_equal(animate(table, rules, np.array(line[0]), line[1]).weights, animate(table, rules, *line).weights)


def speech(minutes: float):
    """Eleven phones a second without a long pause."""
    rng = np.random.default_rng(1)
    count = int(minutes * 660)
    phones = [cases.PHONES[i] for i in rng.integers(0 if count % 12 == 0 else 1, len(cases.PHONES), count)]
    return np.cumsum(np.append(0, rng.integers(50_000, 132_000, count))).tolist(), phones


def test_memory_grows_with_the_output_only():
    table, rules = cases.articulated(), cases.pose_set()
    beyond = []
    for minutes in (10, 40):
        edges, phones = speech(minutes)
        tracemalloc.start()
        track = animate(table, rules, edges, phones)
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        beyond.append(peak - track.weights.nbytes - 500 * len(phones))  # a pair is kept in a few dozen numbers
    assert beyond[1] < beyond[0] + 1_000_000
    assert beyond[1] < 20_000_000
