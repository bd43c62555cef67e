"""The page Coverage in a real browser: from the matrix and the list into Curves and back; a corpus and a script uploaded."""

import json
import re

import pytest
from browser import click_until, eventually, settled, tab

import lipdb

STORY = "Bob may find five blue whales.\n你好\n" * 50


@pytest.fixture
def coverage(app, page):
    """The page, loaded anew by somebody with a name."""
    page.goto(f"{app.url}/coverage")
    page.get_by_text("Colour shows").wait_for()
    field = page.get_by_role("textbox", name="Your name")
    field.fill("anna")
    field.press("Enter")
    settled(page)
    return page


def view(page, name: str) -> None:
    page.get_by_test_id("stButtonGroup").first.get_by_text(name, exact=True).click()
    settled(page)


def back(page, *, by_browser: bool = False) -> None:
    """To this page by the side bar, or by the browser's own button."""
    if by_browser:
        page.go_back()
    else:
        page.get_by_role("link", name="Coverage").click()
    page.get_by_role("combobox", name="Languages").wait_for()
    settled(page)


def click_until_opened(page, target, *, x: float, y: float) -> str:
    """Click a drawing until Curves opens, and tell which pair."""
    return click_until(page, target, lambda: re.search("/curves.*pair=([^&]*)", page.url), x=x, y=y)[1]


def opened(page, pair: str) -> None:
    """Wait until Curves shows *pair*."""
    left, right = pair.split("-")
    for label, phone in (("From", left), ("To", right)):
        page.get_by_role("combobox", name=label, exact=True).and_(page.locator(f'[value="{phone}"]')).wait_for()
    settled(page)


@pytest.mark.parametrize("by_browser", [False, True])
def test_a_click_into_the_matrix_opens_the_pair_and_the_page_comes_back_as_it_was(coverage, by_browser) -> None:
    coverage.get_by_test_id("stButtonGroup").nth(1).get_by_text("Origin", exact=True).click()
    coverage.get_by_text("are faint").wait_for()
    drawn = coverage.get_by_test_id("stVegaLiteChart").locator("canvas, svg").first
    pairs = []
    for y in (0.5, 0.7):
        pairs.append(click_until_opened(coverage, drawn, x=0.6, y=y))
        assert re.fullmatch("[a-z_]+-[a-z_]+", pairs[-1])
        opened(coverage, pairs[-1])
        back(coverage, by_browser=by_browser)
        coverage.get_by_text("are faint").wait_for()
    assert pairs[0] != pairs[1]


@pytest.mark.parametrize("by_browser", [False, True])
def test_a_click_into_the_list_opens_what_is_needed_most_and_the_list_comes_back(coverage, by_browser) -> None:
    view(coverage, "To do")
    coverage.get_by_text("After the next 10").wait_for()
    grid = coverage.get_by_test_id("stDataFrame").first.locator("canvas").first
    pairs = []
    for row in range(2):
        pairs.append(click_until_opened(coverage, grid, x=40, y=52 + 35 * row))
        opened(coverage, pairs[-1])
        back(coverage, by_browser=by_browser)
        coverage.get_by_text("After the next 10").wait_for()
    assert pairs[0] == "ah-d"
    assert pairs[1] != "ah-d"


def test_a_click_right_after_a_second_language_is_not_lost(coverage) -> None:
    languages = coverage.get_by_role("combobox", name="Languages")
    languages.click()
    languages.press_sequentially("Mandarin")
    coverage.get_by_role("option", name="Mandarin").click()
    coverage.keyboard.press("Escape")
    settled(coverage)
    view(coverage, "To do")
    coverage.get_by_text("Pairs to draw").wait_for()


def test_an_uploaded_corpus_is_counted_registered_and_stays_chosen_when_others_change_the_mapping(app, coverage) -> None:
    view(coverage, "Corpora")
    file = {"name": "../My story.txt", "mimeType": "text/plain", "buffer": STORY.encode()}
    coverage.locator("input[type=file]").set_input_files(file)
    coverage.get_by_text("My story.txt").wait_for()
    coverage.get_by_role("button", name="Count", exact=True).click()
    coverage.get_by_text("pairs in 50 of 100 lines").wait_for()
    (scan,) = json.loads(app.lipdb("coverage", "list", "--json"))
    assert (scan["language"], scan["lines"], scan["spoken"], scan["state"]) == ("en", 100, 50, "current")
    assert re.fullmatch(r"[0-9a-f]{32}\.txt", scan["corpus"][0].split("/")[-1])
    assert "story" not in scan["path"]
    chosen = coverage.get_by_test_id("stMultiSelect").nth(1).get_by_text(re.compile(r"^en: .*My story\.txt \(exact, .* pairs\)$"))
    chosen.wait_for()
    view(coverage, "Pairs")
    coverage.get_by_text(re.compile(r"^\d\d of 483$")).wait_for()
    stale = coverage.get_by_text("My story.txt: counted with a mapping that has changed since")
    for common, shown, told in (("ah", "Frequency", 1), ("aa", "Pairs", 0)):
        with lipdb.open(str(app.database)) as db, db.edit(author="bob") as edit:
            edit.put("en/phones.tsv", {**db.records["en/phones.tsv"]["A",], "common": common})
        view(coverage, shown)
        eventually(coverage, lambda told=told: stale.count() == told, "a warning while the mapping is another")
        chosen.wait_for()


@pytest.fixture
def other(chromium):
    with tab(chromium) as page:
        yield page


def test_a_script_stays_with_its_visitor(app, coverage, other) -> None:
    view(coverage, "Your script")
    coverage.locator("input[type=file]").set_input_files({"name": "scene.txt", "mimeType": "text/plain", "buffer": b"Bob!\n\nMama"})
    coverage.get_by_text("This scene: 6 pairs, 0 authored or fitted").wait_for()
    coverage.locator("input[type=file]").set_input_files({"name": "scene.txt", "mimeType": "text/plain", "buffer": b"\0\1\2"})
    coverage.get_by_text("save it as plain text in UTF-8").wait_for()
    other.goto(f"{app.url}/coverage")
    other.get_by_text("Colour shows").wait_for()
    view(other, "Your script")
    other.get_by_text("Paste a scene, or upload it").wait_for()
    assert other.get_by_label("Script", exact=True).input_value() == ""
