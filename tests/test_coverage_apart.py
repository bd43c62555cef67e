"""A scan in a process of its own."""

import io
import json
import shutil
import time

import pytest

import lipdb
from lipdb.coverage.apart import answer, kept, scan_apart
from lipdb.coverage.register import scan
from lipdb.coverage.reports.named import named_frequency
from lipdb.coverage.result import read_result
from lipdb.errors import LipdbError, OutputError
from lipdb.progress import reported


@pytest.fixture(scope="module")
def own(as_shipped, tmp_path_factory):
    with lipdb.open(shutil.copy(as_shipped, tmp_path_factory.mktemp("apart"))) as database:
        yield database


def test_it_registers_the_same_as_a_scan_here_and_tells_how_far_it_is(own, tmp_path) -> None:
    file = tmp_path / "story.txt"
    file.write_text("Bob may find five blue whales.\n你好\n")
    told = []
    with reported(lambda *step: told.append(step)):
        done = scan_apart([str(file)], language="en", title="A story", url=own.store.where)
    assert told[-1] == ("counting", file.stat().st_size, file.stat().st_size)
    (one,) = own.store.scans("en")
    assert (done["id"], done["path"], done["lines"]) == (one.id, one.path, 2)
    assert [(row["reason"], row["count"]) for row in done["findings"]] == [("other script", 1)]
    assert read_result(one.path)["title"] == "A story"
    here = scan(own, [str(file)], language="en", output=tmp_path / "here.parquet", workers=1)
    assert named_frequency(own, one.path).counts == named_frequency(own, here.scan.path).counts
    assert read_result(here.scan.path)["title"] == "story.txt"


def test_what_is_wrong_comes_back_as_an_error(own, tmp_path) -> None:
    with pytest.raises(LipdbError, match="there is no such file or folder"):
        scan_apart([str(tmp_path / "nothing.txt")], language="en", url=own.store.where)


def test_reports_are_few_and_the_last_one_is_not_lost(own, tmp_path, monkeypatch) -> None:
    file = tmp_path / "story.txt"
    file.write_text("Bob may find five blue whales.\n" * 40_000)
    monkeypatch.setattr("lipdb.coverage.apart.STEP", 1e6)
    out = io.StringIO()
    answer({"paths": [str(file)], "language": "en", "mode": "exact", "title": "", "url": own.store.where}, out)
    lines = [json.loads(line) for line in out.getvalue().splitlines()]
    assert [set(line) for line in lines] == [{"what", "done", "total"}, {"scan"}]
    assert lines[0]["done"] == lines[0]["total"] == file.stat().st_size


def test_who_leaves_early_ends_the_process(own, tmp_path) -> None:
    file = tmp_path / "story.txt"
    file.write_text("".join(f"Bob may find {k} blue whales.\n" for k in range(200_000)))

    def leave(*_) -> None:
        raise KeyboardInterrupt

    before, start = len(own.store.scans()), time.monotonic()
    with pytest.raises(KeyboardInterrupt), reported(leave):
        scan_apart([str(file)], language="en", url=own.store.where)
    assert time.monotonic() - start < 60
    assert len(own.store.scans()) == before


def test_an_upload_is_kept_once_under_a_name_of_its_own(tmp_path) -> None:
    first, again, other = (kept(content, tmp_path, suffix=".txt") for content in (b"Bob", b"Bob", b"Mama"))
    assert first == again != other
    assert first.read_bytes() == b"Bob"
    assert sorted(tmp_path.rglob("*.*")) == sorted([first, other])
    (tmp_path / "file").touch()
    with pytest.raises(OutputError, match="make room"):
        kept(b"Bob", tmp_path / "file", suffix=".txt")
