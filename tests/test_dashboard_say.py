"""The front page in a real browser: say a line, and see the mouth move in step with the sound."""

import re
from contextlib import contextmanager
from urllib.parse import parse_qs, urlparse

import numpy as np
import pytest
from browser import at_rest, eventually, seek, settled, stage_state, until

import lipdb

EXAMPLE = "Hello! Bob may find five blue whales."


@pytest.fixture(scope="module")
def requests(page):
    """Every address that the page has asked for."""
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    return asked


# Every frame that is drawn while the player plays, for the sentence may be over before a test looks.
KEEP_FRAMES = """
    window.frames_played = [];
    document.addEventListener("lipdb-time", (event) => {
        const [stage] = event.composedPath();
        if (!stage.lipdb?.clock.playing || window.frames_played.length > 500) return;
        window.frames_played.push({ ...stage.lipdb.state, sound: stage.querySelector("audio").currentTime });
    });
"""


@pytest.fixture(scope="module")
def front(app, page, requests):
    page.add_init_script(KEEP_FRAMES)
    page.goto(app.url)
    page.locator(".stage canvas").first.wait_for()
    return page


@pytest.fixture(scope="module")
def track(app):
    with lipdb.open(str(app.database)) as db:
        return db.animate(db.say(EXAMPLE)).track


def say(page, text: str) -> None:
    page.get_by_label("Sentence", exact=True).fill(text)
    page.get_by_label("Sentence", exact=True).press("Enter")


@contextmanager
def going_round(page):
    """Play the line over and over, so that it does not end before a test looks."""
    go_round = "(stage, on) => { stage.lipdb.clock.around = on; }"
    page.locator(".stage").evaluate(go_round, True)
    yield
    page.locator(".stage").evaluate(go_round, False)


def test_the_example_speaks_by_itself_in_step_with_the_sound(front, track) -> None:
    times = np.arange(len(track.weights)) / track.fps
    until(front, "!stage.lipdb.state.playing && Math.abs(stage.lipdb.state.time - argument) < 0.01", times[-1])
    seen = front.evaluate("window.frames_played")
    assert [state for state in seen if 0 < state["time"] < times[-1]]
    for state in seen:
        assert -0.01 <= state["sound"] - state["time"] < 1.5  # what it took to draw the frame, which is long where the processor draws
        for k, pose in enumerate(track.poses):
            assert state["poses"][pose] == pytest.approx(np.interp(state["time"], times, track.weights[:, k]), abs=1e-4)


def test_the_weights_on_the_page_are_those_of_the_track(front, track) -> None:
    for frame in (0, 40, 67, 120, len(track.weights) - 1):
        seek(front, frame / track.fps)
        shown = stage_state(front)
        assert [shown["poses"][pose] for pose in track.poses] == pytest.approx(track.weights[frame].tolist(), abs=1e-5)
        assert shown["faces"][0]["moving"] == len(track.poses)


def test_keys_step_by_frames_and_phones_and_start_and_stop(front, track) -> None:
    seek(front, 1.0)
    lanes = front.locator(".stage .over")
    lanes.focus()
    lanes.press("ArrowRight")
    until(front, "Math.abs(stage.lipdb.clock.time - argument) < 1e-6", 61 / 60)
    lanes.press("Shift+ArrowLeft")
    assert front.locator(".stage").evaluate("stage => stage.lipdb.clock.time") < 61 / 60
    lanes.press("End")
    until(front, "Math.abs(stage.lipdb.clock.time - argument) < 1e-6", (len(track.weights) - 1) / track.fps)
    with going_round(front):
        lanes.press(" ")
        until(front, "stage.lipdb.clock.playing")
        lanes.press(" ")
        assert not stage_state(front)["playing"]
    assert "seconds" in (lanes.get_attribute("aria-valuetext") or "")


