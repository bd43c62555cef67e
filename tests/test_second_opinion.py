"""PanPhon's features as a second opinion: disagreement asks for review, agreement changes nothing, absence neither."""

import csv
from pathlib import Path

import pytest

from lipdb.phones import second_opinion
from lipdb.phones.articulation import classify
from lipdb.phones.proposal import propose
from lipdb.phones.second_opinion import opinions, segments

pytestmark = pytest.mark.skipif(not segments(), reason="PanPhon is not installed")
PHONEMES = Path(__file__).parent.parent / "benchmarks" / "mapping" / "phonemes.tsv"


@pytest.mark.parametrize(
    ("segment", "common"), [("p", "bmp"), ("t͡sʰ", "z"), ("tʃ", "sh"), ("y", "ue"), ("aɪ", "ay"), ("oʊ", "ow"), ("g", "kg")]
)
def test_the_nearest_phoneme_of_the_paper_comes_first(segment, common):
    ranked = opinions(segment)
    assert ranked[0].common == common
    assert len(ranked) == 21
    assert [opinion.distance for opinion in ranked] == sorted(opinion.distance for opinion in ranked)


def test_disagreement_means_review_and_less_confidence():
    found = propose("ʁ")
    assert found.common == classify("ʁ").common
    assert found.review
    assert "review" in found.reason
    assert found.confidence < classify("ʁ").confidence


@pytest.mark.parametrize(("segment", "second"), [("j", "ih"), ("r", "d"), ("x", "h"), ("o", "ao"), ("c", "d"), ("kʲ", "d"), ("ɯ", "w")])
def test_the_next_best_is_what_the_rules_know_or_else_what_panphon_finds(segment, second):
    assert propose(segment).second == (second,)


def test_agreement_changes_nothing_and_names_the_next_best():
    found = propose("tʰ")
    assert not found.review
    assert found.confidence == classify("tʰ").confidence
    assert found.second not in ((), found.common)


def test_what_panphon_does_not_know_has_no_second_opinion():
    assert opinions("ʘ͡§") == () or opinions("ɿ") == ()


def test_without_panphon_the_answers_are_the_same(monkeypatch):
    with_it = propose("ʁ").common
    monkeypatch.setattr(second_opinion, "_table", dict)
    opinions.cache_clear()
    try:
        found = propose("ʁ")
        assert found.common == with_it
        assert found.confidence == classify("ʁ").confidence
        assert found.second == ("h",)
        assert propose("t").second == ()
    finally:
        monkeypatch.undo()
        opinions.cache_clear()


def test_the_rules_keep_their_score_on_the_phonemes_that_were_judged_beforehand():
    with PHONEMES.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))
    for name, least in (("design", 0.995), ("wide", 0.995)):
        judged = [row for row in rows if row["list"] == name]
        right = sum("+".join(classify(row["ipa"]).common) in row["accepted"].split("|") for row in judged)
        assert right / len(judged) >= least
