"""Every test run has a home, a cache and a database of its own."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

import lipdb

pytest_plugins = ["browser", "command_line", "store_cases"]

# How long an example takes depends on the machine, and says nothing about lipdb.
settings.register_profile("lipdb", deadline=None)
settings.load_profile("lipdb")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the dashboard, whose files take longest, so that in the end no processor waits for another one's long file."""
    items.sort(key=lambda item: not item.path.name.startswith("test_dashboard_"))


@pytest.fixture(scope="session", autouse=True)
def own_places(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Keep the tests away from the data, the cache and the settings of the person who runs them."""
    home = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LIPDB_HOME", str(home / "data"))
        patch.setenv("LIPDB_CACHE", str(home / "cache"))
        patch.setenv("LIPDB_AUTHOR", "tester")
        patch.delenv("LIPDB_URL", raising=False)
        patch.delenv("LIPDB_PHONESETS", raising=False)
        yield home


@pytest.fixture(autouse=True)
def own_main() -> Iterator[None]:
    """Give back `__main__`, which a page of the dashboard under test takes: processes that a test starts would run it again."""
    main = sys.modules["__main__"]
    yield
    sys.modules["__main__"] = main


@pytest.fixture(scope="session")
def as_shipped(own_places: Path) -> Path:
    """The file of a database as it ships, which nobody opens: to be copied."""
    file = own_places / "as shipped" / "lipdb.db"
    file.parent.mkdir()
    lipdb.open(file).close()
    return file


@pytest.fixture(scope="session")
def db(own_places: Path, as_shipped: Path) -> Iterator[lipdb.Database]:
    """A database with the shipped data. Tests that edit take `own`."""
    with lipdb.open(shutil.copy(as_shipped, own_places / "shipped.db")) as database:
        yield database


@pytest.fixture
def own(as_shipped: Path, tmp_path: Path) -> Iterator[lipdb.Database]:
    """A database with the shipped data of the test's own, in `own.db` of its folder, to be edited."""
    with lipdb.open(shutil.copy(as_shipped, tmp_path / "own.db")) as database:
        yield database
