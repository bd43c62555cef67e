"""The front page in a real browser: say a line, and see the mouth move in step with the sound."""

import pytest
from browser import settled, stage_state

import lipdb


@pytest.fixture(scope="module")
def front(app, page):
    page.goto(app.url)
    page.locator(".stage canvas").first.wait_for()
    settled(page)
    return page


def seek(page, time: float) -> None:
    page.locator(".stage").evaluate("(stage, time) => stage.lipdb.clock.seek(time)", time)
    page.wait_for_timeout(50)
    for _ in range(100):
        if abs(stage_state(page)["time"] - time) < 1e-3:
            return
        page.wait_for_timeout(50)
    raise AssertionError(f"the player did not come to {time} s")


def test_the_example_speaks_and_the_weights_on_the_page_are_those_of_the_track(app, front) -> None:
    with lipdb.open(str(app.database)) as db:
        track = db.animate(db.say("Hello! Bob may find five blue whales.")).track
    for frame in (0, 40, 67, 77, 120, len(track.weights) - 1):
        seek(front, frame / track.fps)
        shown = stage_state(front)
        assert [shown["poses"][pose] for pose in track.poses] == pytest.approx(track.weights[frame].tolist(), abs=1e-5)
        assert shown["faces"][0]["moving"] == len(track.poses)


def test_playing_moves_time_on_with_the_sound(front) -> None:
    seek(front, 0)
    front.locator(".stage .play").click()
    for _ in range(200):
        if stage_state(front)["time"] > 0.3:
            break
        front.wait_for_timeout(50)
    state, audio = front.locator(".stage").evaluate("stage => [stage.lipdb.state, stage.querySelector('audio').currentTime]")
    assert state["playing"]
    assert 0.3 < state["time"] <= audio + 0.05
    front.locator(".stage .play").click()
    assert not stage_state(front)["playing"]


def test_another_sentence_and_a_flat_mouth(front) -> None:
    front.get_by_label("Sentence").fill("Mama")
    front.get_by_label("Sentence").press("Enter")
    front.get_by_label("Character", exact=True).click()
    front.get_by_role("option", name="flat").click()
    front.locator(".stage .pictures img").first.wait_for(state="attached")
    settled(front)
    for _ in range(100):
        duration = front.locator(".stage").evaluate("stage => stage.lipdb.clock.duration")
        if 0.4 < duration < 2:
            break
        front.wait_for_timeout(50)
    assert 0.4 < duration < 2
    assert stage_state(front)["faces"][0]["shown"] in set("ABCDEFGHX")


def test_nonsense_is_answered_with_what_to_do(front) -> None:
    front.get_by_label("Sentence").fill("你好")
    front.get_by_label("Sentence").press("Enter")
    message = front.get_by_test_id("stAlert")
    message.wait_for()
    assert "give the --language of the text" in message.inner_text()


def test_a_click_into_the_lanes_explains_the_instant(front) -> None:
    front.get_by_label("Sentence").fill("Mama")
    front.get_by_label("Sentence").press("Enter")
    lanes = front.locator(".stage .over")
    box = lanes.bounding_box()
    lanes.click(position={"x": box["width"] * 0.5, "y": 60})
    front.get_by_text("What made the weights at").wait_for()
