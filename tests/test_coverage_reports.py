"""Frequencies of pairs: ranking, covering, gaps, choice of sentences, comparison."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.coverage.reports.compare import compare
from lipdb.coverage.reports.frequency import Frequency
from lipdb.coverage.reports.gaps import gaps
from lipdb.coverage.reports.named import named_frequency, read_frequency
from lipdb.coverage.reports.report import Summary, by_curve, plot, ranked
from lipdb.coverage.reports.select import select
from lipdb.coverage.reports.sentences import sentences_of
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


def test_a_table_of_counts_is_read_by_its_columns(tmp_path) -> None:
    file = tmp_path / "counts.csv"
    file.write_text("rank,from,to,count\n1,a,b,6\n2,_,a,3\n3,a,b,1\n")
    assert dict(read_frequency(file).counts) == {("a", "b"): 7, ("_", "a"): 3}
    assert dict(read_frequency(file, silence=False).counts) == {("a", "b"): 7}


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        ("counts.txt", "left,right,count\n", "no table of pairs"),
        ("counts.csv", "left,right\na,b\n", "has the columns left, right"),
        ("counts.csv", "left,right,count\na,b,many\n", "column count holds something that is no number"),
        ("counts.csv", "left,right,count\n", "holds no pair of phones"),
        ("counts.parquet", "left,right,count\n", "can't be read as a table"),
    ],
)
def test_a_file_that_is_no_table_of_counts_says_so_in_one_line(tmp_path, name, content, complaint) -> None:
    file = tmp_path / name
    file.write_text(content)
    with pytest.raises(InputError, match=complaint) as caught:
        read_frequency(file)
    assert "\n" not in str(caught.value)


def test_a_missing_file_says_where_scans_are_listed(tmp_path) -> None:
    with pytest.raises(InputError, match="lipdb coverage list"):
        read_frequency(tmp_path / "nothing.parquet")


def test_published_frequencies_are_named_by_their_table(db) -> None:
    paper = named_frequency(db, "xu2013")
    assert (len(paper), paper.whole, paper.share(("ah", "d"))) == (21, False, pytest.approx(0.0462))


def test_lines_come_once_with_the_pairs_that_the_voice_says(db, tmp_path) -> None:
    file = tmp_path / "lines.txt"
    file.write_text("Bob\nBob\n你好\n")
    lines = sentences_of([str(file)], db.voice("en"), db.phoneset("en"))
    assert lines == [("Bob", {("_", "bmp"), ("bmp", "aa"), ("aa", "bmp"), ("bmp", "_")})]
    assert sentences_of([str(file)], db.voice("en"), db.phoneset("en"), silence=False) == [("Bob", {("bmp", "aa"), ("aa", "bmp")})]
    file.write_text("你好\n")
    with pytest.raises(InputError, match="holds no line that en can say"):
        sentences_of([str(file)], db.voice("en"), db.phoneset("en"))


def test_the_sample_sentences_need_few_to_hold_every_pair(db, tmp_path) -> None:
    file = tmp_path / "sample.txt"
    file.write_text("".join(f"{key[0]}\n" for key in db.records["en/sentences.tsv"]))
    lines = sentences_of([str(file)], db.voice("en"), db.phoneset("en"))
    chosen = select(lines)
    assert chosen[-1].covered == len({pair for _, pairs in lines for pair in pairs}) > 300
    assert len(chosen) < len(lines) / 2


def test_gaps_are_what_nobody_has_drawn_the_most_needed_first(db) -> None:
    counts = {("ah", "d"): 6.0, ("d", "ah"): 3.0, ("l", "ow"): 1.0}
    uses = db.uses(counts, language="en")
    found = gaps(uses, minutes=30)
    assert [(gap.use.pair, gap.percent, gap.hours) for gap in found] == [
        (("ah", "d"), 60, 0.5), (("d", "ah"), pytest.approx(30), 1), (("l", "ow"), pytest.approx(10), 1.5),
    ]  # fmt: skip
    assert found[-1].covered == pytest.approx(100)
    assert {gap.use.origin for gap in found} == {"generated"}
    assert {gap.use.layer for gap in found} == {"common"}


def test_a_pair_that_an_artist_drew_is_no_gap_any_more(own) -> None:
    rows = [row for key, row in own.records["curves/facefx.tsv"].items() if key[:2] == ("ah", "d")]
    with own.edit(author="anna") as edit:
        for row in rows:
            edit.put("curves/facefx.tsv", {**row, "keys": "0:0 0.5:0.3 1:0"})
    counts = {("ah", "d"): 6.0, ("d", "ah"): 2.0}
    assert [gap.use.pair for gap in gaps(own.uses(counts, language="en"))] == [("d", "ah")]
    assert by_curve(own.uses(counts, language="en"))["origin"] == [
        {"origin": "authored", "pairs": 1, "percent": 75.0},
        {"origin": "generated", "pairs": 1, "percent": 25.0},
    ]
