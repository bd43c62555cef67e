"""What other pages need is made ready while the first one is looked at, so that they come at once (dashboard/parts/ahead.py)."""

from __future__ import annotations

from typing import Any

from browser import Dashboard, eventually, settled, tab

# Counts the drawing contexts that the tab makes.
CONTEXTS = """
    window.contexts = 0;
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...others) {
        window.contexts += kind.startsWith("webgl");
        return getContext.call(this, kind, ...others);
    };
"""


def test_other_pages_find_their_scripts_fetched_and_their_faces_made(app: Dashboard, chromium: Any) -> None:
    with tab(chromium) as page:
        page.add_init_script(CONTEXTS)
        page.goto(app.url)
        page.locator(".stage canvas:not(.loading)").first.wait_for()
        fetched = eventually(page, lambda: page.evaluate("window.lipdbAhead?.length > 8 && window.lipdbAhead"), "scripts are fetched ahead")
        assert {name.partition(".")[0] for name in fetched} >= {"DataFrame", "ArrowVegaLiteChart", "embed"}
        # One to ask who draws, one for the face, and one for the second face of Curves.
        eventually(page, lambda: page.evaluate("window.contexts === 3"), "a second face is made")
        page.evaluate("performance.clearResourceTimings()")
        for name in ("Curves", "Coverage", "Characters", "Say"):
            page.get_by_test_id("stSidebarNav").get_by_role("link", name=name, exact=True).click()
            settled(page)
        page.locator(".stage canvas:not(.loading)").first.wait_for()
        asked = page.evaluate("performance.getEntriesByType('resource').map(each => each.name.split('/').at(-1))")
        assert not [name for name in asked if name in fetched]
        assert page.evaluate("window.contexts") == 3
