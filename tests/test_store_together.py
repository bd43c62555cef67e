"""Many people and programs use one database at once: nothing is lost, nobody is turned away."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path

import pytest

from lipdb.errors import ConflictError
from lipdb.store import Store

TEXT = Path(__file__).parent / "data" / "databases" / "text"
ROWS = 3
SAVES = 8

# What a person does: read a row, think, save it; when somebody was faster, look again.
COUNT_UP = """
import sys
from lipdb.errors import ConflictError
from lipdb.store import Store

def count_up(store, who, saves, rows):
    conflicts = 0
    for i in range(saves):
        key = (f"counter{(who + i) % rows}",)
        while True:
            seen = store.record("sources.tsv", key)
            row = {**seen.row, "comment": str(int(seen.row["comment"]) + 1)}
            try:
                with store.edit(author=f"worker{who}") as edit:
                    edit.put("sources.tsv", row, expected_revision=seen.revision)
                break
            except ConflictError:
                conflicts += 1
    return conflicts
"""
MAIN = """
store = Store.open(sys.argv[1], sys.argv[2])
print(count_up(store, *map(int, sys.argv[3:])))
"""


def process(code: str, *arguments: object) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def output(running: subprocess.Popen[str]) -> str:
    printed, errors = running.communicate(timeout=60)
    assert (running.returncode, errors) == (0, "")
    return printed


@pytest.fixture
def counters(tmp_path):
    file = tmp_path / "a.db"
    with closing(Store.open(file, TEXT)) as store, store.edit(author="anna") as edit:
        for i in range(ROWS):
            edit.put("sources.tsv", {"source": f"counter{i}", "title": "Counter", "licence": "CC0-1.0", "comment": "0"})
    return file


def total(store: Store) -> int:
    return sum(int(store.record("sources.tsv", (f"counter{i}",)).row["comment"]) for i in range(ROWS))


def test_colliding_threads_and_processes_lose_no_update_and_meet_no_lock(counters):
    names: dict[str, object] = {}
    exec(COUNT_UP, names)
    running = [process(COUNT_UP + MAIN, counters, TEXT, who, SAVES, ROWS) for who in range(3)]
    shared = Store.open(counters, TEXT)
    own = Store.open(counters, TEXT)
    with ThreadPoolExecutor(5) as pool:
        threads = [pool.submit(names["count_up"], shared if who % 2 else own, who, SAVES, ROWS) for who in range(3, 8)]
        conflicts = sum(thread.result() for thread in threads)
    conflicts += sum(int(output(one)) for one in running)
    assert conflicts > 0, "nobody collided: this test showed nothing"
    assert total(shared) == 8 * SAVES
    assert [one.number for one in shared.history()] == list(range(2 + 8 * SAVES, 0, -1))
    assert shared.check() == []
    own.close()
    shared.close()


def test_programs_that_make_the_database_at_the_same_time_make_it_once(tmp_path):
    file = tmp_path / "a.db"
    code = "import sys; from lipdb.store import Store; s = Store.open(*sys.argv[1:]); print(s.revision, len(s.records()))"
    assert {output(one) for one in [process(code, file, TEXT) for _ in range(4)]} == {"1 3\n"}
    assert [path.name for path in tmp_path.iterdir()] == ["a.db"]


def test_programs_that_upgrade_at_the_same_time_upgrade_once(tmp_path):
    file = tmp_path / "a.db"
    file.write_bytes((TEXT.parent / "0001.db").read_bytes())
    code = "import sys; from lipdb.store import Store; s = Store.locate(*sys.argv[1:]); s.upgrade(); print(s.revision)"
    assert {output(one) for one in [process(code, file, TEXT) for _ in range(3)]} == {"5\n"}


def test_a_reader_sees_one_state_while_others_save(counters):
    with closing(Store.open(counters, TEXT)) as store, ThreadPoolExecutor(1) as pool:

        def both(i: int) -> None:
            with store.edit(author="bob") as edit:
                for k in range(2):
                    edit.put("sources.tsv", {"source": f"counter{k}", "title": "Counter", "licence": "CC0-1.0", "comment": str(i)})

        writer = pool.submit(lambda: [both(i) for i in range(1, 20)])
        while not writer.done():
            records, revision = store.snapshot()
            one, two = (records["sources.tsv"][f"counter{k}",]["comment"] for k in range(2))
            assert one == two == str(revision - 2)
        writer.result()


def test_what_two_people_saw_can_be_saved_only_once(counters):
    with closing(Store.open(counters, TEXT)) as store:
        seen = store.record("sources.tsv", ("counter0",))
        outcomes = []
        for author in ("anna", "bob"):
            try:
                with store.edit(author=author) as edit:
                    edit.put("sources.tsv", {**seen.row, "comment": author}, expected_revision=seen.revision)
                outcomes.append("saved")
            except ConflictError:
                outcomes.append("refused")
        assert outcomes == ["saved", "refused"]
        assert store.record("sources.tsv", ("counter0",)).row["comment"] == "anna"
