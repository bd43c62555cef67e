"""The page Curves without a browser: what it sends to the editor, what it does with the answer, what it saves."""

from __future__ import annotations

import json
import shutil
from typing import Any

import pytest
from page_cases import DASHBOARD, behind_pages
from streamlit.testing.v1 import AppTest

from lipdb.curves.keys import format_keys

PEAK = [[0.0, 0.0], [0.5, 0.9], [1.0, 0.0]]


@pytest.fixture
def db(as_shipped, tmp_path, monkeypatch):
    """A database of its own that the page works on."""
    with behind_pages(shutil.copy(as_shipped, tmp_path), monkeypatch) as database:
        yield database


def curves_page(db, **session: Any) -> AppTest:
    page = AppTest.from_file(str(DASHBOARD / "pages" / "curves.py"), default_timeout=60)
    page.session_state["visitor"] = "anna"
    for name, value in session.items():
        page.session_state[name] = value
    return page.run()


def sent(page: AppTest) -> dict[str, Any]:
    """What the page sends to the editor of keys."""
    assert not page.exception
    found = [one.proto for one in page.get("bidi_component") if one.proto.component_name.endswith("keys")]
    assert len(found) == 1
    return json.loads(found[0].json)


def pair(page: AppTest) -> tuple[str, str]:
    """The pair that is edited."""
    data = sent(page)["pair"]
    return data["left"], data["right"]


def edit(page: AppTest, **curves: Any) -> AppTest:
    """What the editor sends when the visitor has changed *curves*, and the page after it."""
    data = sent(page)
    now = {lane["pose"]: lane["keys"] for lane in data["lanes"]}
    taken = data["given"]["token"] if data["given"] else ""
    page.session_state["curves_keys"] = {"curves": {"id": data["id"], "taken": taken, "curves": {**now, **curves}}}
    return page.run()


def press(page: AppTest, label: str) -> AppTest:
    return next(button for button in page.button if button.label == label).click().run()


def lane(page: AppTest, pose: str) -> dict[str, Any]:
    return next(one for one in sent(page)["lanes"] if one["pose"] == pose)


def said(page: AppTest) -> str:
    return " ".join(element.value for kind in (page.caption, page.success, page.error) for element in kind)


def test_the_page_opens_with_a_pair_its_curves_and_its_sentence(db) -> None:
    page = curves_page(db)
    data = sent(page)
    assert (data["pair"]["left"], data["pair"]["right"], data["locked"], data["silent"]) == ("l", "ow", False, [False, False])
    assert [one["pose"] for one in data["lanes"]] == list(db.pose_set("facefx").poses)
    row = db.records["curves/facefx.tsv"]["l", "ow", "W"]["keys"]
    assert " ".join(f"{time:g}:{weight:g}" for time, weight in lane(page, "W")["keys"]) == row
    assert len(page.get("bidi_component")) == 3  # the editor, the loop, the sentence
    assert "l-ow" in page.query_params["pair"]


def test_an_edit_is_drawn_at_once_and_saved_as_one_row(db) -> None:
    page = curves_page(db)
    before = lane(page, "W")["drawn"]
    edit(page, W=PEAK)
    assert lane(page, "W")["drawn"] != before
    assert "Not saved yet: W." in said(page)
    seen = db.store.revision
    page.text_input(key="curves_note").set_value("rounder")
    press(page, "Save")
    assert db.store.revision == seen + 1
    [change] = db.store.changes(seen + 1)
    assert (change.path, change.key, change.after["keys"]) == ("curves/facefx.tsv", ("l", "ow", "W"), "0:0 0.5:0.9 1:0")
    [revision] = db.store.history(limit=1)
    assert (revision.author, revision.note) == ("anna", "rounder")
    assert f"Saved l-ow: W to common as revision {seen + 1}." in said(page)
    assert db.records["curves/facefx.tsv"]["l", "ow", "W"]["origin"] == "authored"


def test_the_editor_keeps_its_steps_when_a_save_changed_nothing_else(db) -> None:
    page = edit(curves_page(db), W=PEAK)
    token = sent(page)["id"]
    press(page, "Save")
    assert sent(page)["id"] == token
    edit(page, W=[])
    press(page, "Save")
    assert db.records["curves/facefx.tsv"]["l", "ow", "W"]["keys"] == ""  # zero, not "no row"


