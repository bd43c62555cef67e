"""A package of anybody's can add voices, readers and exporters, and take over lipdb's own."""

import importlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

import lipdb
from lipdb import plugins
from lipdb.errors import InputError, MissingToolError

STUDIO = """
from lipdb import Schedule
from lipdb.plugins import hookimpl
from lipdb.schedule import Phone


def write(performance, path):
    path.write_text(f"{len(performance.track.weights)} frames")


def read(path, *, tier=None):
    rows = [line.split() for line in path.read_text().splitlines()]
    return Schedule.from_intervals((float(start), float(end), Phone(symbol)) for start, end, symbol in rows)


@hookimpl
def lipdb_exporters():
    return {".lip": write, ".csv": write}


@hookimpl
def lipdb_readers():
    return {".lab": read}
"""


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str, str], None]]:
    """Install a package with one plug-in: its name and its code."""
    plugins._manager.cache_clear()
    monkeypatch.syspath_prepend(tmp_path)

    def install(name: str, code: str) -> None:
        (tmp_path / f"{name}_lipdb.py").write_text(code)
        info = tmp_path / f"{name}_lipdb-1.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}-lipdb\nVersion: 1\n")
        (info / "entry_points.txt").write_text(f"[lipdb]\n{name} = {name}_lipdb\n")
        monkeypatch.delitem(sys.modules, f"{name}_lipdb", raising=False)
        importlib.invalidate_caches()

    yield install
    plugins._manager.cache_clear()


@pytest.mark.parametrize("name", ["a_studio", "z_studio"])
def test_a_package_adds_formats_and_takes_over_lipdbs_own(install, db: lipdb.Database, tmp_path: Path, name: str) -> None:
    install(name, STUDIO)
    (tmp_path / "talk.lab").write_text("0 0.3 h\n0.3 0.5 aI\n")
    line = db.sync(tmp_path / "talk.lab")
    assert [phone.common for phone in line.schedule.phones] == [("h",), ("ay",)]
    take = db.animate(line, fps=10)
    for file in ("a.lip", "a.csv"):
        take.save(tmp_path / file)
        assert (tmp_path / file).read_text() == f"{len(take.track.weights)} frames"


def test_what_there_is_besides_is_named_for_another_suffix(install, db: lipdb.Database, tmp_path: Path) -> None:
    install("studio", STUDIO)
    with pytest.raises(InputError, match=r"no reader for this kind of file; there are \.json \.lab \.textgrid"):
        db.sync(tmp_path / "talk.xyz")


@pytest.mark.parametrize(
    "code", ["import no_such_module", "1 / 0", "from lipdb.plugins import hookimpl\n@hookimpl\ndef lipdb_voices(x): ..."]
)
def test_a_plug_in_that_fails_is_named_in_a_line(install, code: str) -> None:
    install("studio", code)
    with pytest.raises(MissingToolError, match="plug-in 'studio' of studio-lipdb can't be loaded") as caught:
        plugins.exporters()
    assert "\n" not in str(caught.value)
