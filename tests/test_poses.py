"""A pose set reads its rules from curated data and refuses rules that can't be kept."""

from __future__ import annotations

from dataclasses import replace

import engine_cases as cases
import numpy as np
import pytest

from lipdb.errors import PhonesetError
from lipdb.poses import PoseSet


def records():
    def row(pose, position, priority, speed, must):
        return {"pose": pose, "position": str(position), "priority": priority, "speed": str(speed), "must_reach": must}

    rows = [row("lips", 1, "2", 15, "yes"), row("jaw", 0, "1", 12.5, "no"), row("tongue", 2, "", 20, "no")]
    return {
        "poses/sets.tsv": {("mine",): {"pose_set": "mine", "window": "0.18", "threshold": "2"}},
        "poses/mine.tsv": {(r["pose"],): r for r in rows},
        "constraints/mine.tsv": {("jaw", "lips"): {"pose": "jaw", "other": "lips", "threshold": "0.5"}},
    }


def test_a_pose_set_is_read_in_order_of_position():
    rules = PoseSet.from_records(records(), "mine")
    assert (rules.name, rules.poses, rules.priority, rules.window) == ("mine", ("jaw", "lips", "tongue"), (1, 2, None), 0.18)
    assert rules.speed.tolist() == [12.5, 15, 20]
    assert rules.must_reach.tolist() == [False, True, False]
    assert rules.threshold.tolist() == [[2, 0.5, 2], [0.5, 2, 2], [2, 2, 2]]


def test_an_unknown_set_and_an_unknown_pose_are_named():
    with pytest.raises(PhonesetError, match=r"'yours' is not in poses/sets\.tsv and poses/yours\.tsv; there are: mine"):
        PoseSet.from_records(records(), "yours")
    wrong = records()
    wrong["constraints/mine.tsv"]["jaw", "nose"] = {"threshold": "1"}
    with pytest.raises(PhonesetError, match=r"jaw nose: poses/mine\.tsv has no such pose"):
        PoseSet.from_records(wrong, "mine")


def test_must_reach_poses_come_first_then_priorities_then_the_order_of_the_set():
    rules = cases.pose_set(("a", "b", "c", "d", "e"), priority={"a": 1, "c": 7, "e": 0}, must=("e",), limits={})
    assert [rules.poses[i] for i in rules.descending] == ["e", "c", "a", "b", "d"]


def test_levels_follow_from_constraints_that_can_bind():
    rules = cases.pose_set()
    assert [{rules.poses[i] for i in level} for level in rules.levels] == [
        {"PBM", "FV"},
        {"ShCh", "W", "wide", "tBack", "tRoof", "tTeeth"},
        {"open"},
    ]
    assert {rules.poses[j]: c for j, c in rules.bounds(0)} == {"PBM": 0.5, "FV": 0.5, "ShCh": 0.5}
    assert rules.bounds(rules.poses.index("PBM")) == ()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"poses": ("a", "a")}, "must be there and differ"),
        ({"speed": np.array([15.0, 0.0])}, "speeds must be above 0"),
        ({"speed": np.array([15.0, np.inf])}, "speeds must be above 0"),
        ({"priority": (1,)}, "needs a priority"),
        ({"threshold": np.array([[2.0, 1.0], [0.5, 2.0]])}, "the same both ways"),
        ({"threshold": np.array([[2.0, -1.0], [-1.0, 2.0]])}, "0 or more"),
        ({"window": -0.1}, "window"),
    ],
)
def test_rules_that_cannot_be_kept_are_refused(change, message):
    rules = cases.pose_set(("a", "b"), priority={}, must=())
    with pytest.raises(PhonesetError, match=message):
        replace(rules, **change)
