"""Sparse keys: few, and within the tolerance."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lipdb.export.keys import dense_weights, sparse_keys

WEIGHTS = st.integers(1, 200).flatmap(lambda n: arrays(np.float64, n, elements=st.floats(0, 1)))


@given(WEIGHTS, st.sampled_from([0.0001, 0.001, 0.05]))
def test_reading_keys_back_gives_the_weights_within_the_tolerance(weights: np.ndarray, tolerance: float) -> None:
    keys = sparse_keys(weights, tolerance=tolerance)
    assert np.abs(dense_weights(keys, len(weights)) - weights).max() <= tolerance + 1e-12


@given(WEIGHTS)
def test_keys_run_forwards_from_the_first_frame_to_the_last(weights: np.ndarray) -> None:
    frames = [frame for frame, _ in sparse_keys(weights)]
    assert frames == sorted(set(frames))
    assert (frames[0], frames[-1]) == (0, len(weights) - 1)


def test_straight_lines_need_keys_only_where_they_bend() -> None:
    weights = np.concatenate([np.zeros(30), np.linspace(0, 1, 21), np.ones(20)])
    assert sparse_keys(weights) == [(0, 0.0), (30, 0.0), (50, 1.0), (70, 1.0)]


def test_a_single_frame_and_no_frame() -> None:
    assert sparse_keys(np.array([0.25])) == [(0, 0.25)]
    assert sparse_keys(np.array([])) == []
    assert dense_weights([], 3).tolist() == [0, 0, 0]
