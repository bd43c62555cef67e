"""What a process that counts has imported when it begins, and what it never imports."""

import subprocess
import sys

from lipdb.coverage.processes import PRELOADED, READERS


def run(code: str) -> str:
    """What *code* prints in a Python of its own."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not done.stderr
    return done.stdout.strip()


def test_the_server_of_processes_has_what_counting_needs_and_no_pandas() -> None:
    code = """
import sys, lipdb.coverage.preload, pyarrow as pa
before = set(sys.modules)
pa.table({"a": [1, 1]}).group_by("a").aggregate([("a", "count")])
print(*{name.partition(".")[0] for name in set(sys.modules) - before}, "pandas" in sys.modules)
"""
    assert run(code) == "False"


def test_pandas_can_be_imported_by_others_all_the_same() -> None:
    code = """
import sys
from lipdb.coverage.plain_arrow import without_pandas
without_pandas()
import pandas
print(pandas.Series([1, 2]).sum())
"""
    assert run(code) == "3"


def test_what_is_imported_for_a_language_says_nothing() -> None:
    for module in [PRELOADED, *READERS.values()]:
        assert run(f"import {module}") == ""
