"""The page Languages without a browser: a language is added step by step, edited, compared with another version and merged."""

from __future__ import annotations

import shutil
from typing import Any

import pytest
from page_cases import DASHBOARD, behind_pages
from shared_tables import copy_workspace
from streamlit.testing.v1 import AppTest

import lipdb
from lipdb.curated.folder import read_folder

ADD, COMPARE = "Add a language", "Compare and merge"
PHONES = "p m k l a i u ʃ=sh ɸ=f"
TEXT = "Palu miku! Shapa lafi, mapu. Ki ama kulifa. Fafu shisha."


@pytest.fixture(scope="module")
def template(tmp_path_factory):
    """A workspace and the database that was filled from it, to be copied."""
    folder = tmp_path_factory.mktemp("template")
    workspace = copy_workspace(folder / "phonesets")
    lipdb.open(str(folder / "lipdb.db"), phonesets=workspace).close()
    return folder


@pytest.fixture
def workspace(template, tmp_path, monkeypatch):
    """A workspace folder of its own."""
    folder = shutil.copytree(template / "phonesets", tmp_path / "phonesets")
    monkeypatch.setenv("LIPDB_PHONESETS", str(folder))
    return folder


@pytest.fixture
def db(template, workspace, tmp_path, monkeypatch):
    """A database of its own that the page works on."""
    with behind_pages(shutil.copy(template / "lipdb.db", tmp_path), monkeypatch) as database:
        yield database


def languages_page(name: str = "anna", **session: Any) -> AppTest:
    page = AppTest.from_file(str(DASHBOARD / "pages" / "languages.py"), default_timeout=120)
    page.session_state["visitor"] = name
    for key, value in session.items():
        page.session_state[key] = value
    return sound(page.run())


def sound(page: AppTest) -> AppTest:
    assert not page.exception, page.exception[0].message
    return page


def press(page: AppTest, label: str) -> AppTest:
    return sound(next(one for one in page.button if one.label == label).click().run())


def field(page: AppTest, label: str) -> Any:
    everything = (*page.text_input, *page.text_area, *page.selectbox, *page.multiselect)
    return next(one for one in everything if one.label == label)


def step(page: AppTest, name: str) -> AppTest:
    page.session_state["languages_go"] = name
    return sound(page.run())


def errors(page: AppTest) -> list[str]:
    return [one.value for one in page.error]


def typed(**fields: str) -> AppTest:
    """The first step, filled in for a language that no program speaks, and the phones proposed."""
    page = languages_page(languages_view=ADD, languages_how="No voice: I type the phones")
    values = {"Name": "Palu", "Code": "qpa", "Its phones, in IPA": PHONES, "A text of the language": TEXT, **fields}
    for label, value in values.items():
        field(page, label).set_value(value)
    return press(page, "Propose the phones")


def draft(page: AppTest) -> Any:
    return page.session_state["languages_work"].draft


def test_the_languages_are_shown_with_their_phones_and_layers(db) -> None:
    page = languages_page()
    shown = page.dataframe[0].value
    assert list(shown[shown["phone"] == "S"][["common", "layer"]].iloc[0]) == ["sh", "language:en"]
    assert errors(page) == []


def test_a_mapping_is_edited_with_the_author_and_the_reason_in_the_history(db) -> None:
    page = languages_page(languages_phone_of_en="N")
    field(page, "Common phones").set_value(["kg"])
    field(page, "Why (for the history)").set_value("the back of the tongue").run()
    press(page, "Save")
    row = db.records["en/phones.tsv"]["N",]
    assert [row[name] for name in ("common", "origin", "author")] == ["kg", "authored", "anna"]
    assert db.store.history(limit=1)[0].note == "the back of the tongue"


def test_what_somebody_else_saved_first_is_asked_about_and_nothing_is_lost(db) -> None:
    page = languages_page(languages_phone_of_en="N")
    field(page, "Common phones").set_value(["kg"]).run()
    with db.edit(author="bob") as edit:
        edit.put("en/phones.tsv", {**db.records["en/phones.tsv"]["N",], "common": "h"})
    press(page, "Save")
    assert "conflict_asked" in page.session_state
    assert db.records["en/phones.tsv"]["N",]["common"] == "h"
    press(page, "Save mine over theirs")
    assert db.records["en/phones.tsv"]["N",]["common"] == "kg"