def test_slow_motion_sounds_and_takes_four_times_as_long(front) -> None:
    seek(front, 1.0)
    front.get_by_role("button", name="Play at 0.25 of the speed").click()
    front.locator(".stage .play").click()
    reading = "stage.lipdb.clock.time > argument && [performance.now(), stage.lipdb.clock.time, stage.querySelector('audio').paused]"
    began, start, _ = until(front, reading, 1.02)
    ended, end, silent = until(front, reading, start + 0.25)
    assert not silent
    assert (end - start) / ((ended - began) / 1000) == pytest.approx(0.25, abs=0.05)
    front.get_by_role("button", name="Play at 1 of the speed").click()
    at_rest(front)


def test_where_the_browser_lets_nothing_sound_the_face_moves_and_offers_the_sound(front) -> None:
    seek(front, 0.5)
    front.evaluate(
        """() => {
            const { prototype } = HTMLMediaElement;
            window.allowed = prototype.play;
            prototype.play = () => Promise.reject(new DOMException("a click first", "NotAllowedError"));
        }"""
    )
    with going_round(front):
        front.locator(".stage .play").click()
        until(front, "stage.lipdb.state.hushed && stage.lipdb.clock.time > 0.6")
        front.evaluate("() => { HTMLMediaElement.prototype.play = window.allowed; }")
        front.get_by_text("Turn on the sound").click()
        until(front, "!stage.lipdb.state.hushed && !stage.querySelector('audio').paused && stage.querySelector('audio').currentTime > 0.6")
        at_rest(front)


def test_a_stretch_that_is_dragged_loops_and_a_drag_scrubs(front) -> None:
    seek(front, 0.3)  # whatever the test before has left is drawn then, and the lanes stand where they stay
    box = front.locator(".stage .over").bounding_box()
    x, y = box["x"], box["y"]
    front.mouse.move(x + 300, y + 50)
    front.mouse.down()
    front.mouse.move(x + 420, y + 50, steps=3)
    scrubbed = until(front, "stage.lipdb.clock.time")
    front.mouse.up()
    front.mouse.move(x + 300, y + 8)  # on the ruler
    front.mouse.down()
    front.mouse.move(x + 420, y + 8, steps=3)
    front.mouse.up()
    start, end = until(front, "stage.lipdb.clock.loop")
    assert start < end == pytest.approx(scrubbed, abs=0.02)
    seek(front, end - 0.05)
    front.locator(".stage .play").click()
    until(front, "stage.lipdb.clock.playing && stage.lipdb.clock.time < argument", end - 0.1)
    at_rest(front)
    front.get_by_role("button", name="Loop the word here").click()
    until(front, "stage.lipdb.clock.loop === null")


def test_lanes_are_painted_when_they_change_and_not_while_they_play(front) -> None:
    settled(front)
    seek(front, 0)
    painted = stage_state(front)["painted"]
    front.locator(".stage .play").click()
    until(front, "stage.lipdb.state.time > 0.4")
    at_rest(front)
    assert stage_state(front)["painted"] == painted
    lanes = front.locator(".stage .lanes")
    ink = lanes.evaluate("lanes => getComputedStyle(lanes).color")
    front.emulate_media(color_scheme="dark")
    eventually(front, lambda: lanes.evaluate("lanes => getComputedStyle(lanes).color") != ink, "the ink of a dark page")
    until(front, "stage.lipdb.state.painted > argument", painted)
    front.emulate_media(color_scheme="light")


# How bright the letters are: what is written at more than half its strength.
INK = """canvas => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return Math.max(-1, ...data.filter((_, k) => k % 4 === 0 && data[k + 3] > 128));
}"""


def test_the_values_beside_the_lanes_take_the_ink_of_another_theme_while_nothing_plays(front) -> None:
    settled(front)
    seek(front, 0.5)
    values = front.locator(".stage .values")
    eventually(front, lambda: 0 <= values.evaluate(INK) < 100, "values in the dark ink of a light page")
    front.emulate_media(color_scheme="dark")
    eventually(front, lambda: values.evaluate(INK) > 200, "values in the light ink of a dark page")
    front.emulate_media(color_scheme="light")
    eventually(front, lambda: 0 <= values.evaluate(INK) < 100, "values in dark ink again")


