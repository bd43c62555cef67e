"""A schedule is contiguous timed phones in whole microseconds."""

import itertools
import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.errors import ScheduleError
from lipdb.schedule import Phone, Schedule

lengths = st.lists(st.integers(2, 5_000_000), min_size=1, max_size=30)


def schedule_of(lengths: list[int], start: int = 0) -> Schedule:
    edges = [start]
    for length in lengths:
        edges.append(edges[-1] + length)
    phones = (Phone(f"p{i}", ("ah", "d")[: 1 + i % 2], "common", i % 4 - 1, i % 5, i % 2) for i in range(len(lengths)))
    return Schedule(tuple(edges), tuple(phones), words=("one", "two", "three"))


@given(lengths, st.integers(-1_000_000_000, 1_000_000_000))
def test_json_gives_the_same_schedule_back(lengths: list[int], start: int) -> None:
    schedule = schedule_of(lengths, start)
    assert Schedule.from_json(json.loads(json.dumps(schedule.to_json()))) == schedule


@given(lengths)
def test_a_phone_of_several_common_phones_shares_its_time_and_none_is_lost(lengths: list[int]) -> None:
    schedule = schedule_of(lengths)
    edges, names = schedule.common()
    assert len(edges) == len(names) + 1
    assert set(schedule.edges) <= set(edges)
    assert all(a < b for a, b in itertools.pairwise(edges))
    assert list(names) == [name for phone in schedule.phones for name in phone.common]


def test_gaps_between_intervals_become_silence() -> None:
    schedule = Schedule.from_intervals([(0.1, 0.2, "a"), (0.5, 0.75, "b")])
    assert [phone.symbol for phone in schedule.phones] == ["a", "_", "b"]
    assert schedule.edges == (100_000, 200_000, 500_000, 750_000)
    assert schedule.duration == 0.65


@pytest.mark.parametrize(
    ("intervals", "complaint"),
    [
        ([], "no phones"),
        ([(0, float("nan"), "a")], "not a number"),
        ([(float("-inf"), 1, "a")], "not a number"),
        ([(0, 0, "a")], "end must come after its start"),
        ([(1, 0.5, "a")], "end must come after its start"),
        ([(0, 1, "a"), (0.5, 2, "b")], "before the one in front of it ends"),
        ([(0, 1, "a"), (0.999999, 1.0, "b")], "shorter than a microsecond"),
    ],
)
def test_impossible_times_are_refused_in_one_line(intervals: list[tuple[float, float, str]], complaint: str) -> None:
    with pytest.raises(ScheduleError, match=complaint) as error:
        Schedule.from_intervals(intervals)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "data", [None, [], {}, {"phones": 3}, {"phones": [{"symbol": "a"}]}, {"phones": [{"start": "x", "end": 1, "symbol": "a"}]}]
)
def test_json_that_is_no_schedule_is_refused(data: object) -> None:
    with pytest.raises(ScheduleError, match="not a schedule"):
        Schedule.from_json(data)


def test_a_phone_without_a_common_phone_cannot_be_played() -> None:
    with pytest.raises(ScheduleError, match="'x' has no common phone"):
        Schedule.from_intervals([(0, 1, "x")]).common()


def test_shifting_moves_every_edge() -> None:
    assert schedule_of([10, 20]).shifted(5).edges == (5, 15, 35)