def test_who_saves_without_a_name_is_asked_for_it_below_the_button_and_keeps_the_faces(db) -> None:
    page = edit(curves_page(db, visitor=""), W=PEAK)
    press(page, "Save")
    assert [error.value for error in page.error] == ["who are you? Give your name in the side bar; it stands beside every change"]
    assert [one.proto.component_name for one in page.get("bidi_component")] == ["lipdb.keys", "lipdb.stage", "lipdb.stage"]
    assert len(page.expander) == 1


def test_undo_beside_saved_takes_exactly_that_revision_back(db) -> None:
    before = db.records["curves/facefx.tsv"]["l", "ow", "W"]
    page = edit(curves_page(db), W=PEAK)
    press(page, "Save")
    with db.edit(author="bob") as change:  # of something else, meanwhile
        change.put("curves/facefx.tsv", {**db.records["curves/facefx.tsv"]["l", "ih", "W"], "keys": "0:0 0.5:0.2 1:0"})
    page.button(key="curves_undo").click().run()
    assert "Revision 4 takes revision 2 back." in said(page)
    assert db.records["curves/facefx.tsv"]["l", "ow", "W"] == before
    assert db.records["curves/facefx.tsv"]["l", "ih", "W"]["keys"] == "0:0 0.5:0.2 1:0"
    assert format_keys(lane(page, "W")["keys"]) == before["keys"]
    page.button(key="curves_undo").click().run()
    assert lane(page, "W")["keys"] == PEAK


def test_undo_beside_saved_is_refused_where_it_would_lose_somebody_elses_work(db) -> None:
    page = edit(curves_page(db), W=PEAK)
    press(page, "Save")
    with db.edit(author="bob") as change:
        change.put("curves/facefx.tsv", {**db.records["curves/facefx.tsv"]["l", "ow", "W"], "keys": "0:0 0.5:0.2 1:0"})
    page.button(key="curves_undo").click().run()
    assert "revision 2 not undone: bob changed the same in revision 3" in said(page)
    assert db.store.revision == 3


def test_a_pair_that_is_right_is_accepted_as_it_is_and_that_can_be_taken_back(db) -> None:
    page = edit(curves_page(db), W=PEAK)
    before = {pose: lane(page, pose)["keys"] for pose in ("open", "wide")}
    press(page, "Accept as it is")
    assert f"Saved l-ow, accepted as it is, to common as revision {db.store.revision}." in said(page)
    [use] = db.uses({("l", "ow"): 1.0}, language="en", character="robin")
    assert (use.origin, use.gap) == ("authored", False)
    assert db.store.history(limit=1)[0].note == "l-ow, accepted as it is"
    assert {pose: lane(page, pose)["keys"] for pose in ("open", "wide")} == before
    assert lane(page, "W")["keys"] == PEAK
    assert next(button for button in page.button if button.label == "Accept as it is").disabled
    page.button(key="curves_undo").click().run()
    assert db.uses({("l", "ow"): 1.0}, language="en", character="robin")[0].gap


def test_back_to_the_layer_below_takes_the_row_away(db) -> None:
    page = curves_page(db)
    page.session_state["curves_choice"].kind = "language"
    common = lane(page.run(), "W")["below"]
    press(edit(page, W=PEAK), "Save")
    assert db.records["en/curves/facefx.tsv"]["l", "ow", "W"]["keys"] == format_keys(PEAK)
    press(edit(page, W=None), "Save")
    assert ("l", "ow", "W") not in db.records.get("en/curves/facefx.tsv", {})
    assert lane(page, "W")["keys"] is None
    assert lane(page, "W")["below"] == common != []


def test_a_character_layer_leaves_everybody_else_alone(db) -> None:
    page = curves_page(db)
    page.session_state["curves_choice"].character = "crab"
    page.session_state["curves_choice"].kind = "character"
    page.run()
    assert [one["pose"] for one in sent(page)["lanes"]] == list(db.pose_set("crab").poses)
    before = db.animate(db.say("low"), character="robin").track.weights
    edit(page, mouth_open=PEAK)
    press(page, "Save")
    assert db.records["characters/crab/curves/crab.tsv"]["l", "ow", "mouth_open"]["keys"] == "0:0 0.5:0.9 1:0"
    assert (db.animate(db.say("low"), character="robin").track.weights == before).all()