def test_an_edit_needs_a_name(db) -> None:
    page = languages_page("", languages_phone_of_en="N")
    field(page, "Common phones").set_value(["kg"]).run()
    press(page, "Save")
    assert "who are you" in errors(page)[0]
    assert db.store.revision == 1


def test_undo_at_one_phone_leaves_what_was_typed_at_another_whose_name_begins_alike(db) -> None:
    with db.edit(author="bob") as edit:
        edit.put("en/phones.tsv", {**db.records["en/phones.tsv"]["t",], "phone": "t_common"})
    page = languages_page(languages_phone_of_en="t_common")
    field(page, "IPA").set_value("tʰ").run()
    page.session_state["languages_phone_of_en"] = "t"
    sound(page.run())
    field(page, "IPA").set_value("t̪").run()
    press(page, "Undo")
    assert field(page, "IPA").value == "t"
    page.session_state["languages_phone_of_en"] = "t_common"
    assert field(sound(page.run()), "IPA").value == "tʰ"


def test_an_alias_is_added_changed_and_deleted(db) -> None:
    page = languages_page(languages_tab="Aliases")
    page.session_state["alias en   notation"] = "arpabet"
    field(page, "Symbol").set_value("NQ")
    field(page, "Stands for").set_value("N").run()
    press(page, "Save")
    assert db.records["en/aliases.tsv"]["arpabet", "NQ"]["phones"] == "N"
    page.session_state["languages_alias_of_en"] = "arpabet NQ"
    sound(page.run())
    field(page, "Stands for").set_value("N q").run()
    press(page, "Save")
    assert "en has no phone 'q'" in errors(page)[0]
    field(page, "Stands for").set_value("N g").run()
    press(page, "Save")
    assert db.records["en/aliases.tsv"]["arpabet", "NQ"]["phones"] == "N g"
    press(page, "Delete")
    assert ("arpabet", "NQ") not in db.records["en/aliases.tsv"]


def test_a_language_is_checked_and_what_it_takes_over_is_shown(db) -> None:
    page = languages_page(languages_tab="Check", languages_code_shown="cmn")
    assert "in order" in page.success[0].value
    page = languages_page(languages_tab="What it takes over", languages_code_shown="cmn")
    parts = page.dataframe[0].value
    assert list(parts[parts["pairs of"] == "possible"][["shared", "new"]].iloc[0]) == [441, 43]


def test_an_invented_language_goes_from_phones_to_text_and_speech(db, workspace) -> None:
    page = typed()
    assert [page.dataframe[0].value.iloc[0][name] for name in ("phone", "common", "second")] == ["ɸ", "f", "bmp"]
    assert "nearest to bmp" in page.warning[0].value
    press(page, "Take bmp")
    press(page, "Right so")
    assert draft(page).entries["ɸ"].common == ("bmp",)
    step(page, "3 Common phones")
    assert [one.value for one in page.metric] == ["49", "49", "0", "0"]
    step(page, "4 Check")
    assert "Palu is in order" in page.success[0].value
    step(page, "5 Save")
    press(page, "Write the folder")
    assert read_folder(workspace)["qpa/phones.tsv"]["ɸ",]["common"] == "bmp"
    press(page, "Load into the database")
    assert [one.symbol for one in db.say("miku", language="qpa").schedule.phones] == ["_", "m", "i", "k", "u", "_"]
    assert {row["origin"] for row in db.records["qpa/phones.tsv"].values()} == {"authored", "generated"}
    assert db.store.history(limit=1)[0].note == "Add the language Palu (qpa)"


def test_a_common_phone_of_its_own_is_added_with_its_price_and_taken_back(db, workspace) -> None:
    page = step(typed(), "3 Common phones")
    for label, value in {"Name": "ph", "Typical sound (IPA)": "ɸ", "A kind of": "f", "Phones that map to it": ["ɸ"]}.items():
        field(page, label).set_value(value)
    press(page, "Add the common phone")
    assert [one.value for one in page.metric] == ["64", "49", "15", "15"]
    assert draft(page).entries["ɸ"].common == ("ph",)
    press(page, "Take back")
    assert (draft(page).common, draft(page).entries["ɸ"].common) == ({}, ("f",))


