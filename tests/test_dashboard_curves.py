"""The page Curves in a real browser: drag a key, save, find it, undo it; two people and one curve; one character alone."""

import json
import re

import pytest
from browser import click_until, eventually, settled, tab

import lipdb
from lipdb.curves.keys import parse_keys


def open_curves(app, page, *, name: str, pair: str = "l-ow", character: str = "robin", kind: str = "common") -> None:
    """Load the page anew, say who one is, and let the face rest: software draws it here."""
    page.goto(f"{app.url}/curves?pair={pair}&language=en&character={character}&kind={kind}")
    page.locator(".keys .lane").first.wait_for()
    page.locator(".stage .play").first.wait_for()
    page.locator(".stage").evaluate_all("all => all.forEach(stage => stage.lipdb?.clock.pause())")
    field = page.get_by_role("textbox", name="Your name")
    field.fill(name)
    field.press("Enter")
    settled(page)


def lane(page, pose: str):
    return page.locator(f'.keys .lane[data-pose="{pose}"]')


def keys_of(page, pose: str) -> list[tuple[float, float]]:
    texts = lane(page, pose).locator(".key").evaluate_all("all => all.map(one => one.getAttribute('aria-valuetext'))")
    return [tuple(float(number) for number in re.findall(r"[\d.]+", text)) for text in texts]


def drag(page, pose: str, key: int, *, up: float, free: bool = False) -> None:
    """Drag one key *up* pixels."""
    box = lane(page, pose).locator(".key").nth(key).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    if free:
        page.keyboard.down("Alt")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - up, steps=3)
    page.mouse.up()
    if free:
        page.keyboard.up("Alt")


def save(page, note: str = "") -> None:
    page.get_by_text("Not saved yet:").wait_for()
    if note:
        page.get_by_label("Note for the history").fill(note)
    page.get_by_role("button", name="Save", exact=True).click()


def stored(app, *key: str, table: str = "curves/facefx.tsv") -> str:
    with lipdb.open(str(app.database)) as db:
        row = db.records.get(table, {}).get(key)
        return row["keys"] if row else "-"


def said(app, folder, character: str = "robin") -> str:
    """The track that `lipdb say` gives for "low"."""
    file = folder / "low.csv"
    app.lipdb("say", "low", "--character", character, "-o", str(file))
    return file.read_text()


@pytest.fixture(scope="module")
def curves(app, page):
    open_curves(app, page, name="anna")
    return page


def test_a_dragged_key_is_drawn_saved_found_and_undone(app, curves, tmp_path) -> None:
    before, plain = stored(app, "l", "ow", "W"), said(app, tmp_path)
    old = keys_of(curves, "W")
    drawn = lane(curves, "W").locator(".drawn").get_attribute("points")
    drag(curves, "W", 1, up=14)
    new = keys_of(curves, "W")
    assert new[1][1] > old[1][1] + 0.2
    assert [key for k, key in enumerate(new) if k != 1] == [key for k, key in enumerate(old) if k != 1]
    assert new[1][1] * 20 == pytest.approx(round(new[1][1] * 20))  # on the grid
    eventually(curves, lambda: lane(curves, "W").locator(".drawn").get_attribute("points") != drawn, "another curve")
    save(curves, "rounder lips")
    curves.get_by_text("Saved l-ow: W to common").wait_for()

    after = stored(app, "l", "ow", "W")
    assert after.split()[1] == f"{new[1][0]:g}:{new[1][1]:g}"
    assert said(app, tmp_path) != plain
    listed = json.loads(app.lipdb("db", "history", "curves/facefx.tsv", "l", "ow", "W", "--json"))
    assert (listed[0]["author"], listed[0]["note"]) == ("anna", "rounder lips")

    open_curves(app, curves, name="anna")
    assert keys_of(curves, "W") == new

    app.lipdb("db", "undo", str(listed[0]["revision"]))
    assert stored(app, "l", "ow", "W") == before
    assert said(app, tmp_path) == plain
    open_curves(app, curves, name="anna")
    assert keys_of(curves, "W") == old


