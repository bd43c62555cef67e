"""Exact counting: every line as the voice says it, and labels that become phones only at the end."""

from __future__ import annotations

from collections import Counter as Tally
from itertools import pairwise
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from coverage_cases import pairs_of, write

import lipdb
from lipdb.coverage.archive import Archive
from lipdb.coverage.counts import PAIRS, Counts, Lines
from lipdb.coverage.exact import ExactCounter
from lipdb.coverage.executors import Workers
from lipdb.coverage.resolve import Resolved, mapping_digest, resolve
from lipdb.coverage.scan import count_corpus
from lipdb.schedule import SILENCE

SENTENCES = (
    "Well, I think so; he, that is Bob, came late. But why?",
    "It's $3.50, 50% off; 24/7!",
    "Mr. Smith bathed the whole earth in moonlight.",
    "naïve café “hi” — no",
)


def lines(*texts: str, names: tuple[str, ...] = ("",), document: list[int] | None = None) -> Lines:
    return Lines(pa.array(texts, pa.string()), np.array(document or [0] * len(texts), np.int32), names)


@pytest.fixture(scope="module")
def counter(db: lipdb.Database) -> ExactCounter:
    return ExactCounter(db.voice("en").raw())


def common(resolved: Resolved) -> dict[tuple[str, str], int]:
    return {(row["left"], row["right"]): row["count"] for row in resolved.pairs.group_by(["left", "right"]).aggregate([("count", "sum")])
            .rename_columns(["left", "right", "count"]).to_pylist()}  # fmt: skip


def test_pairs_are_those_of_the_phrases_with_silence_at_their_edges(counter: ExactCounter) -> None:
    expected: Tally[tuple[str, str]] = Tally()
    for text in SENTENCES:
        for phrase in counter.voice.phrases(text):
            expected.update(pairwise([SILENCE, *(label for word in phrase for label in word), SILENCE]))
    assert pairs_of(counter.count(lines(*SENTENCES))) == expected


def test_common_pairs_are_those_that_the_engine_would_play(db: lipdb.Database, counter: ExactCounter) -> None:
    for text in SENTENCES:
        counted = common(resolve(counter.count(lines(text)).pairs, db.phoneset("en"), "espeak"))
        _, phones = db.say(text, language="en").schedule.common()
        played = Tally(pair for pair in pairwise((SILENCE, *phones, SILENCE)) if pair != (SILENCE, SILENCE))
        assert counted == played


def test_lines_that_are_alike_are_counted_as_often_as_they_come(counter: ExactCounter) -> None:
    once, thrice = counter.count(lines("Hello, Bob.")), counter.count(lines("Hello, Bob.", "go", "Hello, Bob.", "Hello, Bob."))
    assert pairs_of(thrice) == pairs_of(Counts.sum([once, once, once, counter.count(lines("go"))]))
    assert thrice.documents.to_pylist() == [{"document": "", "lines": 4, "spoken": 4}]


def test_each_document_has_its_own_pairs(counter: ExactCounter) -> None:
    both = counter.count(lines("Bob", "go", "Bob", names=("x", "y"), document=[0, 0, 1]))
    assert both == counter.count(lines("Bob", "go")).named("x") + counter.count(lines("Bob")).named("y")


def test_nothing_is_counted_of_no_lines(counter: ExactCounter) -> None:
    assert len(counter.count(lines()).pairs) == 0


def test_the_key_tells_voices_apart_but_not_mappings(db: lipdb.Database, counter: ExactCounter) -> None:
    assert counter.key != ExactCounter(db.voice("es").raw()).key
    assert "espeak-ng" in counter.key


def test_a_phone_of_two_common_phones_adds_the_pair_within_it(db: lipdb.Database) -> None:
    pairs = pa.table([["d"] * 2, ["_", "pf"], ["pf", "_"], [2, 2]], schema=PAIRS)
    rows = resolve(pairs, db.phoneset("de"), db.language("de")["notation"]).pairs.to_pylist()
    [within] = [row for row in rows if SILENCE not in (row["left"], row["right"])]
    assert within == {"document": "d", "source_left": "pf", "source_right": "pf", "left": "bmp", "right": "f", "count": 2}
    assert len(rows) == 3


