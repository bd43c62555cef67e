"""Many people and programs use one database at once: nothing is lost, nobody is turned away."""

import sqlite3
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing

import pytest
from store_cases import TEXT

from lipdb.errors import ConflictError
from lipdb.store import Store

ROWS = 3
SAVES = 8

# What a person does: read a row, add a word to it, save it; when somebody was faster, look again.
ADD_WORDS = """
import sys
from lipdb.errors import ConflictError
from lipdb.store import Store

def add_words(store, who, saves, rows):
    conflicts = 0
    for i in range(saves):
        key = (f"shared{(who + i) % rows}",)
        while True:
            seen = store.record("sources.tsv", key)
            row = {**seen.row, "comment": seen.row["comment"] + f" {who}.{i}"}
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
print(add_words(store, *map(int, sys.argv[3:])))
"""


def process(code: str, *arguments: object) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def output(running: subprocess.Popen[str]) -> str:
    printed, errors = running.communicate(timeout=60)
    assert (running.returncode, errors) == (0, "")
    return printed


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "a.db"
    with closing(Store.open(file, TEXT)) as store, store.edit(author="anna") as edit:
        for i in range(ROWS):
            edit.put("sources.tsv", {"source": f"shared{i}", "title": "Shared", "licence": "CC0-1.0", "comment": "words:"})
    return file


def test_colliding_threads_and_processes_lose_no_update_and_meet_no_lock(file):
    names: dict[str, object] = {}
    exec(ADD_WORDS, names)
    running = [process(ADD_WORDS + MAIN, file, TEXT, who, SAVES, ROWS) for who in range(3)]
    shared = Store.open(file, TEXT)
    own = Store.open(file, TEXT)
    with ThreadPoolExecutor(5) as pool:
        threads = [pool.submit(names["add_words"], shared if who % 2 else own, who, SAVES, ROWS) for who in range(3, 8)]
        conflicts = sum(thread.result() for thread in threads)
    conflicts += sum(int(output(one)) for one in running)
    assert conflicts > 0, "nobody collided: this test showed nothing"
    words = [word for i in range(ROWS) for word in shared.record("sources.tsv", (f"shared{i}",)).row["comment"].split()[1:]]
    assert sorted(words) == sorted(f"{who}.{i}" for who in range(8) for i in range(SAVES))
    assert [one.number for one in shared.history()] == list(range(2 + 8 * SAVES, 0, -1))
    assert shared.check() == []
    own.close()
    shared.close()


def test_programs_that_make_the_database_at_the_same_time_make_it_once(tmp_path):
    file = tmp_path / "a.db"
    code = (
        "import sys; from lipdb.store import Store; s = Store.open(*sys.argv[1:]); print(s.revision, sum(map(len, s.records().values())))"
    )
    assert {output(one) for one in [process(code, file, TEXT) for _ in range(4)]} == {"1 17\n"}
    assert [path.name for path in tmp_path.iterdir()] == ["a.db"]


def test_programs_that_upgrade_at_the_same_time_upgrade_once(tmp_path):
    file = tmp_path / "a.db"
    file.write_bytes((TEXT.parent / "0001.db").read_bytes())
    code = "import sys; from lipdb.store import Store; s = Store.locate(*sys.argv[1:]); s.upgrade(); print(s.revision)"
    assert {output(one) for one in [process(code, file, TEXT) for _ in range(3)]} == {"5\n"}


def test_a_reader_sees_one_state_while_others_save(file):
    with closing(Store.open(file, TEXT)) as store, ThreadPoolExecutor(1) as pool:

        def both(i: int) -> None:
            with store.edit(author="bob") as edit:
                for k in range(2):
                    edit.put("sources.tsv", {"source": f"shared{k}", "title": "Shared", "licence": "CC0-1.0", "comment": f"{i}"})

        both(0)
        writer = pool.submit(lambda: [both(i) for i in range(1, 20)])
        while not writer.done():
            records, revision = store.snapshot()
            one, two = (records["sources.tsv"][f"shared{k}",]["comment"] for k in range(2))
            assert one == two == str(revision - 3)
        writer.result()


def test_what_two_people_saw_can_be_saved_only_once(file):
    with closing(Store.open(file, TEXT)) as store:
        seen = store.record("sources.tsv", ("shared0",))
        outcomes = []
        for author in ("anna", "bob"):
            try:
                with store.edit(author=author) as edit:
                    edit.put("sources.tsv", {**seen.row, "comment": author}, expected_revision=seen.revision)
                outcomes.append("saved")
            except ConflictError:
                outcomes.append("refused")
        assert outcomes == ["saved", "refused"]
        assert store.record("sources.tsv", ("shared0",)).row["comment"] == "anna"


def test_opening_a_store_does_not_drop_the_locks_of_others_in_the_same_program(file):
    # Closing any handle of a file drops all locks that the process has on it; only SQLite itself may open the file.
    code = "import sqlite3, sys; sqlite3.connect(sys.argv[1], timeout=0.05, isolation_level=None).execute('BEGIN IMMEDIATE')"
    with closing(sqlite3.connect(file, isolation_level=None)) as writer:
        writer.execute("BEGIN IMMEDIATE")
        Store.open(file, TEXT).close()
        other = process(code, file)
        assert "database is locked" in other.communicate(timeout=60)[1]
