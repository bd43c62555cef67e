"""Leaving with something unsaved, in a real browser: it asks first, and says what a restart of the server took away."""

import shutil
from contextlib import contextmanager

from browser import eventually, fill, free_port, press, serving, settled, tab


def opened(app, page, path: str) -> None:
    page.goto(f"{app.url}/{path}")
    settled(page)


@contextmanager
def listening(page):
    """What the browser asks meanwhile; who is asked stays."""
    heard = []

    def hear(dialog) -> None:
        heard.append((dialog.type, dialog.message))
        dialog.dismiss()

    page.on("dialog", hear)
    yield heard
    page.remove_listener("dialog", hear)


def asked(page) -> bool:
    """Whether the browser asks before the page is loaded anew."""
    loaded = []
    page.once("load", lambda page: loaded.append(page))
    with listening(page) as heard:
        page.evaluate("location.reload()")
        eventually(page, lambda: heard or loaded, "asked, or loaded anew")
    settled(page)
    assert [kind for kind, _ in heard] == ([] if loaded else ["beforeunload"])
    return bool(heard)


def test_nobody_is_asked_who_has_changed_nothing(app, page) -> None:
    opened(app, page, "languages")
    fill(page, "Your name", "anna")
    assert not asked(page)


def test_a_phone_that_is_not_saved_is_asked_about_on_every_page_until_it_is(app, page) -> None:
    opened(app, page, "languages")
    fill(page, "Your name", "anna")
    fill(page, "Example word", "vision")
    page.get_by_text("Not saved yet; it is heard").wait_for()
    settled(page)
    assert asked(page)
    page.get_by_role("link", name="Say").click()
    settled(page)
    fill(page, "Sentence", " ")  # the page stops there
    assert asked(page)
    page.get_by_role("link", name="Languages").click()
    settled(page)
    press(page, "Save", exact=True)
    page.get_by_text("Revision 2:").wait_for()
    assert not asked(page)


def test_a_curve_is_asked_about_until_its_change_is_undone(app, page) -> None:
    opened(app, page, "curves?pair=l-ow&language=en&character=robin&kind=common")
    page.locator(".stage").evaluate_all("all => all.forEach(stage => stage.lipdb?.clock.pause())")
    key = page.locator('.keys .lane[data-pose="W"] .key').nth(1)
    key.focus()
    key.press("ArrowUp")
    page.get_by_text("Not saved yet:").wait_for()
    settled(page)
    assert asked(page)
    press(page, "Discard", exact=True)
    page.get_by_text("Not saved yet:").wait_for(state="hidden")
    settled(page)
    assert not asked(page)


def test_a_table_of_a_character_is_asked_about_until_it_is_discarded(app, page) -> None:
    opened(app, page, "characters")
    table = page.get_by_test_id("stDataFrame").first
    table.locator("canvas").first.focus()
    for column, key in ((1, "Control+Home"), (2, "ArrowRight"), (3, "ArrowRight")):
        page.keyboard.press(key)
        cell = table.get_by_test_id(f"glide-cell-{column}-0")
        eventually(page, lambda cell=cell: cell.get_attribute("aria-selected") == "true", f"column {column} is chosen")
    page.keyboard.press("Enter")
    page.locator("#portal input").fill("0.5")
    page.locator("#portal input").press("Enter")
    discard = page.get_by_role("button", name="Discard")
    eventually(page, discard.is_enabled, "something to discard")
    settled(page)
    assert asked(page)
    discard.click()
    eventually(page, discard.is_disabled, "nothing to discard")
    settled(page)
    assert not asked(page)


def test_a_language_is_asked_about_until_it_is_thrown_away(app, page) -> None:
    opened(app, page, "languages")
    for choice in ("Add a language", "No voice: I type the phones"):
        page.get_by_test_id("stButtonGroup").get_by_text(choice, exact=True).click()
        settled(page)
    for label, text in (("Name", "Palu"), ("Code", "qpa"), ("Its phones, in IPA", "p m a i"), ("A text of the language", "Pama mipi.")):
        fill(page, label, text)
    press(page, "Propose the phones", exact=True)
    page.get_by_text("Right so").wait_for()
    settled(page)
    assert asked(page)
    page.get_by_test_id("stButtonGroup").get_by_text("1 Language", exact=True).click()
    press(page, "Begin another language", exact=True)
    press(page, "Throw it away", exact=True)
    page.get_by_role("button", name="Propose the phones").wait_for()
    settled(page)
    assert not asked(page)


def test_who_had_something_unsaved_is_told_what_a_restart_took_and_keeps_what_the_browser_still_has(chromium, as_shipped, tmp_path) -> None:
    shutil.copy(as_shipped, tmp_path)
    port = free_port()
    with tab(chromium) as page:
        with serving(tmp_path, port=port) as app:
            opened(app, page, "languages")
            fill(page, "Example word", "vision")
            page.get_by_text("Not saved yet; it is heard").wait_for()
            page.get_by_role("link", name="Curves").click()
            settled(page)
            key = page.locator('.keys .lane[data-pose="W"] .key').nth(1)
            key.focus()
            key.press("ArrowUp")
            page.get_by_text("Not saved yet:").wait_for()
            settled(page)
        app.process.wait()
        dialog = page.get_by_role("dialog")
        dialog.get_by_text("start it again as you did before").wait_for()
        assert dialog.get_by_text("lipdb dashboard").is_visible()
        assert dialog.get_by_text("streamlit run").count() == 0
        with serving(tmp_path, port=port):
            told = page.get_by_role("alert").filter(has_text="What was not saved is gone")
            told.wait_for()
            assert "curves of l-ow" in told.inner_text()
            told.get_by_role("button", name="Close").click()
            told.wait_for(state="hidden")
            settled(page)
            fill(page, "Your name", "anna")
            assert told.count() == 0