def test_a_label_of_which_nothing_is_known_is_told_in_the_words_of_a_scan(db: lipdb.Database) -> None:
    pairs = pa.table([["d"] * 2, ["_", "@@@@"], ["@@@@", "_"], [1, 1]], schema=PAIRS)
    [finding] = resolve(pairs, db.phoneset("en"), "espeak").findings.to_pylist()
    assert finding["example"] == "@@@@: nothing is known of it; the neutral vowel ah takes its place"


def test_an_unknown_label_is_mapped_by_articulation_and_reported(db: lipdb.Database) -> None:
    pairs = pa.table([["d"] * 2, ["_", "qq7"], ["qq7", "_"], [3, 3]], schema=PAIRS)
    [finding] = resolve(pairs, db.phoneset("en"), "espeak").findings.to_pylist()
    assert (finding["document"], finding["reason"], finding["count"]) == ("d", "unknown label", 3)
    assert "qq7" in finding["example"]


def test_marks_of_silence_in_alignments_are_silence_and_neighbours_are_one(db: lipdb.Database) -> None:
    pairs = pa.table([["d"] * 4, ["_", "sil", "B", "sp"], ["sil", "B", "sp", "_"], [1] * 4], schema=PAIRS)
    assert common(resolve(pairs, db.phoneset("en"), "")) == {("_", "bmp"): 1, ("bmp", "_"): 1}


def test_alignments_are_counted_in_whatever_notation_they_are_written(db: lipdb.Database, counter: ExactCounter, tmp_path: Path) -> None:
    from test_coverage_corpus import TEXTGRID

    write(tmp_path, arpa__TextGrid=TEXTGRID.replace('"b"', '"B"').replace('"aa"', '"AA1"'), ipa__TextGrid=TEXTGRID.replace('"aa"', '"ɑ"'))
    with Workers(1, threads=True) as crew:
        counted = count_corpus([str(tmp_path)], counter, crew, Archive(tmp_path / "archive"))
    assert {Path(place.document).name for place in counted.places} == {"arpa.TextGrid", "ipa.TextGrid"}
    for place in counted.places:
        counts = Archive(tmp_path / "archive").read(place.key)
        assert common(resolve(counts.pairs, db.phoneset("en"), "")) == {("_", "bmp"): 1, ("bmp", "aa"): 1, ("aa", "_"): 1}


def test_the_digest_of_the_mapping_changes_with_what_decides_and_with_nothing_else(db: lipdb.Database) -> None:
    records = {path: {key: dict(row) for key, row in rows.items()} for path, rows in db.records.items()}
    before = mapping_digest(records, "en")
    records["en/phones.tsv"]["b",]["comment"] = "softer"
    records["de/phones.tsv"] = {}
    assert mapping_digest(records, "en") == before
    records["en/phones.tsv"]["b",]["common"] = "d"
    assert mapping_digest(records, "en") != before


@pytest.mark.parametrize(
    ("text", "reasons"),
    [
        ("Hello world", []),
        ("Hello 😀", ["emoji"]),
        ("a\x07b", ["control characters"]),
        ("x" * 70, ["long words"]),
        ("It is 5 o'clock", ["numbers"]),
        ("5 % off", ["numbers", "symbols"]),
        ("Привет", ["other script"]),
        ("Hello Привет", ["other script"]),
        ("你好", ["other script"]),
        ("...", ["no words"]),
        ("😀", ["no words"]),
    ],
)
def test_what_is_left_out_or_read_otherwise_is_told(counter: ExactCounter, text: str, reasons: list[str]) -> None:
    assert sorted(counter.count(lines(text)).findings["reason"].to_pylist()) == reasons


def test_words_read_by_the_rules_of_another_language_are_told(db: lipdb.Database) -> None:
    german = ExactCounter(db.voice("de").raw())
    assert german.count(lines("Das Team ist da.")).findings["reason"].to_pylist() == ["foreign words"]
    mandarin = ExactCounter(db.voice("cmn").raw())
    assert mandarin.count(lines("我用iPhone")).findings["reason"].to_pylist() == ["foreign words"]


def test_a_line_that_the_voice_cant_read_is_left_out_alone(db: lipdb.Database) -> None:
    mandarin = ExactCounter(db.voice("cmn").raw())
    counts = mandarin.count(lines("你好", "hello there", "中国"))
    assert counts.findings["reason"].to_pylist() == ["not said"]
    assert counts.documents.to_pylist() == [{"document": "", "lines": 3, "spoken": 2}]
