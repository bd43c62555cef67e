"""The engine says what it can't play, and plays any pose set, any phones and any lack of curves."""

from __future__ import annotations

import engine_cases as cases
import numpy as np
import pytest

from lipdb.engine import CurveTable, animate, animate_lines
from lipdb.errors import CurveError, ScheduleError


def test_a_line_with_the_wrong_number_of_edges_is_named():
    lines = [([0, 100_000], ["ah"]), ([0, 100_000], ["ah", "d"])]
    with pytest.raises(ScheduleError, match="line 1: 2 phones and 2 edges"):
        animate_lines(cases.articulated(), cases.pose_set(), lines)


def test_a_line_without_phones_is_refused():
    with pytest.raises(ScheduleError, match="line 0: 0 phones"):
        animate(cases.articulated(), cases.pose_set(), [0], [])


def test_edges_that_do_not_run_forward_are_refused():
    with pytest.raises(ScheduleError, match="from 200000 to 200000 µs"):
        animate(cases.articulated(), cases.pose_set(), [0, 200_000, 200_000], ["ah", "d"])


@pytest.mark.parametrize("edges", [[0.0, 0.25], [0, float("nan")], [0, 10**20], np.array([0.0, 0.25]), [0, "1"]])
def test_edges_must_be_whole_microseconds(edges):
    with pytest.raises(ScheduleError, match="whole microseconds"):
        animate(cases.articulated(), cases.pose_set(), edges, ["ah"])


def test_a_phone_that_the_table_lacks_is_named():
    with pytest.raises(CurveError, match="no phone 'zh'"):
        animate(cases.articulated(), cases.pose_set(), [0, 100_000], ["zh"])


def test_a_negative_number_of_frames_is_refused():
    with pytest.raises(ScheduleError, match="-3 frames"):
        animate(cases.articulated(), cases.pose_set(), [0, 100_000], ["ah"], frames=-3)


def test_a_table_for_other_poses_is_refused():
    with pytest.raises(CurveError, match="not for those of pose set 'facefx'"):
        animate(cases.articulated(poses=("open", "W")), cases.pose_set(), [0, 100_000], ["ah"])


def test_an_empty_table_is_rest():
    table = CurveTable.build(("a", "b"), cases.POSES, {})
    for fps in (60, 24):
        track = animate(table, cases.pose_set(), [0, 100_000, 200_000], ["a", "b"], fps=fps)
        assert len(track.weights)
        assert not track.weights.any()


def test_an_invented_set_of_three_poses_speaks():
    poses = ("gape", "pucker", "flap")
    rules = cases.pose_set(poses, priority={"pucker": 1}, must=("flap",), limits={("gape", "flap"): 0.8}, name="bird")
    keys = {"gape": ((0.2, 0.0), (0.5, 1.0), (0.8, 0.0)), "flap": ((0.6, 0.0), (0.75, 1.0), (0.9, 0.0)), "pucker": ()}
    table = CurveTable.build(("k", "q"), poses, {("k", "q", pose): cases.Drawn(keys[pose]) for pose in poses})
    track = animate(table, rules, [0, 200_000, 400_000], ["k", "q"])
    assert track.poses == poses
    assert track.pose("flap").max() == pytest.approx(1)
    assert track.pose("gape").max() > 0.5
    assert not track.pose("pucker").any()
    assert cases.broken(track.weights, rules, 60) == []


def test_phones_may_be_new_and_stand_beside_others():
    phones = (*cases.PHONES, "click")
    curves = {("ah", "click", "open"): cases.Drawn(((0.3, 0.0), (0.8, 0.7), (1.0, 0.0)))}
    table = CurveTable.build(phones, cases.POSES, curves)
    track = animate(table, cases.pose_set(), [0, 200_000, 400_000], ["ah", "click"])
    assert track.pose("open").max() == pytest.approx(0.5)  # what C(open, FV) = 0.5 leaves it
    assert not np.delete(track.weights, 0, axis=1).any()


def test_a_table_takes_silence_in_front_and_each_phone_once():
    assert CurveTable.build(("b", "a", "b"), ("p",), {}).phones == ("_", "b", "a")
    assert CurveTable.build(("b", "_"), ("p",), {}).phones == ("_", "b")


@pytest.mark.parametrize(
    "keys", [((0.5, 0.1), (0.4, 0.1)), ((0.0, 0.1), (1.2, 0.1)), ((0.2, -0.1),), ((0.2, 1.1),), ((float("nan"), 0.5),)]
)
def test_keys_that_cannot_be_are_refused(keys):
    with pytest.raises(CurveError, match="curve a a p: keys must"):
        CurveTable.build(("a",), ("p",), {("a", "a", "p"): cases.Drawn(keys)})


def test_an_unknown_warp_is_refused():
    with pytest.raises(CurveError, match="'bent' is neither border nor linear"):
        CurveTable.build(("a",), ("p",), {("a", "a", "p"): cases.Drawn(((0.0, 1.0),), "bent")})
