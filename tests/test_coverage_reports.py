"""Frequencies of pairs: ranking, covering, gaps, choice of sentences, comparison."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.coverage.compare import compare
from lipdb.coverage.frequency import Frequency
from lipdb.coverage.report import Summary, plot, ranked
from lipdb.coverage.select import select
from lipdb.errors import InputError, OutputError

PAIRS = st.tuples(st.sampled_from("abcd_"), st.sampled_from("abcd_"))
ROWS = st.lists(st.tuples(st.sampled_from("abcd_"), st.sampled_from("abcd_"), st.integers(0, 50)), max_size=40)


@given(ROWS)
def test_a_frequency_is_the_sum_of_its_rows_in_falling_order(rows) -> None:
    frequency = Frequency.of(rows)
    assert sum(frequency.counts.values()) == sum(count for _, _, count in rows)
    assert list(frequency.counts.values()) == sorted(frequency.counts.values(), reverse=True)
    assert len(frequency) == len({(a, b) for a, b, count in rows if count})


@given(ROWS, st.floats(0.01, 1))
def test_the_pairs_that_cover_a_share_are_the_fewest_that_do(rows, share) -> None:
    frequency = Frequency.of(rows)
    count = frequency.covering(share)
    if not frequency.counts:
        assert count == 0
        return
    assert frequency.covered_by(count) >= share - 1e-9
    assert count == 1 or frequency.covered_by(count - 1) < share


def test_silence_is_left_out_on_request() -> None:
    frequency = Frequency.of([("_", "a", 3), ("a", "b", 1), ("b", "_", 4)], silence=False)
    assert dict(frequency.counts) == {("a", "b"): 1}
    assert frequency.share(("_", "a")) == 0


def test_an_empty_corpus_says_where_and_what_to_do() -> None:
    with pytest.raises(InputError, match=r"^empty\.parquet: holds no pair of phones; scan a corpus"):
        Frequency.of([]).required("empty.parquet")


def test_table_two_ranks_and_adds_up() -> None:
    rows = ranked(Frequency.of([("a", "b", 6), ("b", "a", 3), ("a", "a", 1)]), top=2)
    shown = [(row.rank, row.left + row.right, row.percent, row.cumulative) for row in rows]
    assert shown == [(1, "ab", 60, 60), (2, "ba", 30, pytest.approx(90))]


def test_the_summary_counts_what_never_occurs_with_and_without_silence() -> None:
    spoken, whole = [("a", "b", 6), ("b", "a", 3)], [("_", "a", 1), ("a", "b", 6), ("b", "a", 3), ("b", "_", 1)]
    assert Summary.of(Frequency.of(spoken), 21).to_json() | {"covering": None} == {
        "total": 9, "phones": 21, "possible": 441, "seen": 2, "never": 439, "covering": None,
    }  # fmt: skip
    assert Summary.of(Frequency.of(whole), 22).possible == 528


def test_figure_two_is_drawn_whole_or_not_at_all(tmp_path) -> None:
    frequency = Frequency.of([(a, b, 1 + k) for k, (a, b) in enumerate(itertools.product("abc", repeat=2))])
    plot(frequency, tmp_path / "figure.svg", title="three phones")
    assert "three phones" in (tmp_path / "figure.svg").read_text()
    with pytest.raises(OutputError, match="figure.xyz"):
        plot(frequency, tmp_path / "figure.xyz")
    assert [path.name for path in tmp_path.iterdir()] == ["figure.svg"]


SENTENCES = st.lists(st.tuples(st.text("xyz", min_size=1, max_size=5), st.lists(PAIRS, max_size=6)), max_size=12)


@given(SENTENCES)
def test_the_chosen_sentences_hold_every_pair_and_none_is_needless(sentences) -> None:
    chosen = select(sentences)
    every = {pair for _, pairs in sentences for pair in pairs}
    assert {pair for choice in chosen for pair in choice.adds} == every
    assert [choice.covered for choice in chosen] == list(np.cumsum([len(choice.adds) for choice in chosen]))
    held = (
        [set(dict(sentences[::-1])[choice.sentence]) for choice in chosen] if len({text for text, _ in sentences}) == len(sentences) else []
    )
    for k in range(len(held)):
        assert set().union(*(held[:k] + held[k + 1 :])) != every


def test_the_greedy_choice_is_near_the_best_one() -> None:
    rng = np.random.default_rng(7)
    for _ in range(20):
        sentences = [(f"s{k}", [(str(p), "x") for p in rng.choice(12, 4, replace=False)]) for k in range(8)]
        every = {pair for _, pairs in sentences for pair in pairs}
        best = next(
            size
            for size in range(1, 9)
            if any({pair for _, pairs in part for pair in pairs} == every for part in itertools.combinations(sentences, size))
        )
        assert len(select(sentences)) <= best + 1


def test_at_most_so_many_sentences_are_chosen_the_fullest_first() -> None:
    sentences = [("long one", [("a", "b"), ("b", "c")]), ("short", [("a", "b"), ("b", "c")]), ("x", [("c", "d")])]
    assert [(c.sentence, c.covered) for c in select(sentences, most=1)] == [("short", 2)]
    assert select(sentences, most=0) == []


def test_two_equal_frequencies_do_not_differ_and_disjoint_ones_differ_wholly() -> None:
    one = Frequency.of([("a", "b", 3), ("b", "a", 2), ("a", "a", 1)])
    same = compare(one, Frequency.of([("a", "b", 30), ("b", "a", 20), ("a", "a", 10)]))
    assert (same.rank, round(same.distance, 12)) == (pytest.approx(1), 0)
    other = compare(one, Frequency.of([("c", "c", 5)]))
    assert other.distance == 1
    assert (other.only_first, other.only_second) == (one.pairs, (("c", "c"),))


def test_a_list_of_the_most_frequent_pairs_is_compared_on_those_alone() -> None:
    one = Frequency.of([("a", "b", 50), ("b", "a", 30), ("a", "a", 15), ("b", "b", 5)])
    printed = Frequency.of([("a", "b", 40.0), ("b", "a", 30.0), ("a", "a", 10.0)], percent=True)
    told = compare(one, printed)
    assert (told.pairs, told.rank, told.only_first) == (3, pytest.approx(1), ())
    assert np.isnan(told.distance)
    assert told.to_json()["total_variation"] is None
    assert told.differences[0].to_row() == {"pair": "a-b", "first": 50, "second": 40, "difference": -10}
