"""The same scan on a Dask cluster of several processes, one of them killed in the middle: the same bytes."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from coverage_cases import LetterCounter, text, write
from test_coverage_scan import children, gone

import lipdb
from lipdb.coverage.archive import Archive
from lipdb.coverage.executors import Workers
from lipdb.coverage.result import write_result
from lipdb.coverage.scan import Counted, count_corpus
from lipdb.errors import InputError

distributed = pytest.importorskip("distributed")
COUNTER = LetterCounter(1 << 15, threads=False, slow=0.02)


@pytest.fixture(scope="module")
def corpus(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("corpus"), one=text(20_000), two=text(20_000, seed=1))


def scan(corpus: Path, archive: Path, scheduler: str, while_it_runs: threading.Thread | None = None) -> Counted:
    with Workers(2, scheduler=scheduler) as crew:
        if while_it_runs:
            while_it_runs.start()
        counted = count_corpus([str(corpus)], COUNTER, crew, Archive(archive))
    if while_it_runs:
        while_it_runs.join()
    return counted


def result(db: lipdb.Database, counted: Counted, archive: Path) -> bytes:
    write_result(counted, Archive(archive), db.phoneset("en"), "espeak", archive / "result.parquet", {})
    return (archive / "result.parquet").read_bytes()


@pytest.fixture(scope="module")
def alone(db: lipdb.Database, corpus: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Counted, bytes]]:
    archive = tmp_path_factory.mktemp("alone")
    with Workers(2, threads=True) as crew:
        counted = count_corpus([str(corpus)], COUNTER, crew, Archive(archive))
    yield counted, result(db, counted, archive)


def test_with_a_worker_killed_in_the_middle_it_gives_the_same_bytes_and_leaves_nobody(
    db: lipdb.Database, corpus: Path, alone: tuple[Counted, bytes], tmp_path: Path
) -> None:
    before = set(children(os.getpid()))
    killed: list[int] = []

    def kill() -> None:
        while len(list(tmp_path.glob("parts/*/*.parquet"))) < 4:
            time.sleep(0.01)
        [one, *_] = distributed.default_client().run(os.getpid).values()
        killed.append(one)
        os.kill(one, signal.SIGKILL)

    counted = scan(corpus, tmp_path, "local", threading.Thread(target=kill))
    assert killed
    assert counted.fresh == len(counted.places) == len(alone[0].places) > 20
    assert counted.content == alone[0].content
    assert result(db, counted, tmp_path) == alone[1]
    assert gone([*set(children(os.getpid())) - before])


def test_a_cluster_that_is_there_already_is_used_and_left_there(
    db: lipdb.Database, corpus: Path, alone: tuple[Counted, bytes], tmp_path: Path
) -> None:
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        counted = scan(corpus, tmp_path, cluster.scheduler_address)
        assert result(db, counted, tmp_path) == alone[1]
        again = scan(corpus, tmp_path, cluster.scheduler_address)
    assert (again.fresh, again.content) == (0, counted.content)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nonsense"])
def test_a_scheduler_that_does_not_answer_is_one_line(corpus: Path, tmp_path: Path, address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lipdb.coverage.dask_workers.PATIENCE", 1)
    with pytest.raises(InputError, match=f"{address}: no Dask cluster answers .* give tcp://host:port of its scheduler, or local"):
        scan(corpus, tmp_path, address)
