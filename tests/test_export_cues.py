"""Sprite cues: winner takes all, held, contiguous, with every closure seen."""

from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lipdb.export.cues import REACHED, REST_WEIGHT, cues
from lipdb.track import Track

SHAPES = ("A", "B", "D")


@st.composite
def tracks(draw: st.DrawFn) -> Track:
    frames = draw(st.integers(1, 60))
    weights = draw(arrays(np.float64, (frames, len(SHAPES)), elements=st.floats(0, 1)))
    return Track(weights, SHAPES, draw(st.sampled_from([24.0, 30.0, 60.0])))


def _frames(track: Track, hold: float) -> int:
    return max(math.ceil(hold * track.fps - 1e-9), 1)


@given(tracks(), st.floats(0, 0.3))
def test_cues_cover_the_line_without_gaps_and_change_shape_at_every_border(track: Track, hold: float) -> None:
    found = cues(track, hold)
    assert found[0][0] == 0
    assert found[-1][1] == len(track.weights) / track.fps
    for (_, end, shape), (start, _, other) in pairwise(found):
        assert end == start
        assert shape != other


@given(tracks(), st.floats(0, 0.3))
def test_every_cue_is_held_unless_the_line_itself_is_shorter(track: Track, hold: float) -> None:
    found = cues(track, hold)
    if len(track.weights) < _frames(track, hold):
        assert len(found) == 1
    else:
        assert min(round((end - start) * track.fps) for start, end, _ in found) >= _frames(track, hold)


@given(tracks())
def test_without_a_hold_the_heaviest_shape_of_every_frame_wins(track: Track) -> None:
    shown = _per_frame(track, cues(track, 0.0))
    heaviest = track.weights.max(axis=1)
    assert all(_weight(track, frame, shape) >= max(heaviest[frame], REST_WEIGHT) - 1e-5 for frame, shape in enumerate(shown))


def _per_frame(track: Track, found: list[tuple[float, float, str]]) -> list[str]:
    return [shape for start, end, shape in found for _ in range(round((end - start) * track.fps))]


def _weight(track: Track, frame: int, shape: str) -> float:
    return REST_WEIGHT if shape == "X" else float(track.pose(shape)[frame])


@settings(max_examples=40)
@given(arrays(np.float64, (7, 2), elements=st.floats(0, 1)), st.integers(1, 4))
def test_no_other_cut_shows_more_weight(weights: np.ndarray, hold: int) -> None:
    track = Track(weights, ("A", "B"), 10.0)
    shown = sum(_weight(track, frame, shape) for frame, shape in enumerate(_per_frame(track, cues(track, hold / 10))))
    best = 0.0
    for labels in product("ABX", repeat=7):
        runs = [
            len(run) for run in "".join("|" * (a != b) + b for a, b in zip(" " + "".join(labels), labels, strict=False)).split("|") if run
        ]
        if min(runs) >= hold:
            best = max(best, sum(_weight(track, frame, shape) for frame, shape in enumerate(labels)))
    assert shown == pytest.approx(best, abs=1e-4)


@given(tracks(), st.floats(0.02, 0.15))
def test_every_closure_farther_than_a_hold_from_other_closures_is_seen_at_its_peak(track: Track, hold: float) -> None:
    lips = track.pose("A")
    shown = _per_frame(track, cues(track, hold, keep={"A"}))
    reached = np.concatenate([[0], lips >= REACHED, [0]])
    for start, end in np.flatnonzero(np.diff(reached)).reshape(-1, 2):
        assert any(shown[frame] == "A" for frame in range(start, end))


def test_a_closure_shorter_than_the_hold_is_kept_and_without_keeping_it_is_lost() -> None:
    weights = np.zeros((30, 3))
    weights[:, 2] = 1.0
    weights[14:16] = [0.9, 0, 0]
    track = Track(weights, SHAPES, 60.0)
    assert [shape for _, _, shape in cues(track, 0.1)] == ["D"]
    kept = cues(track, 0.1, keep={"A"})
    assert [shape for _, _, shape in kept] == ["D", "A", "D"]
    assert kept[1][0] <= 14 / 60 < 16 / 60 <= kept[1][1]


def test_silence_rests() -> None:
    weights = np.zeros((60, 3))
    weights[20:40, 1] = 0.8
    assert [(round(start, 4), round(end, 4), shape) for start, end, shape in cues(Track(weights, SHAPES, 60.0), 0.08)] == [
        (0.0, 0.3333, "X"),
        (0.3333, 0.6667, "B"),
        (0.6667, 1.0, "X"),
    ]


def test_no_frames_give_no_cues() -> None:
    assert cues(Track(np.zeros((0, 3)), SHAPES, 60.0), 0.08) == []


def test_an_hour_takes_seconds() -> None:
    ticks = np.arange(60 * 60 * 30)
    weights = np.stack([np.sin(ticks / k) ** 2 for k in (5, 7, 9)], axis=1)
    assert len(cues(Track(weights, SHAPES, 30.0), 0.08, keep={"A"})) > 1000
