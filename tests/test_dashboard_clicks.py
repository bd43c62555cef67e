"""Hasty hands in a real browser: double clicks, the browser's way back and forward, and a page that is loaded anew."""

from browser import at_rest, settled
from glb_cases import Builder

import lipdb

FACEFX = ("open", "W", "PBM", "FV", "wide", "tRoof")


def opened(app, page, path: str) -> None:
    page.goto(f"{app.url}/{path}")
    field = page.get_by_role("textbox", name="Your name")
    field.fill("anna")
    field.press("Enter")
    settled(page)


def click_twice(page, target, *, after: int) -> None:
    """A double click whose second half comes *after* so many milliseconds, wherever the first has led."""
    target.scroll_into_view_if_needed()
    box = target.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.click(x, y)
    page.wait_for_timeout(after)
    page.mouse.down(click_count=2)
    page.mouse.up(click_count=2)
    settled(page)


def notes(app) -> list[str]:
    """What was done, the newest first."""
    with lipdb.open(str(app.database)) as db:
        return [revision.note for revision in db.store.history()]


def test_a_double_click_adds_a_character_once(app, page) -> None:
    opened(app, page, "characters")
    at_rest(page)
    page.get_by_test_id("stButtonGroup").get_by_text("Add one").click()
    page.get_by_role("textbox", name="Short name").fill("bob")
    face = {"name": "bob.glb", "mimeType": "model/gltf-binary", "buffer": Builder(FACEFX).glb()}
    page.locator("input[type=file]").set_input_files(face)
    settled(page)
    click_twice(page, page.get_by_role("button", name="Add", exact=True), after=20)
    page.get_by_text("bob is here").wait_for()
    assert notes(app).count("Add the character bob") == 1


def test_a_double_click_saves_once_and_takes_back_once(app, page) -> None:
    opened(app, page, "languages")
    at_rest(page)
    page.get_by_role("textbox", name="Example word").fill("vision")
    page.get_by_role("textbox", name="Example word").press("Tab")
    settled(page)
    before = len(notes(app))
    click_twice(page, page.get_by_role("button", name="Save", exact=True), after=20)
    page.get_by_text(f"Revision {before + 1}: ").wait_for()
    assert len(notes(app)) == before + 1
    opened(app, page, "history")
    click_twice(page, page.get_by_role("button", name="Undo", exact=True), after=300)
    page.get_by_role("heading", name=f"Revision {before + 2}: Undo revision {before + 1}").wait_for()
    assert len(notes(app)) == before + 2


def test_the_browser_leads_back_and_forward_through_the_pages(app, page) -> None:
    opened(app, page, "history")
    page.get_by_role("textbox", name="Words in the note").fill("bob")
    page.get_by_role("textbox", name="Words in the note").press("Enter")
    settled(page)
    page.get_by_role("link", name="Coverage").click()
    page.get_by_text("Pairs that occur").wait_for()
    page.go_back()
    page.get_by_role("heading", name="Add the character bob").wait_for()
    page.go_forward()
    page.get_by_text("Pairs that occur").wait_for()
    assert page.get_by_role("textbox", name="Your name").input_value() == "anna"
