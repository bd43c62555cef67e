"""How `lipdb dashboard` begins and ends."""

import os
import pty
import shutil
import signal
import socket
import subprocess
import sys

import pytest
from browser import PATIENCE, free_port, serving, soon


@pytest.fixture
def folder(as_shipped, tmp_path):
    shutil.copy(as_shipped, tmp_path)
    return tmp_path


@pytest.fixture(autouse=True)
def heard():
    """SIGHUP is heard by what is started here, under nohup too: who ignores a signal starts processes that ignore it."""
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    signal.signal(signal.SIGHUP, before)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGKILL, -9)])
def test_however_it_ends_its_server_ends_with_it(folder, number, code) -> None:
    with serving(folder) as dashboard:
        dashboard.process.send_signal(number)
        assert dashboard.process.wait(PATIENCE / 1000) == code
        soon(lambda: not dashboard.answers, "the port is free again")


def test_a_port_that_is_taken_is_said_in_one_line(folder, invoke) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        code, out, err = invoke("--db", folder / "lipdb.db", "dashboard", "--port", port, "--address", "127.0.0.1", "--no-browser")
    assert (code, out) == (4, "")
    assert err == f"lipdb: port {port} of 127.0.0.1 is taken or can't be used; name another one with --port\n"


@pytest.mark.parametrize("port", [0, 70000])
def test_a_port_that_cannot_be_is_said_in_one_line(invoke, port) -> None:
    code, out, err = invoke("dashboard", "--port", port)
    assert (code, out) == (2, "")
    assert err == f"lipdb: Invalid value for '--port': {port} is not in the range 1<=x<=65535; see `lipdb dashboard --help`\n"


def test_its_first_start_at_a_terminal_asks_nothing(folder) -> None:
    screen, terminal = pty.openpty()
    port = free_port()
    command = [sys.executable, "-m", "lipdb", "--db", str(folder / "lipdb.db"), "dashboard", "--port", str(port)]
    environment = {**os.environ, "HOME": str(folder), "BROWSER": "true", "LIPDB_HOME": str(folder), "LIPDB_CACHE": str(folder)}
    with subprocess.Popen(command, env=environment, cwd=folder, stdin=terminal, stdout=terminal, stderr=terminal) as server:
        shown = b""
        while b"URL: " not in shown:
            shown += os.read(screen, 1000)
            assert b"mail" not in shown
        server.terminate()
        assert server.wait(PATIENCE / 1000) == 143
