"""The page Languages in a real browser: a small invented language, from its phones to a face that speaks it."""

import pytest
from browser import fill, press, seek, serving, settled, stage_state, until
from shared_tables import copy_workspace

import lipdb
from lipdb.curated.folder import read_folder
from lipdb.languages.conformance import check_language


@pytest.fixture(scope="module", autouse=True)
def workspace(tmp_path_factory):
    """A folder of text of its own: the checkout's stays as it is."""
    folder = copy_workspace(tmp_path_factory.mktemp("languages") / "phonesets")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LIPDB_PHONESETS", str(folder))
        yield folder


@pytest.fixture(scope="module")
def app(workspace, tmp_path_factory):
    """A dashboard on a database that is filled from the workspace."""
    with serving(tmp_path_factory.mktemp("dashboard")) as dashboard:
        yield dashboard


@pytest.fixture(scope="module")
def languages(app, page):
    page.goto(f"{app.url}/languages")
    settled(page)
    return page


def choose(page, name: str) -> None:
    page.get_by_test_id("stButtonGroup").get_by_text(name, exact=True).click()
    settled(page)


def alert(page) -> str:
    page.get_by_test_id("stAlert").first.wait_for()
    return " ".join(page.get_by_test_id("stAlert").all_inner_texts())


def test_symbols_that_are_no_ipa_are_named_and_what_was_typed_stays(languages) -> None:
    fill(languages, "Your name", "anna")
    choose(languages, "Add a language")
    choose(languages, "No voice: I type the phones")
    fill(languages, "Name", "Palu")
    fill(languages, "Code", "qpa")
    fill(languages, "Its phones, in IPA", "p m k l a i u ʃ=sh § ɸ=f")
    fill(languages, "A text of the language", "Palu miku! Shapa lafi, mapu. Ki ama kulifa. Fafu shisha.")
    press(languages, "Propose the phones")
    assert "no IPA: '§'" in alert(languages)


def test_the_doubtful_phone_comes_first_and_its_second_choice_is_taken(languages) -> None:
    fill(languages, "Its phones, in IPA", "p m k l a i u ʃ=sh ɸ=f")
    press(languages, "Propose the phones")
    assert "Look at this one" in alert(languages)
    languages.get_by_text("1 to look at").wait_for()
    press(languages, "Take bmp")
    press(languages, "Right so")
    languages.get_by_text("none left that must be looked at, 1 decided by you").wait_for()


def test_the_draft_survives_a_visit_to_another_page(languages) -> None:
    languages.get_by_role("link", name="History").click()
    settled(languages)
    languages.get_by_role("link", name="Languages").click()
    settled(languages)
    languages.get_by_text("none left that must be looked at, 1 decided by you").wait_for()


def test_it_is_checked_and_saved_as_text_and_to_the_database(app, languages, workspace) -> None:
    choose(languages, "4 Check")
    assert "Palu is in order" in alert(languages)
    choose(languages, "5 Save")
    press(languages, "Write the folder")
    languages.get_by_text("Written: ").wait_for()
    assert read_folder(workspace)["qpa/phones.tsv"]["ɸ",]["common"] == "bmp"
    assert check_language("qpa", workspace, base=workspace).errors == ()
    press(languages, "Load into the database")
    languages.get_by_text("Palu speaks.").wait_for()
    assert "qpa" in app.lipdb("language", "list")
    assert "Add the language Palu (qpa)" in app.lipdb("db", "history")


def test_it_speaks_at_once_in_say(app, languages) -> None:
    press(languages, "Open in Say")
    languages.get_by_label("Sentence").wait_for()
    languages.locator(".stage canvas").first.wait_for()
    settled(languages)
    assert languages.get_by_label("Sentence").input_value() == "Palu miku!"
    with lipdb.open(str(app.database)) as db:
        track = db.animate(db.say("Palu miku!", language="qpa")).track
    time, duration = 20 / track.fps, len(track.weights) / track.fps
    until(languages, "Math.abs(stage.lipdb.clock.duration - argument) < 0.1", duration)
    seek(languages, time)
    shown = stage_state(languages)
    assert [shown["poses"][pose] for pose in track.poses] == pytest.approx(track.weights[20].tolist(), abs=1e-5)
    assert track.weights[20].max() > 0.3
