"""The public names are few, sorted, and cost nothing until they are used."""

import subprocess
import sys

import lipdb


def test_every_public_name_is_there_and_the_list_is_sorted() -> None:
    assert lipdb.__all__ == sorted(lipdb.__all__)
    for name in lipdb.__all__:
        assert getattr(lipdb, name).__doc__


def test_a_name_that_is_not_there_is_an_attribute_error() -> None:
    assert not hasattr(lipdb, "nothing")


def test_importing_lipdb_imports_nothing_heavy() -> None:
    code = "import lipdb, sys; print([m for m in ('numpy', 'pandas', 'sqlalchemy', 'pyarrow', 'click') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys; sys.argv = ['lipdb', '--help']\n"
        "from lipdb.cli import main\n"
        "try: main()\n"
        "finally: print([m for m in ('numpy', 'pandas', 'sqlalchemy', 'rich', 'pyarrow') if m in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.endswith("[]\n")
