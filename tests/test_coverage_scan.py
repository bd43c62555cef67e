"""A part is counted once in its life: whatever is stopped, added or done again, nothing is counted twice or lost."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from coverage_cases import LetterCounter, pairs_in, pairs_of, text, write
from hypothesis import given, settings
from hypothesis import strategies as st

from lipdb.coverage import processes
from lipdb.coverage.archive import Archive
from lipdb.coverage.counts import DOCUMENTS, FINDINGS, PAIRS, SAMPLE, Counter, Counts
from lipdb.coverage.executors import Workers
from lipdb.coverage.result import AT_ONCE, _batches
from lipdb.coverage.scan import Counted, count_corpus, seconds
from lipdb.errors import LipdbError

HERE = Path(__file__).parent


def run(*paths: Path, archive: Path, counter: Counter | None = None, workers: int = 2) -> Counted:
    counter = counter or LetterCounter(1000)
    with Workers(workers, threads=counter.threads, seconds=seconds) as crew:
        return count_corpus([str(path) for path in paths], counter, crew, Archive(archive))


def total(counted: Counted, archive: Path) -> dict[tuple[str, str], int]:
    return pairs_of(Counts.sum(Archive(archive).read(place.key) for place in counted.places))


def settled(file: Path) -> Path:
    """*file* as if it had been written long ago."""
    os.utime(file, (1_000_000_000, 1_000_000_000 + file.stat().st_size))
    return file


def test_the_sum_of_the_parts_is_the_whole(tmp_path: Path) -> None:
    file = write(tmp_path, text=text(500)) / "text"
    counted = run(file, archive=tmp_path / "archive")
    assert counted.fresh == len(counted.places) > 5
    assert total(counted, tmp_path / "archive") == pairs_in(text(500))


def test_a_corpus_scanned_already_is_not_even_opened(tmp_path: Path) -> None:
    file = settled(write(tmp_path, text=text(500)) / "text")
    first = run(file, archive=tmp_path / "archive")
    file.chmod(0)  # who is no superuser could not read it now
    again = run(file, archive=tmp_path / "archive", counter=LetterCounter(1000))
    file.chmod(0o644)
    if os.geteuid():
        assert again.places == first.places
    assert (again.fresh, again.content) == (0, first.content)


def test_a_file_that_was_renamed_or_copied_costs_nothing(tmp_path: Path) -> None:
    file = write(tmp_path, text=text(500)) / "text"
    run(file, archive=tmp_path / "archive")
    again = run(file.rename(tmp_path / "other"), archive=tmp_path / "archive")
    assert again.fresh == 0
    assert {place.document for place in again.places} == {str(tmp_path / "other")}


def test_a_file_that_grew_costs_only_what_is_new(tmp_path: Path) -> None:
    file = settled(write(tmp_path, text=text(500)) / "text")
    first = run(file, archive=tmp_path / "archive")
    file.write_text(text(500) + text(50, seed=1))
    again = run(file, archive=tmp_path / "archive")
    assert again.fresh == len(again.places) - len(first.places) + 1
    assert total(again, tmp_path / "archive") == pairs_in(text(500), text(50, seed=1))


def test_a_file_changed_in_the_middle_costs_the_parts_that_changed(tmp_path: Path) -> None:
    file = settled(write(tmp_path, text=text(500)) / "text")
    run(file, archive=tmp_path / "archive")
    changed = text(500).replace("moon", "noom", 5)
    file.write_text(changed)
    again = run(file, archive=tmp_path / "archive")
    assert again.fresh == 1
    assert total(again, tmp_path / "archive") == pairs_in(changed)


def test_another_way_of_counting_shares_nothing_but_the_digest(tmp_path: Path) -> None:
    file = write(tmp_path, text=text(500)) / "text"
    first = run(file, archive=tmp_path / "archive", counter=LetterCounter(1 << 18))
    other = run(file, archive=tmp_path / "archive", counter=LetterCounter(1 << 20, key="other"))
    assert other.fresh == len(other.places)
    assert other.content == first.content


def test_killed_in_the_middle_and_started_again_it_goes_on(tmp_path: Path) -> None:
    file = write(tmp_path, text=text(2000)) / "text"
    code = (
        f"import sys; sys.path[:0] = [{str(HERE)!r}]\n"
        "from coverage_cases import LetterCounter\nfrom test_coverage_scan import run\nfrom pathlib import Path\n"
        f"if __name__ == '__main__': run(Path({str(file)!r}), archive=Path({str(tmp_path / 'archive')!r}),"
        " counter=LetterCounter(1000, threads=False, slow=0.05))"
    )
    script = tmp_path / "scan.py"
    script.write_text(code)
    with subprocess.Popen([sys.executable, str(script)]) as running:
        while len(list(tmp_path.glob("archive/parts/*/*.parquet"))) < 5:
            assert running.poll() is None
            time.sleep(0.02)
        workers = children(running.pid)
        running.send_signal(signal.SIGKILL)
    kept = len(list(tmp_path.glob("archive/parts/*/[!.]*.parquet")))
    again = run(file, archive=tmp_path / "archive")
    assert again.fresh == len(again.places) - kept
    assert total(again, tmp_path / "archive") == pairs_in(text(2000))
    assert gone(workers)


def children(process: int) -> list[int]:
    return [int(pid) for pid in Path(f"/proc/{process}/task/{process}/children").read_text().split()]


def gone(processes: list[int], patience: float = 5.0) -> bool:
    end = time.monotonic() + patience
    while any(works(pid) for pid in processes):
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def works(process: int) -> bool:
    """Whether *process* is there, and no ghost, nor Python's own, which stays as long as its parent."""
    try:
        command = Path(f"/proc/{process}/cmdline").read_bytes()
    except OSError:
        return False
    return bool(command) and b"resource_tracker" not in command


