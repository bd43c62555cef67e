"""Scans and the store: registered, listed, found again, stale when the mapping changes; and the commands."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from click.testing import CliRunner, Result
from coverage_cases import text, write
from test_cli_processes import heed_interrupts
from test_coverage_scan import gone

import lipdb
from lipdb.cli import cli
from lipdb.coverage.register import MISSING, STALE, Scanned, scan, state_of
from lipdb.coverage.result import read_result
from lipdb.errors import InputError, OutputError
from lipdb.store import Scan

COLUMNS = ["document", "source_left", "source_right", "left", "right", "count"]


@pytest.fixture
def story(tmp_path: Path) -> Path:
    return write(tmp_path / "stories", one__txt="Bob sees the moon, and so do I.\nGo!\n", two__txt="Fish swim.\n")


def count(db: lipdb.Database, *paths: Path, folder: Path, output: Path | None = None) -> Scanned:
    return scan(db, [str(path) for path in paths], language="en", output=output, scheduler="threads", folder=folder)


def test_the_result_is_one_long_sorted_table_that_tells_where_it_comes_from(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    done = count(own, story, folder=tmp_path / "parts")
    table = pq.read_table(done.scan.path)
    assert table.column_names == COLUMNS
    rows = [tuple(row.values()) for row in table.to_pylist()]
    assert rows == sorted(rows)
    assert {row[0] for row in rows} == {f"{story}/one.txt", f"{story}/two.txt"}
    assert sum(row[-1] for row in rows) == done.scan.totals["pairs"]
    told = read_result(Path(done.scan.path))
    assert {"language": "en", "mode": "exact", "corpus": [str(story)], "lines": 3, "documents": 2}.items() <= told.items()
    assert {"content", "counter", "mapping", "revision", "program", "time", "findings"} <= told.keys()
    assert Path(done.scan.path).parent == tmp_path / "scans"


def test_a_scan_done_already_is_found_and_not_done_again(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    first = count(own, story, folder=tmp_path / "parts")
    again = count(own, story, folder=tmp_path / "parts")
    assert (again.repeated, again.fresh, again.scan) == (True, 0, first.scan)
    assert [one.path for one in own.store.scans()] == [first.scan.path]
    elsewhere = count(own, story, folder=tmp_path / "parts", output=tmp_path / "b.parquet")
    assert (elsewhere.repeated, elsewhere.fresh) == (False, 0)
    assert [one.path for one in own.store.scans("en")] == [str(tmp_path / "b.parquet"), first.scan.path]
    assert own.store.scans("de") == []


def test_a_changed_mapping_makes_it_stale_and_costs_no_voice(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    first = count(own, story, folder=tmp_path / "parts")
    row = own.records["en/phones.tsv"]["b",]
    with own.edit(author="anna") as edit:
        edit.put("en/phones.tsv", {**row, "common": "d"})
    assert state_of(own, first.scan) == STALE
    again = count(own, story, folder=tmp_path / "parts")
    assert (again.repeated, again.fresh) == (False, 0)
    left = set(zip(*(pq.read_table(again.scan.path)[name].to_pylist() for name in ("source_left", "left")), strict=True))
    assert ("b", "d") in left
    assert again.scan.revision == own.store.revision
    Path(again.scan.path).unlink()
    assert state_of(own, again.scan) == MISSING


def test_the_same_result_again_takes_the_place_of_the_older_one(own: lipdb.Database) -> None:
    one = Scan("2026-01-01T00:00:00Z", "en", "exact", ("a", "b c"), "1", "2", "3", "/x.parquet", {"pairs": 1})
    first, second = own.store.add_scan(one), own.store.add_scan(one)
    assert own.store.scans() == [second]
    assert (first.revision, second.corpus) == (own.store.revision, ("a", "b c"))


def test_counts_damaged_on_disk_are_made_again(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    first = count(own, story, folder=tmp_path / "parts")
    table = pq.read_table(first.scan.path)
    Path(first.scan.path).unlink()
    for file in tmp_path.glob("parts/parts/*/*.parquet"):
        file.write_bytes(b"PAR1 damaged")
    assert pq.read_table(count(own, story, folder=tmp_path / "parts").scan.path).equals(table)


def test_a_result_that_cant_be_written_leaves_the_old_one(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="does not exist; make it first"):
        count(own, story, folder=tmp_path / "parts", output=tmp_path / "nowhere" / "a.parquet")
    assert own.store.scans() == []


def test_a_mode_that_there_is_not(own: lipdb.Database, story: Path) -> None:
    with pytest.raises(InputError, match="no mode 'rough'"):
        scan(own, [str(story)], language="en", mode="rough")


def run(db: lipdb.Database, *arguments: str) -> Result:
    done = CliRunner().invoke(cli, ["--db", db.store.where, "coverage", *arguments])
    assert done.exit_code == 0, done.output
    return done


def test_scan_prints_the_path_of_the_result_and_reports_beside_it(own: lipdb.Database, story: Path) -> None:
    write(story, three__txt="Привет\n5 € please\n")
    done = run(own, "scan", str(story), "--scheduler", "threads")
    assert Path(done.stdout.strip()).is_file()
    assert "left out: 1 line in 1 document(s): other script" in done.stderr
    assert "read so: 1 line in 1 document(s): numbers" in done.stderr
    again = run(own, "scan", str(story), "--scheduler", "threads")
    assert again.stdout == done.stdout
    assert "scanned already" in again.stderr


def test_scan_tells_a_program_everything(own: lipdb.Database, story: Path, tmp_path: Path) -> None:
    write(story, three__txt="Привет\n")
    told = json.loads(run(own, "scan", str(story), "--scheduler", "threads", "--json", "-o", str(tmp_path / "r.parquet")).stdout)
    assert told["path"] == str(tmp_path / "r.parquet")
    assert (told["lines"], told["spoken"], told["documents"]) == (4, 3, 3)
    assert told["findings_by_document"] == [{"document": f"{story}/three.txt", "reason": "other script", "count": 1, "example": "Привет"}]
    assert told["findings"][0]["left_out"] is True


def test_list_shows_the_newest_first_with_their_state(own: lipdb.Database, story: Path) -> None:
    run(own, "scan", str(story / "one.txt"), "--scheduler", "threads")
    run(own, "scan", str(story / "two.txt"), "--scheduler", "threads")
    rows = json.loads(run(own, "list", "--json").stdout)
    assert [(row["corpus"], row["state"], row["language"]) for row in rows] == [
        ([f"{story}/two.txt"], "current", "en"),
        ([f"{story}/one.txt"], "current", "en"),
    ]
    assert run(own, "list").stdout.splitlines()[0].split("\t")[:5] == ["id", "time", "language", "mode", "state"]


@pytest.mark.parametrize("files", [{"empty": ""}, {"script": "Привет\n"}, {}])
def test_a_corpus_of_which_nothing_can_be_counted_is_reported_and_an_error(
    own: lipdb.Database, tmp_path: Path, files: dict[str, str]
) -> None:
    folder = write(tmp_path / "corpus", **files)
    with pytest.raises(InputError, match="holds nothing that can be counted"):
        CliRunner().invoke(
            cli,
            ["--db", own.store.where, "coverage", "scan", str(folder), "--scheduler", "threads"],
            standalone_mode=False,
            catch_exceptions=False,
        )


def test_stopped_by_a_person_it_leaves_no_process_and_goes_on_next_time(own: lipdb.Database, tmp_path: Path) -> None:
    corpus = write(tmp_path, corpus=text(60_000)) / "corpus"
    command = [sys.executable, "-m", "lipdb", "--db", own.store.where, "coverage", "scan", str(corpus), "--workers", "2"]
    environment = {**os.environ, "LIPDB_CACHE": str(tmp_path / "cache")}
    with subprocess.Popen(
        command, env=environment, stderr=subprocess.PIPE, text=True, start_new_session=True, preexec_fn=heed_interrupts
    ) as running:
        while not list(tmp_path.glob("cache/coverage/parts/*/[!.]*.parquet")):
            assert running.poll() is None
            time.sleep(0.02)
        workers = [int(pid) for pid in Path(f"/proc/{running.pid}/task/{running.pid}/children").read_text().split()]
        os.killpg(running.pid, signal.SIGINT)
        _, errors = running.communicate(timeout=20)
    assert (running.returncode, errors) == (130, "\n")
    assert gone(workers)
    assert not list(tmp_path.glob("**/.lipdb-*"))