def test_keys_are_added_taken_away_undone_and_done_again(curves) -> None:
    old = keys_of(curves, "wide")
    box = lane(curves, "wide").locator(".plot").bounding_box()
    curves.mouse.dblclick(box["x"] + box["width"] * 0.4, box["y"] + 8)
    added = keys_of(curves, "wide")
    assert len(added) == len(old) + 1
    curves.get_by_text("Not saved yet: wide.").wait_for()
    lane(curves, "wide").locator(".key").nth(added.index((set(added) - set(old)).pop())).focus()
    curves.keyboard.press("ArrowDown")
    nudged = keys_of(curves, "wide")
    assert nudged != added
    curves.keyboard.press("Delete")
    assert keys_of(curves, "wide") == old
    for expected in (nudged, added, old):
        curves.keyboard.press("Control+z")
        assert keys_of(curves, "wide") == expected
    curves.keyboard.press("Control+y")
    assert keys_of(curves, "wide") == added
    curves.locator(".keys").get_by_role("button", name="Undo").click()
    assert keys_of(curves, "wide") == old
    # A lane at zero gets three keys at once; "reset" leaves it to the layer below.
    box = lane(curves, "tBack").locator(".plot").bounding_box()
    curves.mouse.dblclick(box["x"] + box["width"] / 2, box["y"] + 8)
    assert len(keys_of(curves, "tBack")) == 3
    lane(curves, "tBack").locator(".reset").click()
    assert keys_of(curves, "tBack") == []
    curves.keyboard.press("Control+z")
    curves.keyboard.press("Control+z")
    curves.get_by_text("Not saved yet").wait_for(state="hidden")


def test_the_loop_plays_the_edited_pair(app, curves) -> None:
    loop = curves.locator(".stage").first
    state = loop.evaluate("stage => [stage.lipdb.clock.loop, stage.lipdb.clock.duration]")
    assert state[0] == pytest.approx([0, state[1]], abs=0.02)
    loop.evaluate("stage => stage.lipdb.clock.seek(0.47)")
    eventually(curves, lambda: abs(loop.evaluate("stage => stage.lipdb.state.time") - 0.47) < 1e-3, "the border is shown")
    playhead = curves.locator(".keys .playhead")
    eventually(curves, playhead.is_visible, "a playhead")
    box, plot = playhead.bounding_box(), lane(curves, "W").locator(".plot").bounding_box()
    assert box["x"] == pytest.approx(plot["x"] + plot["width"] / 2, abs=3)  # the border of the two phones
    before = rounding(loop)
    drag(curves, "W", 1, up=16)
    eventually(curves, lambda: rounding(loop) > before + 0.1, "rounder lips")
    settled(curves)
    curves.get_by_role("button", name="Discard").click()
    curves.get_by_text("Not saved yet").wait_for(state="hidden")
    eventually(curves, lambda: abs(rounding(loop) - before) < 1e-6, "lips as before")


def rounding(loop) -> float:
    return loop.evaluate("stage => stage.lipdb.state.poses.W")


def shown_pair(page) -> str:
    """The pair whose curves are edited, as the address names it."""
    return re.search("pair=([^&]*)", page.url)[1]


def row_keys(app, pair: str, pose: str) -> list[tuple[float, float]]:
    return list(parse_keys(stored(app, *pair.split("-"), pose).strip("-")))


def test_a_click_into_the_matrix_of_all_pairs_opens_that_pair_and_the_way_back_leads_to_the_one_before(app, curves) -> None:
    open_curves(app, curves, name="anna")
    curves.get_by_role("button", name="All pairs").click()
    dialog = curves.get_by_test_id("stDialog")
    matrix = dialog.get_by_test_id("stVegaLiteChart").locator("canvas, svg").first
    pair = click_until(curves, matrix, lambda: (now := shown_pair(curves)) != "l-ow" and now, x=0.4, y=0.4)
    comes_to(app, curves, pair)
    curves.go_back()
    comes_to(app, curves, "l-ow")
    curves.go_forward()
    comes_to(app, curves, pair)


def comes_to(app, page, pair: str) -> None:
    eventually(page, lambda: shown_pair(page) == pair, f"{pair} in the address")
    eventually(page, lambda: keys_of(page, "open") == row_keys(app, pair, "open"), f"the curve of {pair}")
    settled(page)


def test_curves_are_copied_from_another_pair_as_a_step_that_can_be_undone(app, curves) -> None:
    open_curves(app, curves, name="anna", pair="l-eh")
    before = keys_of(curves, "wide")
    assert before != row_keys(app, "l-ih", "wide")
    curves.get_by_role("button", name="Copy from").click()
    field = curves.get_by_role("combobox", name="Pair", exact=True)
    field.fill("l-ih")
    curves.get_by_role("option", name="l-ih", exact=True).click()
    settled(curves)
    curves.get_by_role("button", name="Copy", exact=True).click()
    eventually(curves, lambda: keys_of(curves, "wide") == row_keys(app, "l-ih", "wide"), "the curve of l-ih")
    curves.keyboard.press("Escape")
    curves.get_by_text("Not saved yet:").wait_for()
    settled(curves)
    curves.keyboard.press("Control+z")
    eventually(curves, lambda: keys_of(curves, "wide") == before, "the curve of before")
    curves.get_by_text("Not saved yet:").wait_for(state="hidden")