def test_counts_that_a_disk_damaged_are_deleted_so_that_the_next_scan_makes_them_again(tmp_path: Path) -> None:
    file = write(tmp_path, text=text(500)) / "text"
    first = run(file, archive=tmp_path / "archive")
    damaged = next(tmp_path.glob("archive/parts/*/*.parquet"))
    damaged.write_bytes(damaged.read_bytes()[:100])
    with pytest.raises((OSError, ValueError)):
        total(first, tmp_path / "archive")
    again = run(file, archive=tmp_path / "archive")
    assert again.fresh == 1
    assert total(again, tmp_path / "archive") == pairs_in(text(500))


@pytest.mark.parametrize("wrong", ["die", "hang"])
def test_a_line_that_ends_its_process_or_hangs_is_left_out_alone(tmp_path: Path, wrong: str) -> None:
    lines = text(110).splitlines()
    file = write(tmp_path, text="\n".join([*lines[:55], wrong, *lines[55:]])) / "text"
    counter = LetterCounter(1 << 18, threads=False)
    with Workers(1, seconds=lambda task: 1.0) as crew:
        counted = count_corpus([str(file)], counter, crew, Archive(tmp_path / "archive"))
    counts = Counts.sum(Archive(tmp_path / "archive").read(place.key) for place in counted.places)
    assert counts.findings["reason"].to_pylist() == ["voice broke down"]
    assert 50 < counts.documents["lines"].to_pylist()[0] < 110


def test_memory_does_not_grow_with_the_corpus(tmp_path: Path) -> None:
    block = text(40_000)
    with (tmp_path / "small").open("w") as small, (tmp_path / "large").open("w") as large:
        small.writelines([block] * 20)
        large.writelines([block] * 120)
    assert (tmp_path / "large").stat().st_size > 100e6
    assert peak(tmp_path / "large", tmp_path) < peak(tmp_path / "small", tmp_path) + 30e6


def peak(file: Path, folder: Path) -> int:
    """The largest memory in bytes of a process that scans *file*."""
    code = (
        f"import sys, resource; sys.path[:0] = [{str(HERE)!r}]\n"
        "from coverage_cases import ByteCounter\nfrom test_coverage_scan import run\nfrom pathlib import Path\n"
        f"run(Path({str(file)!r}), archive=Path({str(folder / 'archive')!r}) / {file.name!r}, counter=ByteCounter(1 << 22), workers=1)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024)"
    )
    return int(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)


COUNTS = st.builds(
    lambda pairs, findings, documents, sample: Counts.of(
        table(pairs, PAIRS), table(findings, FINDINGS), table(documents, DOCUMENTS), table(sample, SAMPLE)
    ),
    st.lists(st.tuples(*[st.sampled_from("abc")] * 3, st.integers(0, 9))),
    st.lists(st.tuples(*[st.sampled_from("abc")] * 2, st.integers(0, 9), st.sampled_from("xyz"))),
    st.lists(st.tuples(st.sampled_from("abc"), *[st.integers(0, 9)] * 2)),
    st.lists(st.tuples(st.integers(0, 2), *[st.sampled_from("abc")] * 2, *[st.integers(0, 9)] * 2)),
)


def table(rows: list[tuple[object, ...]], schema: pa.Schema) -> pa.Table:
    return pa.table([list(column) for column in zip(*rows, strict=True)] if rows else [[]] * len(schema), schema=schema)


@settings(max_examples=25)
@given(COUNTS, COUNTS, COUNTS)
def test_the_sum_is_associative_and_commutative_and_has_a_zero(a: Counts, b: Counts, c: Counts) -> None:
    assert (a + b) + c == a + (b + c) == Counts.sum([c, b, a])
    assert a + b == b + a
    assert a + Counts.of() == a


@settings(max_examples=25)
@given(COUNTS)
def test_counts_come_back_from_their_file(tmp_path_factory: pytest.TempPathFactory, counts: Counts) -> None:
    file = tmp_path_factory.mktemp("counts") / "counts.parquet"
    counts.write(file)
    assert Counts.read(file) == counts


@settings(max_examples=25)
@given(COUNTS, st.sampled_from("abc"))
def test_counts_fall_into_ranges_of_documents(counts: Counts, edge: str) -> None:
    assert counts.between("", edge) + counts.between(edge, None) == counts


def test_any_other_file_holds_no_counts(tmp_path: Path) -> None:
    pq.write_table(pa.table({"a": [1]}), tmp_path / "other.parquet")
    with pytest.raises(ValueError, match="no counts of a part"):
        Counts.read(tmp_path / "other.parquet")


def test_only_some_counts_are_in_memory_at_once() -> None:
    many = Counts.of(table([("d", str(k), "b", 1) for k in range(1000)], PAIRS))
    sizes = [len(some) for some in _batches(many for _ in range(AT_ONCE // 1000 + 10))]
    assert len(sizes) == 2


def test_workers_that_can_do_nothing_are_told_at_once(monkeypatch) -> None:
    monkeypatch.setattr(processes, "_begin", ends)
    with Workers(1) as crew, pytest.raises(LipdbError, match="end as soon as they begin"):
        crew.alone(len, "task")


def ends(_environment: object) -> None:
    """A worker's beginning that is its end."""
    os._exit(1)
