"""Take the screenshots of docs/dashboard.md, of a new database with a few edits in it.

usage: python scripts/screenshots.py [PAGE ...]

Needs Chromium and what the tests install. Writes docs/img/dashboard/PAGE.png.
"""

from __future__ import annotations

import io
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from browser import CHROMIUM, FLAGS, Dashboard, eventually, serving, settled, tab  # noqa: E402
from PIL import Image  # noqa: E402
from playwright.sync_api import sync_playwright  # noqa: E402

import lipdb  # noqa: E402

TO = ROOT / "docs" / "img" / "dashboard"
SIZE = {"width": 1280, "height": 900}
QUIET = 1500
"""Milliseconds that a page is left alone before its picture is taken: charts and faces become sharp."""


def edit(dashboard: Dashboard) -> None:
    """Some work of two people, for the pages that show it."""
    with lipdb.open(str(dashboard.database)) as db:
        book = db.book("facefx", language="en")
        for author, note, pose, keys in [
            ("anna", "Open wider before the rounding", "open", "0:0 0.3:0.55 0.6:0.2 1:0"),
            ("ben", "Round earlier", "W", "0:0 0.35:0.4 0.7:0.85 1:0.3"),
        ]:
            curve = book.find("l", "ow", pose).curve
            with db.edit(author=author, note=note) as changes:
                changes.put("curves/facefx.tsv", {**curve.row(("l", "ow", pose)), "keys": keys, "comment": ""})


def drawn(page: Any) -> None:
    """Wait until the page has been run to its end and all parts of it have come."""
    settled(page)
    eventually(page, lambda: not page.locator("[data-testid=stSkeleton], [data-testid=stAppSkeleton]").count(), "all parts have come")
    page.wait_for_timeout(QUIET)
    settled(page)


def spoken(page: Any, seconds: float) -> None:
    """Wait for the faces, and stand still at an instant."""
    page.locator(".stage").first.wait_for()
    moving = "stages => stages.every(stage => stage.lipdb?.state.faces.length && stage.lipdb.state.faces.every(face => face.moving > 0))"
    eventually(page, lambda: page.locator(".stage").evaluate_all(moving), "the faces move")
    for player in page.locator(".stage").all():
        player.evaluate("(stage, time) => { stage.lipdb.clock.pause(); stage.lipdb.clock.seek(time); }", seconds)


def say(page: Any) -> None:
    """The example, its face with an open mouth."""
    spoken(page, 1.12)


def two(page: Any) -> None:
    """Two characters from three sides, on one clock."""
    page.get_by_label("Beside it", exact=True).click()
    page.get_by_role("option", name="crab").first.click()
    drawn(page)
    page.get_by_role("button", name="Look from: all").click()
    spoken(page, 1.12)


def stages(page: Any) -> None:
    """The stages of the engine for one pose."""
    spoken(page, 1.12)
    page.get_by_role("tab", name="Stages of the engine").click()
    page.get_by_test_id("stVegaLiteChart").first.wait_for()
    _down(page)


def instant(page: Any) -> None:
    """What made the weights at an instant."""
    spoken(page, 1.12)
    lanes = page.locator(".stage .over")
    box = lanes.bounding_box()
    lanes.click(position={"x": box["width"] * 0.42, "y": 60})
    page.get_by_role("link", name="Edit ").first.wait_for()
    _down(page)


def _down(page: Any) -> None:
    page.wait_for_timeout(500)
    page.get_by_test_id("stMain").evaluate("main => main.scrollTo(0, main.scrollHeight)")


def wait(page: Any) -> None:
    """A page as it opens."""


def facing(page: Any) -> None:
    """A page as it opens, once its faces stand."""
    spoken(page, 0.2)


PICTURES: dict[str, tuple[str, Callable[[Any], None]]] = {
    "say": ("", say),
    "say_dark": ("", say),
    "two": ("", two),
    "stages": ("", stages),
    "instant": ("", instant),
    "curves": ("curves?pair=l-ow&language=en&character=robin", facing),
    "characters": ("characters", facing),
    "coverage": ("coverage", wait),
    "languages": ("languages", facing),
    "history": ("history", wait),
}


def take(browser: Any, dashboard: Dashboard, name: str) -> None:
    """One picture, with as few colours as look the same."""
    path, go = PICTURES[name]
    theme = "dark" if name.endswith("_dark") else "light"
    with tab(browser, viewport=SIZE, color_scheme=theme, reduced_motion="reduce") as page:
        page.goto(f"{dashboard.url}/{path}")
        page.get_by_test_id("stMain").wait_for()
        drawn(page)
        go(page)
        drawn(page)
        picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    TO.mkdir(parents=True, exist_ok=True)
    # Maximum coverage keeps the colours of thin lines, which are few pixels; the median cut would give two lanes one colour.
    picture.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=2).save(TO / f"{name}.png", optimize=True)
    print(f"{name}: {(TO / f'{name}.png').stat().st_size // 1000} KB")


def main(names: list[str]) -> None:
    """Take all pictures, or those called *names*."""
    if unknown := set(names) - set(PICTURES):
        sys.exit(f"no picture called {', '.join(sorted(unknown))}; there are {', '.join(PICTURES)}")
    with tempfile.TemporaryDirectory(prefix="lipdb-") as folder, serving(Path(folder)) as dashboard, sync_playwright() as driver:
        edit(dashboard)
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for name in names or PICTURES:
            take(browser, dashboard, name)
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