def test_a_pair_through_links_is_saved_whole_and_clean_afterwards(db) -> None:
    page = curves_page(db)
    chosen = page.session_state["curves_choice"]
    chosen.right, chosen.character, chosen.kind = "eh", "crab", "character"
    page.run()
    token = sent(page)["id"]
    edit(page, smile=PEAK)
    press(page, "Save")
    assert len([key for key in db.records["characters/crab/curves/crab.tsv"] if key[:2] == ("l", "eh")]) == 9
    assert "Not saved yet" not in said(page)
    assert sent(page)["id"] != token


def test_a_word_gives_its_pairs_in_any_language(db) -> None:
    page = curves_page(db)
    page.text_input(key="curves_word").set_value("papa").run()
    assert pair(page) == ("bmp", "aa")
    page.session_state["curves_choice"].language = "cmn"
    page.text_input(key="curves_word").set_value("绿").run()
    assert pair(page) == ("l", "ue")
    page.text_input(key="curves_word").set_value("low").run()
    assert "script" in said(page) or "give the language" in said(page)


def test_silence_is_a_phone_whose_end_stays_at_rest(db) -> None:
    page = curves_page(db)
    page.session_state["curves_choice"].left = "_"
    page.run()
    assert sent(page)["silent"] == [True, False]
    edit(page, W=[[0.0, 0.5], [1.0, 0.0]])
    assert "begins with weight 0" in said(page)


def test_unsaved_changes_wait_while_another_pair_is_looked_at(db) -> None:
    page = edit(curves_page(db), W=PEAK)
    page.session_state["curves_choice"].right = "ah"
    page.run()
    assert pair(page) == ("l", "ah")
    assert "Not saved yet elsewhere: l-ow" in said(page)
    page.session_state["curves_choice"].right = "ow"
    page.run()
    assert lane(page, "W")["keys"] == PEAK
    press(page, "Discard")
    assert lane(page, "W")["keys"] != PEAK


def test_visitors_do_not_see_each_others_unsaved_state(db) -> None:
    mine = edit(curves_page(db), W=PEAK)
    theirs = curves_page(db, visitor="bob")
    assert lane(theirs, "W")["keys"] != PEAK
    assert lane(mine, "W")["keys"] == PEAK


def test_copying_from_another_pair_is_a_step_that_can_be_undone(db) -> None:
    page = curves_page(db)
    page.selectbox(key="curves_copy_pair_facefx_l-ow").set_value("l-ih")
    press(page, "Copy")
    given = sent(page)["given"]
    row = db.records["curves/facefx.tsv"]["l", "ih", "wide"]["keys"]
    assert " ".join(f"{time:g}:{weight:g}" for time, weight in given["curves"]["wide"]) == row
    assert lane(page, "wide")["keys"] == given["curves"]["wide"]
    page.run()  # the browser has not answered yet
    assert lane(page, "wide")["keys"] == given["curves"]["wide"]


def test_a_clean_page_follows_what_others_save(db) -> None:
    page = curves_page(db)
    with db.edit(author="bob") as change:
        change.put("curves/facefx.tsv", {**db.records["curves/facefx.tsv"]["l", "ow", "W"], "keys": "0:0 0.5:0.2 1:0"})
    page.run()
    assert lane(page, "W")["keys"] == [[0, 0], [0.5, 0.2], [1, 0]]


def test_without_a_name_nothing_is_saved_and_the_page_says_what_to_do(db) -> None:
    page = edit(curves_page(db, visitor=""), W=PEAK)
    seen = db.store.revision
    press(page, "Save")
    assert "Give your name in the side bar" in said(page)
    assert db.store.revision == seen
    page.session_state["visitor"] = "anna"
    page.run()
    assert lane(page, "W")["keys"] == PEAK


