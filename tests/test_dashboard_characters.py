"""Characters in a real browser: a gain is changed, the face follows, two people save the same link, a broken file is refused."""

from __future__ import annotations

import pytest
from browser import PATIENCE, at_rest, seek, settled

import lipdb


@pytest.fixture(scope="module")
def visitors(app, chromium):
    contexts = [chromium.new_context(viewport={"width": 1280, "height": 1000}) for _ in range(2)]
    pages = []
    for context, name in zip(contexts, ("Anna", "Bob"), strict=True):
        context.set_default_timeout(PATIENCE)
        page = context.new_page()
        page.goto(f"{app.url}/characters?character=robin")
        page.locator(".stage canvas").first.wait_for()
        page.get_by_label("Your name", exact=True).fill(name)
        page.get_by_label("Your name", exact=True).press("Enter")
        settled(page)
        # Two faces that move leave a machine without a graphics card no time for anything else.
        at_rest(page)
        pages.append(page)
    yield pages
    for context in contexts:
        context.close()


def set_gain(page, gain: str) -> None:
    """Choose the gain of the first link, and type."""
    box = page.get_by_test_id("stDataFrame").first.locator(".dvn-scroller").bounding_box()
    field = page.locator("#portal input")
    for _ in range(20):
        # The table is a canvas: its cells are counted out.
        page.mouse.click(box["x"] + 215, box["y"] + 53)
        page.wait_for_timeout(500)
        page.keyboard.press("Enter")
        page.wait_for_timeout(500)
        if field.count():
            break
    field.fill(gain)
    field.press("Enter")
    page.get_by_text("1 row to save.").wait_for()
    settled(page)


def jaw_at(page, time: float) -> float:
    """How far the shape *open* is moved at *time*."""
    seek(page, time)
    return page.locator(".stage").evaluate("stage => stage.lipdb.state.faces[0].shapes.open")


def test_the_face_follows_an_edited_gain_and_nobody_elses_does(visitors) -> None:
    anna, bob = visitors
    assert jaw_at(anna, 1.0) == pytest.approx(1.0, abs=0.01)
    set_gain(anna, "0.5")
    for _ in range(100):
        if jaw_at(anna, 1.0) < 0.6:
            break
        anna.wait_for_timeout(100)
    assert jaw_at(anna, 1.0) == pytest.approx(0.5, abs=0.01)
    assert jaw_at(bob, 1.0) == pytest.approx(1.0, abs=0.01)


def test_the_second_to_save_the_same_link_is_asked(app, visitors) -> None:
    anna, bob = visitors
    set_gain(bob, "0.7")
    anna.get_by_role("button", name="Save", exact=True).click()
    anna.get_by_text("Saved as revision 2.").wait_for()
    bob.get_by_role("button", name="Save", exact=True).click()
    dialog = bob.get_by_role("dialog")
    dialog.get_by_text("Anna changed 1 row that you changed too").wait_for()
    dialog.get_by_role("button", name="Save mine over theirs").click()
    bob.get_by_text("Saved as revision 3.").wait_for()
    with lipdb.open(app.database) as db:
        assert db.records["characters/robin/links.tsv"]["open", "open"]["gain"] == "0.7"
        assert [one.author for one in db.store.history(limit=2)] == ["Bob", "Anna"]


def test_a_broken_mesh_is_refused_in_a_line(app, visitors) -> None:
    anna, _ = visitors
    anna.get_by_text("Add one", exact=True).click()
    anna.get_by_label("Short name", exact=True).fill("bob")
    files = {"name": "../../evil.glb", "mimeType": "model/gltf-binary", "buffer": b"glTF and nonsense"}
    anna.locator("input[type=file]").set_input_files(files)
    anna.get_by_text("evil.glb").first.wait_for()
    anna.get_by_role("button", name="Add", exact=True).click()
    message = anna.get_by_test_id("stAlert")
    message.wait_for()
    assert message.inner_text().strip().splitlines()[-1].startswith("mesh.glb: ")
    assert not list((app.database.parent / "characters").glob("*"))
