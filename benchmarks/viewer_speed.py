"""How many frames a second the player of the page Say draws: `python benchmarks/viewer_speed.py [--seconds N] [--viewer DIST ...]`.

Plays the example over and over in Chromium and prints, for one face, two side by side and three views at once, frames a second, the
processor time of a frame in the browser's processes and of the page's script, and how large the canvases are. Several DIST folders
(`dashboard/viewer/dist` of other versions) are measured in turn. Needs Chromium and what the tests install.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

import psutil  # noqa: E402
from browser import CHROMIUM, FLAGS, serving, settled, tab, until  # noqa: E402
from playwright.sync_api import sync_playwright  # noqa: E402

SIZES = {1280: 1000, 1920: 1080}
WARM = 3
"""Seconds of playing after which the player has found how sharp it may draw."""
RENDERER = """() => {
    const pen = document.createElement("canvas").getContext("webgl2");
    const told = pen?.getExtension("WEBGL_debug_renderer_info");
    return told ? pen.getParameter(told.UNMASKED_RENDERER_WEBGL) : "unknown";
}"""
START = """stage => {
    stage.lipdb.clock.around = true;
    stage.lipdb.clock.play();
    window.drawn ?? stage.addEventListener("lipdb-time", () => { window.drawn += 1; });
    window.drawn = 0;
}"""
READ = """stage => ({
    drawn: window.drawn,
    now: performance.now(),
    canvases: [...stage.querySelectorAll(".face canvas")].map(each => `${each.width} x ${each.height}`),
})"""


def own_viewer(page: Any, folder: Path) -> None:
    """Let *page* have the player of *folder* in place of the built one."""

    def answer(route: Any) -> None:
        kind = "css" if ".css" in route.request.url else "js"
        text = (folder / f"stage.{kind}").read_text(encoding="utf-8")
        route.fulfill(body=text, content_type={"css": "text/css", "js": "text/javascript"}[kind])

    for kind in ("js", "css"):
        page.route(f"**/stage*.{kind}*", answer)


def of_browser() -> float:
    """Seconds of the processor that Chromium's processes of this program have had."""
    total = 0.0
    for process in psutil.Process().children(recursive=True):
        try:
            if "--type=" in " ".join(process.cmdline()):
                total += sum(process.cpu_times()[:2])
        except psutil.Error:
            continue  # it has ended meanwhile
    return total


def measure(page: Any, seconds: float) -> str:
    """Play for *seconds*: frames a second, milliseconds of the processor and of the script a frame, canvases."""
    stage = page.locator(".stage")
    stage.evaluate(START)
    page.wait_for_timeout(1000 * WARM)
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable")

    def script() -> float:
        return float(next(each["value"] for each in session.send("Performance.getMetrics")["metrics"] if each["name"] == "ScriptDuration"))

    busy, running, first = of_browser(), script(), stage.evaluate(READ)
    page.wait_for_timeout(1000 * seconds)
    last, ran, worked = stage.evaluate(READ), script(), of_browser()
    stage.evaluate("stage => stage.lipdb.clock.pause()")
    frames = max(last["drawn"] - first["drawn"], 1)
    rate = 1000 * frames / (last["now"] - first["now"])
    return f"{rate:10.1f}{1000 * (worked - busy) / frames:14.1f}{1000 * (ran - running) / frames:11.1f}   {', '.join(last['canvases'])}"


def choose(page: Any, label: str, option: str, faces: int) -> None:
    """Choose *option* and wait for so many *faces*."""
    page.get_by_label(label, exact=True).click()
    page.get_by_role("option", name=option).first.click()
    settled(page)
    until(page, "stage.lipdb.state.faces.length === argument && stage.lipdb.state.faces.every(face => face.moving > 0)", faces)


def visit(chromium: Any, url: str, viewer: Path | None, width: int, seconds: float) -> None:
    """Print a line for each thing that the page Say can show."""
    with tab(chromium, viewport={"width": width, "height": SIZES[width]}) as page:
        if viewer:
            own_viewer(page, viewer)
        page.goto(url)
        page.locator(".stage canvas").first.wait_for()
        until(page, "stage.lipdb.state.faces.length && stage.lipdb.state.faces.every(face => face.moving > 0)")
        settled(page)
        name = f"{viewer or 'built'!s:<26}{width:5}"
        print(f"{name}  {'Robin':12}{measure(page, seconds)}", flush=True)
        page.get_by_role("button", name="Look from: all").click()
        print(f"{name}  {'three views':12}{measure(page, seconds)}", flush=True)
        page.get_by_role("button", name="Look from: front").click()
        choose(page, "Beside it", "crab", 2)
        print(f"{name}  {'and the crab':12}{measure(page, seconds)}", flush=True)
        choose(page, "Beside it", "nobody", 1)
        choose(page, "Character", "crab", 1)
        print(f"{name}  {'the crab':12}{measure(page, seconds)}", flush=True)


def main() -> None:
    """Measure what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=5, help="of playing that are measured, for each line")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--width", type=int, action="append", choices=SIZES, help="of the window; else each")
    parser.add_argument("--viewer", type=Path, action="append", metavar="DIST", help="a built player; else the one of this checkout")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="lipdb-viewer-") as folder, sync_playwright() as driver, serving(Path(folder)) as app:
        chromium = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        with tab(chromium) as page:
            print(f"{os.cpu_count()} processors; drawn by {page.evaluate(RENDERER)}")
        print(f"{'player':<26}{'width':>5}  {'shown':12}{'frames/s':>10}{'processor ms':>14}{'script ms':>11}   canvases")
        for _ in range(asked.rounds):
            for width in asked.width or SIZES:
                for viewer in asked.viewer or [None]:
                    visit(chromium, app.url, viewer, width, asked.seconds)
        chromium.close()


if __name__ == "__main__":
    main()
