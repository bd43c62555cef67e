"""What a language takes over from others, which pairs only it has, and how much of real text each part carries."""

import json

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner

from lipdb.cli import cli
from lipdb.coverage.reports.frequency import Frequency
from lipdb.errors import InputError
from lipdb.languages.reuse import reuse


def language(*common, **more):
    return {(name.replace(" ", "+"),): {"phone": name.replace(" ", "+"), "common": name} for name in common}


def records(**languages):
    common = {(name,): {"phone": name, "kind_of": ""} for name in ["a", "b", "c", "d"]}
    found = {"common.tsv": common}
    for code, phones in languages.items():
        found |= {f"{code}/language.tsv": {(code,): {"language": code}}, f"{code}/phones.tsv": language(*phones)}
    return found


def part(found, name):
    return next(part for part in found.parts if part.name == name)


@pytest.fixture
def found(db):
    return reuse(db.records, "cmn", ["en"], {})


class TestMandarin:
    """The paper's own case: English pairs for Mandarin."""

    def test_of_484_possible_pairs_441_are_shared_with_english_and_43_are_new(self, found):
        possible = part(found, "possible")
        assert (possible.pairs, dict(possible.shared), len(possible.new)) == (484, {"en": 441}, 43)
        assert (possible.silence_shared, possible.silence_new) == (42, 2)

    def test_the_one_new_phone_is_ue_and_every_new_pair_has_it(self, found):
        assert found.own == ("ue",)
        assert all("ue" in pair for pair in part(found, "possible").new)

    def test_syllables_produce_fewer_within_and_across_their_edges(self, found):
        within, edges, both = (part(found, name) for name in ("within syllables", "across syllable edges", "syllables"))
        assert ("ue", "eh") in within.new  # yue
        assert ("d", "ue") in edges.new  # an yu
        assert ("bmp", "ue") not in within.new  # no *bü
        assert set(both.new) == set(within.new) | set(edges.new)
        assert both.pairs < part(found, "own phones").pairs < 484

    def test_what_mandarin_says_is_what_its_syllables_produce(self, db):
        text = CliRunner().invoke(cli, ["language", "reuse", "cmn", "--corpus", "-", "--json"], input="我们去云南旅行。女儿学语言。")
        assert text.exit_code == 0, text.output
        parts = {part["name"]: part for part in json.loads(text.stdout)["parts"]}
        said = {tuple(pair) for pair in parts["-"]["new_pairs"]}
        assert ("l", "ue") in said
        assert said <= {tuple(pair) for pair in parts["syllables"]["new_pairs"]}
        assert 0 < parts["-"]["share_new"] < 0.5
        assert parts["-"]["share_new"] + parts["-"]["share_shared"] == pytest.approx(1)


def test_a_pair_is_shared_when_one_of_the_languages_has_both_phones():
    found = reuse(records(xx=["a", "b", "c"], aa=["a", "b"], bb=["b", "c"]), "xx", ["aa", "bb"], {})
    possible = part(found, "possible")
    assert dict(possible.shared) == {"aa": 4, "bb": 3}  # b-b comes from the first
    assert possible.new == (("a", "c"), ("c", "a"))
    assert (possible.silence_shared, possible.silence_new) == (6, 0)


def test_possible_are_the_pairs_between_the_phones_of_all_of_them():
    found = reuse(records(xx=["a"], yy=["b", "c"]), "xx", ["yy"], {})
    assert part(found, "possible").pairs == 9
    assert part(found, "own phones").pairs == 1


def test_the_share_of_text_leaves_silence_out():
    text = Frequency.of([("a", "b", 6), ("b", "b", 2), ("_", "a", 100), ("a", "_", 100)])
    found = reuse(records(xx=["a", "b"], yy=["b"]), "xx", ["yy"], {"text": text})
    assert part(found, "text").share_new == 0.75
    assert part(found, "text").silence_new == 2
    assert found.new.pairs[0] in {("_", "a"), ("a", "_")}


def test_every_pair_says_where_it_comes_from_and_where_it_occurs():
    text = Frequency.of([("a", "b", 6), ("b", "b", 2)])
    found = reuse(records(xx=["a", "b"], yy=["b"]), "xx", ["yy"], {"text": text})
    assert [(one.left, one.right, one.over, one.share) for one in found.pairs[:2]] == [("a", "b", "", 0.75), ("b", "b", "yy", 0.25)]
    assert found.pairs[0].parts == ("possible", "own phones", "text")
    assert len(found.pairs) == 8


def test_a_language_without_phones_is_named():
    with pytest.raises(InputError, match="'zz' has no phones"):
        reuse(records(xx=["a"]), "xx", ["zz"], {})


class TestCommand:
    """`lipdb language reuse`."""

    def test_a_scan_is_read_as_it_was_counted(self, tmp_path):
        pairs = {"left": ["ue", "ah", "_"], "right": ["d", "d", "ue"], "count": [1, 3, 7]}
        columns = {"document": ["x"] * 3, "source_left": [""] * 3, "source_right": [""] * 3, **pairs}
        pq.write_table(pa.table(columns), tmp_path / "scan.parquet")
        result = CliRunner().invoke(cli, ["language", "reuse", "cmn", "--corpus", str(tmp_path / "scan.parquet"), "--json"])
        found = json.loads(result.stdout)
        assert found["parts"][-1]["share_new"] == 0.25
        assert found["new_phones"] == ["ue"]

    def test_a_corpus_that_is_not_there_is_an_error(self, tmp_path):
        result = CliRunner().invoke(cli, ["language", "reuse", "cmn", "--corpus", str(tmp_path / "no.txt")])
        assert result.exception.exit_code == 4

    def test_an_unknown_language_is_an_error(self):
        assert CliRunner().invoke(cli, ["language", "reuse", "qqq"]).exception.exit_code == 4
        assert CliRunner().invoke(cli, ["language", "reuse", "cmn", "--from", "qqq"]).exception.exit_code == 4
