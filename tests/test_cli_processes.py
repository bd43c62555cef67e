"""lipdb among other programs: pipes, signals, full disks, and two at once."""

import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import pytest

import lipdb

TEXT = "Bob"
LIPDB = (sys.executable, "-c", "from lipdb.cli import main; main()")
FORMATS = {"robin": ("csv", "json", "parquet", "glb", "wav", "tsv", "cues.json"), "flat": ("mp4", "webp", "png")}


@pytest.fixture
def command(db: lipdb.Database, own_places: Path) -> list[str]:
    return [*LIPDB, "--db", str(own_places / "shipped.db")]


def finish(command: Sequence[str], folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, env={**os.environ, **environment}, capture_output=True, text=True, timeout=60, check=False)


def hidden(folder: Path) -> list[str]:
    return [file.name for file in folder.iterdir() if file.name.startswith(".lipdb-")]


@pytest.mark.parametrize("character", FORMATS)
def test_the_same_input_gives_the_same_bytes_in_every_format_with_an_old_and_a_new_cache(
    command: list[str], tmp_path: Path, character: str
) -> None:
    outputs = [option for kind in FORMATS[character] for option in ("-o", f"a.{kind}")]
    for folder in (tmp_path / "first", tmp_path / "second"):
        folder.mkdir()
        done = finish([*command, "say", TEXT, "-c", character, *outputs], folder, LIPDB_CACHE=str(folder / "cache"))
        assert done.returncode == 0, done.stderr
    for kind in FORMATS[character]:
        first, second = ((tmp_path / name / f"a.{kind}").read_bytes() for name in ("first", "second"))
        assert first == second, kind


def test_two_programs_may_make_the_same_database_at_once(tmp_path: Path) -> None:
    command = [*LIPDB, "--db", "new.db", "say", TEXT, "-o"]
    both = [subprocess.Popen([*command, f"{i}.csv"], cwd=tmp_path, stderr=subprocess.PIPE, text=True) for i in range(2)]
    assert [(one.communicate(timeout=60)[1], one.returncode) for one in both] == [("", 0)] * 2
    assert (tmp_path / "0.csv").read_bytes() == (tmp_path / "1.csv").read_bytes()
    assert sorted(file.name for file in tmp_path.iterdir()) == ["0.csv", "1.csv", "new.db"]


def heed_interrupts() -> None:
    """A shell that runs the tests in the background lets its programs ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_stopped_in_the_middle_of_a_video_it_leaves_nothing(command: list[str], tmp_path: Path, number: signal.Signals, code: int) -> None:
    arguments = [*command, "say", f"{TEXT}, " * 200, "-o", "a.mp4"]
    with subprocess.Popen(arguments, cwd=tmp_path, stderr=subprocess.PIPE, text=True, preexec_fn=heed_interrupts) as running:
        begun = time.monotonic()
        while not hidden(tmp_path):
            assert running.poll() is None
            assert time.monotonic() < begun + 30
            time.sleep(0.02)
        running.send_signal(number)
        assert running.wait(30) == code
        assert running.stderr is not None
        assert "Traceback" not in running.stderr.read()
    assert not list(tmp_path.iterdir())


def limit_files() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


@pytest.fixture(scope="module")
def talk(db: lipdb.Database, tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """The arguments that play a line which was spoken before."""
    folder = tmp_path_factory.mktemp("talk")
    take = db.animate(db.say("Hello, Bob and Alice"))
    for kind in ("json", "wav"):
        take.save(folder / f"talk.{kind}")
    return ["sync", str(folder / "talk.json"), "--audio", str(folder / "talk.wav")]


@pytest.mark.parametrize("output", ["a.glb", "a.mp4", "a.wav", "a.parquet", "a.csv", "a.png", "a.webp", "a.json"])
def test_a_disk_that_is_full_leaves_what_was_there(command: list[str], talk: list[str], tmp_path: Path, output: str) -> None:
    (tmp_path / output).write_bytes(b"before")
    done = subprocess.run(
        [*command, *talk, "-c", "robin" if output == "a.glb" else "flat", "-o", output],
        cwd=tmp_path,
        preexec_fn=limit_files,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 9, done.stderr
    assert done.stderr.startswith(f"lipdb: {output}: can't be written")
    assert done.stderr.count("\n") == 1
    assert [file.name for file in tmp_path.iterdir()] == [output]
    assert (tmp_path / output).read_bytes() == b"before"


def test_a_backup_that_does_not_fit_leaves_nothing(command: list[str], tmp_path: Path) -> None:
    done = subprocess.run(
        [*command, "db", "backup", "a.db"],
        cwd=tmp_path,
        preexec_fn=limit_files,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 7
    assert done.stderr.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("args", [["language", "show", "en"], ["language", "show", "en", "--json"], ["db", "history", "--since", "0"]])
def test_a_reader_that_goes_away_early_is_no_error(command: list[str], tmp_path: Path, args: list[str]) -> None:
    with subprocess.Popen([*command, *args], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        assert running.stdout is not None
        assert running.stderr is not None
        running.stdout.read(1)
        running.stdout.close()
        assert running.stderr.read() == b""
        assert running.wait(30) == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="the system has no /dev/full")
def test_standard_output_that_is_full_is_an_error(command: list[str], tmp_path: Path) -> None:
    with Path("/dev/full").open("wb") as full:
        done = subprocess.run([*command, "language", "list"], cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 9
    assert done.stderr.startswith("lipdb: standard output: No space left")
    assert done.stderr.count("\n") == 1


def test_standard_output_may_be_closed(command: list[str], tmp_path: Path) -> None:
    done = subprocess.run(
        ["/bin/sh", "-c", 'exec "$@" >&-', "sh", *command, "language", "list"], cwd=tmp_path, capture_output=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")


def test_help_imports_nothing_heavy() -> None:
    code = "import sys, lipdb.cli; lipdb.cli.cli(['--help'], standalone_mode=False); print(*sys.modules, sep='\\n')"
    loaded = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())
    assert not loaded & {"numpy", "sqlalchemy", "pandas", "pyarrow", "alembic", "rich", "av", "PIL", "pyrender"}