def test_an_address_that_names_what_there_is_not_opens_the_page_all_the_same(db) -> None:
    page = AppTest.from_file(str(DASHBOARD / "pages" / "curves.py"), default_timeout=60)
    for name, value in {"pair": "qq-ow", "language": "tlh", "character": "nobody", "kind": "line"}.items():
        page.query_params[name] = value
    page.run()
    assert pair(page) == ("l", "ow")


@pytest.fixture
def conflict(db):
    """Anna edits W and open; Bob has saved W since."""
    page = edit(curves_page(db), W=PEAK, open=PEAK)
    with db.edit(author="bob") as change:
        change.put("curves/facefx.tsv", {**db.records["curves/facefx.tsv"]["l", "ow", "W"], "keys": "0:0 0.5:0.2 1:0"})
    page.run()
    assert "Somebody else has saved this pair meanwhile" in said(page)
    press(page, "Save")
    assert db.records["curves/facefx.tsv"]["l", "ow", "W"]["keys"] == "0:0 0.5:0.2 1:0"
    assert "bob changed 1 row that you changed too" in " ".join(element.value for element in page.markdown)
    return page


@pytest.mark.parametrize(
    ("choice", "rounding"), [("Save mine over theirs", "0:0 0.5:0.9 1:0"), ("Keep theirs", "0:0 0.5:0.2 1:0")]
)  # fmt: skip
def test_the_second_to_save_sees_both_versions_and_chooses(db, conflict, choice, rounding) -> None:
    press(conflict, choice)
    rows = db.records["curves/facefx.tsv"]
    assert (rows["l", "ow", "W"]["keys"], rows["l", "ow", "open"]["keys"]) == (rounding, "0:0 0.5:0.9 1:0")
    conflict.run()
    assert "Not saved yet" not in said(conflict)
    assert [one.author for one in db.store.history("curves/facefx.tsv", ("l", "ow", "W"), limit=2)][-1] in ("bob", "lipdb")


def test_the_second_to_save_chooses_row_by_row_and_nothing_is_chosen_for_them(db) -> None:
    page = edit(curves_page(db), W=PEAK, open=PEAK, wide=PEAK)
    theirs = "0:0 0.5:0.2 1:0"
    with db.edit(author="bob") as change:
        for pose in ("W", "open"):
            change.put("curves/facefx.tsv", {**db.records["curves/facefx.tsv"]["l", "ow", pose], "keys": theirs})
    page.run()
    press(page, "Save")
    seen = db.store.revision
    assert next(button for button in page.button if button.key == "conflict_chosen").disabled
    page.button_group(key=f"conflict_{seen}_0").set_value("Mine").run()
    assert next(button for button in page.button if button.key == "conflict_chosen").label == "Choose for 1 more row"
    page.button_group(key=f"conflict_{seen}_1").set_value("Theirs").run()
    press(page, "Save as chosen")
    rows = db.records["curves/facefx.tsv"]
    mine = "0:0 0.5:0.9 1:0"  # of the first in the order of the poses, and of what nobody else has touched
    assert {pose: rows["l", "ow", pose]["keys"] for pose in ("open", "W", "wide")} == {"open": mine, "W": theirs, "wide": mine}
    page.run()
    assert "Not saved yet" not in said(page)


def test_whoever_goes_on_editing_keeps_everything_and_may_save_later(db, conflict) -> None:
    seen = db.store.revision
    press(conflict, "Go on editing")
    conflict.run()
    assert db.store.revision == seen
    assert lane(conflict, "W")["keys"] == PEAK
    press(conflict, "Save")
    assert db.records["curves/facefx.tsv"]["l", "ow", "W"]["keys"] == "0:0 0.5:0.9 1:0"


def test_a_viewer_may_look_and_not_change(db) -> None:
    page = AppTest.from_file(str(DASHBOARD / "pages" / "curves.py"), default_timeout=60)
    page.secrets = {"auth": {"client_id": "test"}, "lipdb": {"editors": ["anna@example.org"]}}
    page.user = {"is_logged_in": True, "email": "visitor@example.org"}
    page.run()
    assert sent(page)["locked"]
    assert not [button for button in page.button if button.label in ("Save", "Copy", "Discard")]