def test_a_pair_that_is_right_is_accepted_and_that_is_taken_back(app, curves) -> None:
    open_curves(app, curves, name="anna", pair="l-eh")
    before = stored(app, "l", "eh", "open")
    curves.get_by_role("button", name="Accept as it is").click()
    curves.get_by_text("Saved l-eh, accepted as it is, to common").wait_for()
    with lipdb.open(str(app.database)) as db:
        assert not db.uses({("l", "eh"): 1.0}, language="en", character="robin")[0].gap
    assert stored(app, "l", "eh", "open") == before
    curves.get_by_role("button", name="Undo save").click()
    curves.get_by_text(re.compile(r"Revision \d+ takes revision \d+ back")).wait_for()
    with lipdb.open(str(app.database)) as db:
        assert db.uses({("l", "eh"): 1.0}, language="en", character="robin")[0].gap


@pytest.fixture
def bob(chromium):
    with tab(chromium) as page:
        yield page


def test_two_people_and_one_curve(app, bob, curves) -> None:
    open_curves(app, bob, name="bob", pair="l-ih")
    open_curves(app, curves, name="anna", pair="l-ih")
    drag(bob, "wide", 1, up=-6, free=True)
    save(bob)
    bob.get_by_text("Saved l-ih: wide to common").wait_for()
    theirs = stored(app, "l", "ih", "wide")
    drag(curves, "wide", 1, up=10, free=True)
    save(curves)
    dialog = curves.get_by_test_id("stDialog")
    dialog.get_by_text("bob changed 1 row that you changed too").wait_for()
    dialog.locator("svg, canvas").first.wait_for()
    assert stored(app, "l", "ih", "wide") == theirs
    dialog.get_by_role("button", name="Save mine over theirs").click()
    curves.get_by_text("Saved l-ih: wide to common").wait_for()
    assert stored(app, "l", "ih", "wide").split()[1] == "{:g}:{:g}".format(*keys_of(curves, "wide")[1])
    authors = [one["author"] for one in json.loads(app.lipdb("db", "history", "curves/facefx.tsv", "l", "ih", "wide", "--json"))]
    assert authors[:2] == ["anna", "bob"]


def test_the_crab_alone(app, curves, tmp_path) -> None:
    human, crab = said(app, tmp_path), said(app, tmp_path, "crab")
    open_curves(app, curves, name="anna", character="crab", kind="character")
    drag(curves, "mouth_open", 1, up=-12, free=True)
    save(curves)
    curves.get_by_text("Saved l-ow: mouth_open to character:crab").wait_for()
    assert said(app, tmp_path) == human
    assert said(app, tmp_path, "crab") != crab


def test_an_editor_whose_data_was_overtaken_on_its_way_keeps_what_can_be_undone(curves) -> None:
    """Streamlit ends a call of a component that newer data overtook: by then the element shows the newer."""
    sent, back, left = curves.evaluate(
        """async () => {
            const { default: mount } = await import(document.querySelector('script[type="module"][src*="keys"]').src);
            const host = document.body.appendChild(document.createElement("div"));
            host.innerHTML = '<div class="keys"></div>';
            const values = [];
            const lane = { pose: "A", keys: [[0.2, 0], [0.5, 1], [0.8, 0]], below: [], from: "common", note: "", drawn: [] };
            const call = (drawn) => mount({
                parentElement: host,
                data: { id: "one", lanes: [{ ...lane, drawn }], locked: false, silent: [false, false] },
                setStateValue: (name, value) => values.push(value.curves.A),
            });
            const pause = () => new Promise((done) => setTimeout(done, 500));
            const press = () => document.dispatchEvent(new KeyboardEvent("keydown", { key: "z", ctrlKey: true }));
            const overtaken = call([]);
            host.querySelector(".reset").click();
            const last = call([[0, 0], [1, 0]]);
            overtaken();
            await pause();
            const sent = values.length && values.at(-1);
            press();
            await pause();
            const back = values.at(-1);
            host.querySelector(".reset").click();
            host.remove();
            last();
            const before = values.length;
            press();
            await pause();
            return [sent, back, values.length - before];
        }"""
    )
    assert sent is None  # what was changed before is sent nevertheless
    assert back == [[0.2, 0], [0.5, 1], [0.8, 0]]  # and can be taken back
    assert left == 0  # an editor that has left the page hears nothing
