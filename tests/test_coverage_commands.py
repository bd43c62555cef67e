"""The commands that say what counts tell, on a small corpus scanned for real."""

import json

import pytest
from click.testing import CliRunner

from lipdb.cli import cli
from lipdb.coverage.corpus import sources
from lipdb.errors import InputError

TEXT = "The cat sat on the mat.\nBob may find five blue whales, or not.\nWho will buy my old boat?\nThe cat sat on the mat.\n"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("coverage")
    (folder / "corpus.txt").write_text(TEXT)

    def run(*arguments: str, code: int = 0):
        result = CliRunner().invoke(cli, ["--db", str(folder / "lipdb.db"), "coverage", *arguments], standalone_mode=False)
        assert (result.exception is None) == (code == 0), result.output
        return result

    run.folder = folder
    run.corpus = str(folder / "corpus.txt")
    run("scan", run.corpus)
    return run


def test_a_report_takes_the_newest_scan_and_adds_up(run) -> None:
    told = json.loads(run("report", "--top", "0", "--json").stdout)
    assert sum(row["count"] for row in told["pairs"]) == told["total"]
    assert told["pairs"][-1]["cumulative"] == pytest.approx(100)
    assert (told["phones"], told["possible"]) == (21, 441)
    assert told["seen"] + told["never"] == 441
    assert told["covering"]["100"] == told["seen"]


def test_a_report_with_silence_counts_the_edges_of_phrases(run) -> None:
    told = json.loads(run("report", "--silence", "--top", "0", "--json").stdout)
    starts = sum(row["count"] for row in told["pairs"] if row["pair"].startswith("_-"))
    assert starts == 5  # four lines, one of them with a pause
    assert told["possible"] == 483


def test_a_report_of_a_scan_by_its_number_draws_figure_two(run) -> None:
    run("report", "1", "--plot", str(run.folder / "figure.svg"))
    assert "99.1 %" in (run.folder / "figure.svg").read_text()


def test_gaps_list_what_to_draw_and_the_hours(run) -> None:
    result = run("gaps", "--top", "3", "--minutes", "6")
    rows = [line.split("\t") for line in result.stdout.splitlines()]
    assert rows[0] == ["pair", "count", "percent", "covered", "hours", "origin", "layer"]
    assert [row[4] for row in rows[1:4]] == ["0.1", "0.2", "0.3"]
    assert "hours at 6 minutes a pair" in result.stderr


def test_a_selection_covers_with_fewer_lines(run) -> None:
    result = run("select", run.corpus)
    assert sorted(result.stdout.splitlines()) == sorted(set(TEXT.splitlines()))
    assert len(run("select", run.corpus, "--sentences", "1").stdout.splitlines()) == 1
    assert "of the corpus'" in result.stderr


def test_a_scan_compared_with_itself_does_not_differ(run) -> None:
    told = json.loads(run("compare", "1", "1", "--json").stdout)
    assert (told["rank_correlation"], told["total_variation"]) == (1, 0)
    paper = json.loads(run("compare", "1", "xu2013", "--json").stdout)
    assert paper["total_variation"] is None
    assert paper["pairs"] > 10


def test_a_report_is_in_the_language_of_its_scan(run) -> None:
    (run.folder / "hallo.txt").write_text("Guten Tag, wie geht es?\n")
    result = str(run.folder / "hallo.parquet")
    run("scan", str(run.folder / "hallo.txt"), "--language", "de", "--output", result)
    told = json.loads(run("report", result, "--json").stdout)
    assert told["language"] == "de"
    assert told == json.loads(run("report", "2", "--language", "de", "--json").stdout) | {"scan": result}


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("report", "999"), "no scan 999; `lipdb coverage list`"),
        (("scan", ""), "'': there is no such file"),
        (("scan", "corpus.txt", "-o", "\udcff.parquet"), "this name is no text"),
        (("report", "-l", "\udcff"), "no language"),
        (("list", "-l", "xx"), "no language 'xx'; there are ar,"),
        (("report", "--top", "-3"), "not in the range"),
        (("gaps", "--minutes", "-1"), "not in the range"),
    ],
)
def test_what_cannot_be_meant_says_what_is_wrong(run, arguments, complaint) -> None:
    assert complaint in str(run(*arguments, code=4).exception)


def test_a_closed_standard_input_is_no_corpus(monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", None)
    with pytest.raises(InputError, match="standard input is closed"):
        list(sources(["-"]))


def test_a_language_without_a_scan_says_what_to_do(run) -> None:
    error = run("report", "--language", "cmn", code=4).exception
    assert "lipdb coverage scan" in str(error)