def test_a_click_into_the_lanes_explains_the_instant_and_leads_to_its_pair(app, front) -> None:
    lanes = front.locator(".stage .over")
    settled(front)
    box = lanes.bounding_box()
    lanes.click(position={"x": box["width"] * 0.42, "y": 60})
    link = front.get_by_role("link", name=re.compile("Edit .+-.+")).first
    link.wait_for()
    asked = parse_qs(urlparse(link.get_attribute("href")).query)
    assert asked["language"] == ["en"]
    assert asked["character"] == ["robin"]
    assert asked["pair"][0] == link.inner_text().split()[-1]


def test_two_faces_share_the_clock_and_have_lanes_of_their_own(front) -> None:
    front.get_by_label("Beside it", exact=True).click()
    front.get_by_role("option", name="crab").first.click()
    until(front, "stage.lipdb.state.faces.length === 2 && stage.lipdb.state.faces.every(face => face.moving > 0)")
    seek(front, 1.1)
    robin, crab = until(front, "stage.lipdb.state.faces")
    assert robin["shapes"]["open"] > 0.1
    assert set(robin["shapes"]).isdisjoint(crab["shapes"])
    assert front.get_by_role("button", name="Look from: side").is_visible()
    front.get_by_label("Beside it", exact=True).click()
    front.get_by_role("option", name="nobody").click()
    until(front, "stage.lipdb.state.faces.length === 1")


def test_another_sentence_is_heard_and_a_flat_mouth_shows_pictures(front) -> None:
    say(front, "Mama")
    until(front, "stage.lipdb.clock.duration < 2 && stage.lipdb.clock.time > 0")  # it speaks, or has spoken already
    front.get_by_label("Character", exact=True).click()
    front.get_by_role("option", name="flat").click()
    until(front, "stage.lipdb.state.faces[0]?.shown")
    assert stage_state(front)["faces"][0]["shown"] in set("ABCDEFGHX")
    assert not front.get_by_role("button", name="Look from: side").is_visible()


def test_nonsense_is_answered_with_what_to_do(front) -> None:
    say(front, "你好")
    message = front.get_by_test_id("stAlert")
    message.wait_for()
    assert "give the language of the text" in message.inner_text()


GRID = """File type = "ooTextFile"
Object class = "TextGrid"

0
1
<exists>
1
"IntervalTier"
"phones"
0
1
2
0
0.5
"m"
0.5
1
"A"
"""


def upload(page, place: int, name: str, content: bytes) -> None:
    box = page.get_by_test_id("stFileUploader").nth(place).locator("input[type=file]")
    box.set_input_files({"name": name, "mimeType": "application/octet-stream", "buffer": content})


def test_files_that_are_not_what_they_seem_are_answered_in_a_line(front) -> None:
    settled(front)
    front.get_by_text("Recording", exact=True).click()
    front.get_by_test_id("stFileUploader").nth(1).wait_for()
    cases = [
        ("shopping.TextGrid", b"milk, eggs", "not a Praat text file"),
        ("cut.TextGrid", GRID[:60].encode(), "it is cut off"),
        ("line.json", b"[1, 2", "not JSON in UTF-8"),
    ]
    for name, content, answer in cases:
        upload(front, 0, name, content)
        message = front.get_by_test_id("stAlert").filter(has_text=answer)
        message.wait_for()
        settled(front)
        assert len(message.get_by_role("paragraph").all()) == 1


def test_a_recording_with_its_phones_is_spoken(front, track) -> None:
    upload(front, 0, "take 7.TextGrid", GRID.encode())
    until(front, "stage.lipdb.clock.duration > 0 && stage.lipdb.state.faces.length === 1")
    upload(front, 1, "take 7.wav", b"RIFF, says who?")
    front.get_by_test_id("stAlert").filter(has_text="the recording: not a PCM wave file").wait_for()


def test_nothing_is_asked_of_the_internet(app, front, requests) -> None:
    hosts = {urlparse(url).netloc for url in requests if urlparse(url).scheme in ("http", "https")}
    assert hosts == {urlparse(app.url).netloc}
