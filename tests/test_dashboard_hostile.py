"""Odd and hostile input in a real browser."""

import re

from browser import eventually, fill, press, settled

HOSTILE = "<script>window.hit = 1</script><img src=x onerror='window.hit = 1'> **bold** [link](javascript:hit=1) =1+1 \u202eabc 🙂"


def test_a_text_that_is_longer_than_its_field_takes_is_told(app, page) -> None:
    page.goto(f"{app.url}/languages")
    settled(page)
    field = page.get_by_label("Example word", exact=True)
    before = field.input_value()

    def paste() -> bool:
        # Again where the page has drawn the field anew and it is no longer the one that is typed into; it takes no more than before.
        field.press("End")
        page.keyboard.insert_text("x" * 100)
        page.wait_for_timeout(300)
        told = field.evaluate("field => field.validationMessage")
        return told == f"{len(before) + 100} letters are more than this field takes."

    eventually(page, paste, "told that it is too long")
    assert field.input_value() == before
    page.keyboard.insert_text("s")
    eventually(page, lambda: not field.evaluate("field => field.validationMessage"), "no longer told")
    assert field.input_value() == f"{before}s"


def test_history_shows_names_and_notes_as_they_were_typed(app, page) -> None:
    page.goto(f"{app.url}/languages")
    settled(page)
    fill(page, "Your name", HOSTILE)
    fill(page, "Example word", "vision")
    fill(page, "Why (for the history)", HOSTILE)
    press(page, "Save", exact=True)
    page.get_by_text(re.compile("^Revision 2: ")).wait_for()
    page.get_by_role("link", name="History").click()
    page.get_by_role("heading", name=re.compile("Revision 2: ")).wait_for()
    settled(page)
    shown = page.get_by_test_id("stMain")
    assert "<script>window.hit" in shown.inner_text()
    assert "**bold**" in shown.inner_text()
    assert shown.get_by_role("link", name="link", exact=True).count() == 0
    assert shown.locator("img[src=x]").count() == 0
    assert page.evaluate("window.hit") is None
