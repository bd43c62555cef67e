"""Phone times of a synthesiser, mended for lips."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from lipdb.speech.closures import ensure_shortest, restore_closures, share_swallowed

RATE = 1000


def _sound(*levels: tuple[float, int]) -> np.ndarray:
    """Noise of a level for a number of samples (milliseconds), one after another."""
    return np.concatenate([np.full(count, round(level * 10_000), np.int16) for level, count in levels])


def _restored(sound: np.ndarray, edges: list[float], stops: list[int], pauses: list[int] | None = None) -> list[float]:
    count = len(edges) - 1
    flags = [np.isin(np.arange(count), which) for which in (stops, pauses or [])]
    return [round(float(t), 3) for t in restore_closures(np.array(edges), *flags, sound, RATE)]


def test_a_stop_starts_where_the_quiet_in_front_of_its_burst_starts():
    sound = _sound((1, 160), (0, 40), (1, 100))
    assert _restored(sound, [0, 0.2, 0.3], [1]) == [0, 0.16, 0.3]


def test_a_mark_up_to_12_ms_behind_the_burst_still_finds_the_quiet():
    sound = _sound((1, 160), (0, 40), (1, 100))
    assert _restored(sound, [0, 0.21, 0.3], [1]) == [0, 0.16, 0.3]


def test_a_stop_without_quiet_in_front_keeps_its_time():
    assert _restored(_sound((1, 300)), [0, 0.2, 0.3], [1]) == [0, 0.2, 0.3]


def test_quiet_in_front_of_other_phones_stays_where_it_is():
    sound = _sound((1, 160), (0, 40), (1, 100))
    assert _restored(sound, [0, 0.2, 0.3], []) == [0, 0.2, 0.3]


def test_a_stop_never_takes_more_than_half_of_the_phone_in_front():
    sound = _sound((1, 100), (0, 60), (1, 100))
    assert _restored(sound, [0, 0.1, 0.16, 0.26], [2]) == [0, 0.1, 0.13, 0.26]


def test_a_stop_never_starts_more_than_90_ms_early():
    sound = _sound((1, 100), (0, 200), (1, 100))
    assert _restored(sound, [0, 0.3, 0.4], [1]) == [0, 0.21, 0.4]


def test_a_stop_after_a_pause_gets_60_ms_of_it():
    sound = _sound((0, 300), (1, 100))
    assert _restored(sound, [0, 0.3, 0.4], [1], [0]) == [0, 0.24, 0.4]


def test_many_stops_are_restored_at_once():
    sound = _sound(*[(1, 160), (0, 40)] * 50)
    edges = [0.2 * k for k in range(51)]
    restored = _restored(sound, edges, list(range(1, 50)))
    assert restored == [0, *(round(0.2 * k - 0.04, 3) for k in range(1, 50)), 10]


def test_a_swallowed_phone_takes_a_third_of_the_one_in_front_and_60_ms_at_most():
    shared = share_swallowed(np.array([0, 0.09, 0.09, 0.2, 0.6, 0.6, 0.7]))
    np.testing.assert_allclose(shared, [0, 0.06, 0.09, 0.2, 0.54, 0.6, 0.7])


def test_a_short_phone_takes_what_it_lacks_from_the_one_in_front():
    np.testing.assert_allclose(ensure_shortest(np.array([0, 0.1, 0.11, 0.3])), [0, 0.08, 0.11, 0.3])


def test_a_short_first_phone_takes_what_it_lacks_from_the_next():
    np.testing.assert_allclose(ensure_shortest(np.array([0, 0.01, 0.3])), [0, 0.03, 0.3])


def test_what_is_too_short_as_a_whole_is_shared_evenly():
    np.testing.assert_allclose(ensure_shortest(np.array([1, 1.02, 1.02, 1.03])), [1, 1.01, 1.02, 1.03])


@given(st.lists(st.floats(0, 0.5), min_size=1, max_size=40).filter(lambda lengths: sum(lengths) > 1e-3))
def test_no_phone_stays_shorter_than_the_shortest_and_both_ends_stay(lengths: list[float]):
    edges = np.concatenate([[0], np.cumsum(lengths)])
    moved = ensure_shortest(edges)
    assert moved[0] == edges[0]
    assert moved[-1] == edges[-1]
    assert np.diff(moved).min() >= min(0.03, edges[-1] / len(lengths)) - 1e-9


@given(st.lists(st.floats(0.03, 0.5), min_size=1, max_size=40))
def test_phones_that_are_long_enough_keep_their_times(lengths: list[float]):
    edges = np.concatenate([[0], np.cumsum(lengths)])
    np.testing.assert_allclose(ensure_shortest(edges), edges, atol=1e-9)