def test_a_voice_proposes_phones_with_the_doubtful_first(db) -> None:
    page = languages_page(languages_view=ADD)
    field(page, "Voice").set_value("hu")
    field(page, "A text of the language").set_value("Jó reggelt kívánok, a nevem Anna. Gyönyörű nap.")
    press(page, "Propose the phones")
    found = draft(page)
    assert (found.code, found.row["name"], found.row["voice"]) == ("hu", "Hungarian", "hu")
    doubtful = [one.doubtful for one in found.in_order()]
    assert doubtful == sorted(doubtful, reverse=True)
    assert set(doubtful) == {True, False}
    assert all(one.phone.count for one in found.entries.values())


@pytest.mark.parametrize(
    ("fields", "told"),
    [
        ({"Code": "Palu!"}, "is no code of a language"),
        ({"Code": "en"}, "'en' is there already"),
        ({"Name": ""}, "give the language a name"),
        ({"Its phones, in IPA": "p § a"}, "no IPA: '§'"),
        ({"Its phones, in IPA": ""}, "there is no phone"),
    ],
)
def test_what_can_t_be_is_said_in_one_line_and_what_was_typed_stays(db, fields, told) -> None:
    page = typed(**fields)
    (message,) = errors(page)
    assert told in message
    assert "\n" not in message
    assert field(page, "A text of the language").value == TEXT


@pytest.mark.parametrize(
    ("voice", "text", "told"), [("pl", "你好", "can read none"), ("pl", "?!", "no word"), (None, "Ala", "choose a voice")]
)
def test_a_text_that_the_voice_can_t_read_is_said(db, voice, text, told) -> None:
    page = languages_page(languages_view=ADD)
    field(page, "Voice").set_value(voice)
    field(page, "Code").set_value("qpa")
    field(page, "A text of the language").set_value(text)
    press(page, "Propose the phones")
    assert told in errors(page)[0]


def test_two_visitors_do_not_see_each_others_drafts(db) -> None:
    typed()
    other = languages_page("bob", languages_view=ADD)
    assert "languages_work" not in other.session_state


def test_saving_needs_a_name_and_overwrites_nothing(db, workspace) -> None:
    page = typed()
    page.session_state["visitor"] = ""
    step(page, "5 Save")
    press(page, "Write the folder")
    assert "who are you" in errors(page)[0]
    assert not (workspace / "qpa").exists()
    (workspace / "qpa").mkdir()
    page.session_state["visitor"] = "anna"
    press(page, "Write the folder")
    assert "never overwritten" in errors(page)[0]
    press(page, "Load into the database")
    assert "qpa/phones.tsv" in db.records


def test_two_versions_are_compared_and_merged_into_the_database(db, workspace) -> None:
    file = workspace / "en/phones.tsv"
    file.write_text(file.read_text().replace("N\tconsonant\tŋ\td\t", "N\tconsonant\tŋ\tkg\t"))
    page = languages_page(languages_view=COMPARE)
    rows = page.dataframe[0].value
    assert [list(row) for row in rows[["what", "table", "row", "left", "right"]].values] == [
        ["changed", "en/phones.tsv", "N", "common d", "common kg"]
    ]
    press(page, "Take the right for all")
    press(page, "Save to the database")
    assert db.records["en/phones.tsv"]["N",]["common"] == "kg"
    assert "They are the same." in [one.value for one in page.success]


def test_a_conflict_waits_for_a_choice_and_goes_to_the_workspace(db, workspace) -> None:
    file = workspace / "en/phones.tsv"
    file.write_text(file.read_text().replace("N\tconsonant\tŋ\td\t", "N\tconsonant\tŋ\tkg\t"))
    with db.edit(author="bob") as edit:
        edit.put("en/phones.tsv", {**db.records["en/phones.tsv"]["N",], "common": "h"})
    page = languages_page(languages_view=COMPARE, languages_base_kind="The database at a revision", languages_base_revision=1)
    assert "1 conflict waits" in page.info[0].value
    merging = page.session_state["languages_merging"]
    merging.choices[merging.found[0].place] = "left"
    sound(page.run())
    press(page, "Save to the workspace")
    assert read_folder(workspace)["en/phones.tsv"]["N",]["common"] == "h"


def test_a_folder_that_is_none_is_said_and_the_other_sides_stay(db, tmp_path) -> None:
    page = languages_page(languages_view=COMPARE, languages_left_kind="Another folder", languages_left_folder=str(tmp_path / "nix"))
    assert "no curated text there" in errors(page)[0]
    assert [box.value for box in page.selectbox if box.label in ("Right", "What both were made from")] == [
        "The workspace folder",
        "Not known",
    ]
