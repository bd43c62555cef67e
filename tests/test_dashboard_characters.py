"""Characters in a real browser: links edited in the table and drawn, kept, saved and undone; two people and one link; a broken file."""

from __future__ import annotations

from pathlib import Path

import pytest
from browser import at_rest, eventually, seek, settled, tab

import lipdb

LINKS = "characters/robin/links.tsv"
COLUMNS = ("Pose", "Shape", "Gain", "Combine", "Curve", "Own")


@pytest.fixture(scope="module")
def visitors(app, chromium):
    with tab(chromium) as anna, tab(chromium) as bob:
        for page, name in ((anna, "Anna"), (bob, "Bob")):
            page.goto(f"{app.url}/characters?character=robin")
            page.locator(".stage canvas").first.wait_for()
            page.get_by_label("Your name", exact=True).fill(name)
            page.get_by_label("Your name", exact=True).press("Enter")
            settled(page)
            # Two faces that move leave a machine without a graphics card no time for anything else.
            at_rest(page)
        yield anna, bob


def cell(page, column: str):
    """A cell of the first link. The table is a canvas, with a table in it for those who can't see it."""
    return page.get_by_test_id("stDataFrame").first.get_by_test_id(f"glide-cell-{COLUMNS.index(column) + 1}-0")


def text(page, column: str) -> str:
    return cell(page, column).text_content()


def set_gain(page, gain: str) -> None:
    """Go to the gain of the first link by the keyboard, and write it."""
    page.get_by_test_id("stDataFrame").first.locator("canvas").first.focus()
    for name in ("Pose", "Shape", "Gain"):
        page.keyboard.press("Control+Home" if name == "Pose" else "ArrowRight")
        eventually(page, lambda name=name: cell(page, name).get_attribute("aria-selected") == "true", f"{name} is chosen")
    page.keyboard.press("Enter")
    field = page.locator("#portal input")
    field.fill(gain)
    field.press("Enter")
    eventually(page, lambda: text(page, "Gain") == gain, f"gain {gain}")
    page.get_by_text("1 row to save.").wait_for()
    settled(page)


def jaw_at(page, time: float) -> float:
    """How far the shape *open* is moved at *time*."""
    seek(page, time)
    return page.locator(".stage").evaluate("stage => stage.lipdb.state.faces[0].shapes.open")


def jaw_comes_to(page, weight: float, time: float = 1.0) -> None:
    eventually(page, lambda: jaw_at(page, time) == pytest.approx(weight, abs=0.01), f"open {weight} at {time} s")


def go(page, name: str) -> None:
    """To another page by the side bar."""
    page.get_by_role("link", name=name, exact=True).click()
    settled(page)


def rows(app) -> dict:
    with lipdb.open(app.database) as db:
        return db.records.get(LINKS, {})


def test_the_face_follows_an_edited_gain_and_nobody_elses_does(visitors) -> None:
    anna, bob = visitors
    jaw_comes_to(anna, 1.0)
    set_gain(anna, "0.5")
    jaw_comes_to(anna, 0.5)
    jaw_comes_to(bob, 1.0)


def test_what_is_not_saved_waits_while_other_sections_characters_and_pages_are_looked_at(visitors) -> None:
    anna, bob = visitors
    anna.get_by_text("Rules", exact=True).click()
    anna.get_by_text("These rules belong to the pose set").wait_for()
    anna.get_by_text("Not saved yet elsewhere: links of robin.").wait_for()
    go(anna, "History")
    anna.get_by_text("Revision 1:").wait_for()
    go(anna, "Characters")
    anna.get_by_text("These rules belong to the pose set").wait_for()
    anna.get_by_text("Links", exact=True).click()
    anna.get_by_text("1 row to save.").wait_for()
    assert text(anna, "Gain") == "0.5"
    jaw_comes_to(anna, 0.5)
    assert text(bob, "Gain") == "1"
    assert bob.get_by_text("1 row to save.").count() == 0


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
    assert rows(app)["open", "open"]["gain"] == "0.7"
    with lipdb.open(app.database) as db:
        assert [one.author for one in db.store.history(limit=2)] == ["Bob", "Anna"]


def test_undo_beside_saved_takes_it_back(app, visitors) -> None:
    _, bob = visitors
    bob.get_by_role("button", name="Undo save").click()
    bob.get_by_text("Revision 4 takes revision 3 back.").wait_for()
    assert rows(app)["open", "open"]["gain"] == "0.5"
    eventually(bob, lambda: text(bob, "Gain") == "0.5", "the gain before")
    jaw_comes_to(bob, 0.5)


def test_the_curve_of_a_link_is_drawn_while_the_face_follows(app, visitors) -> None:
    _, bob = visitors
    plot = bob.locator('.keys .lane[data-pose="open"] .plot')
    keys = plot.locator(".key")
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    bob.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)  # a new key on the straight line
    eventually(bob, lambda: keys.count() == 3, "a key more")
    box = keys.nth(1).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    bob.mouse.move(x, y)
    bob.mouse.down()
    bob.mouse.move(x, y + 27, steps=3)
    bob.mouse.up()
    eventually(bob, lambda: text(bob, "Curve") == "0:0 0.5:0.25 1:1", "the curve in the table")
    jaw_comes_to(bob, 0.5 * 0.25, time=0.5)  # the pose is half way up there
    bob.keyboard.press("Control+z")
    eventually(bob, lambda: text(bob, "Curve") == "0:0 0.5:0.5 1:1", "one step back")
    bob.keyboard.press("Control+y")
    eventually(bob, lambda: text(bob, "Curve") == "0:0 0.5:0.25 1:1", "and forth")
    settled(bob)
    bob.get_by_role("button", name="Save", exact=True).click()
    bob.get_by_text("Saved as revision 5.").wait_for()
    assert rows(app)["open", "open"]["curve"] == "0:0 0.5:0.25 1:1"


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
    assert message.inner_text().strip().splitlines()[-1].startswith("evil.glb: ")
    assert not list(Path(app.database.parent / "characters").glob("*"))


def test_on_a_dark_page_dark_letters_stand_on_what_is_filled_and_light_ones_elsewhere(app, chromium) -> None:
    dark = "rgb(14, 17, 23)"
    with tab(chromium, color_scheme="dark") as page:

        def letters(button: str) -> str:
            return page.get_by_role("button", name=button, exact=True).evaluate("button => getComputedStyle(button).color")

        page.goto(f"{app.url}/characters?character=crab")
        page.get_by_role("button", name="Save", exact=True).wait_for()
        settled(page)
        at_rest(page)
        assert letters("Save") != dark  # nothing is to be saved, so it is not filled
        page.get_by_test_id("stButtonGroup").get_by_text("Overrides").click()
        page.get_by_role("button", name="Reset all").click()
        filled = page.get_by_role("button", name="Reset all of them")
        filled.wait_for()
        assert letters("Reset all of them") == dark
        filled.hover()
        lighter = "button => getComputedStyle(button).backgroundColor.match(/\\d+/g).every((part, k) => +part > [60, 153, 213][k])"
        eventually(page, lambda: filled.evaluate(lighter), "the button is not lighter under the mouse")
