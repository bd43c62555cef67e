"""The main job: a sentence becomes sound, a schedule, a track and a moving face, in both languages on every face."""

import json
import threading
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

import lipdb
from lipdb.curves.curve import Curve
from lipdb.errors import InputError, UnknownSymbolError

ENGLISH = "Hello world! My little crab can finally speak."
MANDARIN = "你好，世界！小螃蟹会说话了。"


@pytest.mark.parametrize("character", ["robin", "crab", "flat"])
@pytest.mark.parametrize(("language", "text"), [("en", ENGLISH), ("cmn", MANDARIN)])
def test_a_sentence_moves_a_face_in_time_with_its_sound(db: lipdb.Database, language: str, text: str, character: str) -> None:
    line = db.say(text, language=language)
    take = db.animate(line, character=character, fps=60)
    assert line.sound is not None
    assert line.sound.duration == pytest.approx(line.schedule.duration, abs=0.05)
    assert len(take.track.weights) == pytest.approx(line.schedule.duration * 60, abs=2)
    assert take.track.poses == db.pose_set(take.character.pose_set).poses
    assert 0.3 < take.track.weights.max() <= 1
    assert take.shapes.weights.max() > 0.3
    assert take.track.weights[0].max() == take.track.weights[-1].max() == 0


def test_the_same_text_gives_the_same_line_and_the_same_track(db: lipdb.Database) -> None:
    first, second = db.say(ENGLISH), db.say(ENGLISH)
    assert first.schedule == second.schedule
    assert first.sound is not None
    assert second.sound is not None
    assert first.sound.samples.tobytes() == second.sound.samples.tobytes()
    assert db.animate(first).track.weights.tobytes() == db.animate(second).track.weights.tobytes()


def test_lips_close_on_every_p_b_and_m(db: lipdb.Database) -> None:
    line = db.say("Bob, mama and papa pick a big map.")
    track = db.animate(line).track
    closed = track.pose("PBM")
    spoken = zip(line.schedule.phones, pairwise(line.schedule.edges), strict=True)
    spans = [span for phone, span in spoken if phone.common == ("bmp",) and span[1] - span[0] >= 60_000]
    assert len(spans) >= 8
    for start, end in spans:
        inside = (track.times >= start / 1e6 - 1 / 120) & (track.times <= end / 1e6 + 1 / 120)
        assert closed[inside].max() >= 0.88, start


def test_a_line_comes_back_from_its_json_and_moves_alike(db: lipdb.Database, tmp_path: Path) -> None:
    take = db.animate(db.say(ENGLISH))
    take.save(tmp_path / "hello.json")
    again = db.animate(db.sync(tmp_path / "hello.json"))
    assert np.array_equal(again.track.weights, take.track.weights)


def test_the_lines_own_layer_wins_over_every_other(db: lipdb.Database, tmp_path: Path) -> None:
    line = db.say("Hello")
    mine = Curve(((0.0, 0.0), (0.5, 0.875), (1.0, 0.0)))
    edited = replace(line, curves={"facefx": {("h", "ah", "ShCh"): mine}}, mapping={"oU": ("aa",)})
    take = db.animate(edited)
    assert take.track.pose("ShCh").max() > db.animate(line).track.pose("ShCh").max() + 0.2
    use = next(use for use in db.pairs(edited) if (use.left, use.right) == ("h", "ah"))
    assert use.curves["ShCh"].layer == "line"
    assert any(use.right == "aa" for use in db.pairs(edited))
    take.save(tmp_path / "edited.json")
    assert json.loads((tmp_path / "edited.json").read_text("utf-8"))["line"]["mapping"] == {"oU": "aa"}
    assert np.array_equal(db.animate(db.sync(tmp_path / "edited.json")).track.weights, take.track.weights)


def test_an_edit_for_one_character_leaves_the_others_alone(own: lipdb.Database) -> None:
    line = own.say("Hello")
    before = {name: own.animate(line, character=name).track.weights for name in ("robin", "crab")}
    row = {"left": "ah", "right": "l", "pose": "mouth_open", "keys": "0:0 0.5:1 1:0", "warp": "border", "origin": "authored"}
    with own.edit(author="ann", note="wider") as edit:
        edit.put("characters/crab/curves/crab.tsv", {**row, "source": "user", "licence": "Apache-2.0", "comment": ""})
    assert not np.array_equal(own.animate(line, character="crab").track.weights, before["crab"])
    assert np.array_equal(own.animate(line, character="robin").track.weights, before["robin"])
    found = next(use for use in own.pairs(line, character="crab") if (use.left, use.right) == ("ah", "l")).curves["mouth_open"]
    assert found.layer == "character:crab"
    assert found.curve.author == "ann"
    own.store.undo(own.store.revision, author="ann")
    assert np.array_equal(own.animate(line, character="crab").track.weights, before["crab"])


def test_a_database_as_it_stood_plays_what_it_held_then(own: lipdb.Database) -> None:
    line = own.say("Hello")
    before, revision = own.animate(line).track.weights, own.store.revision
    with own.edit(author="ann") as edit:
        edit.put("curves/facefx.tsv", {**own.records["curves/facefx.tsv"]["ah", "l", "open"], "keys": "0:0 0.5:1 1:0"})
    assert not np.array_equal(own.animate(line).track.weights, before)
    assert np.array_equal(own.at(revision).animate(line).track.weights, before)
    assert own.at(0).languages() == []


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda db: db.say("", language="en"), "empty|no text|nothing"),
        (lambda db: db.say("Привет, мир", language="en"), "script|letters"),
        (lambda db: db.say("hello", language="eng"), "did you mean 'en'"),
        (lambda db: db.animate(db.say("hello"), character="robyn"), "did you mean 'robin'"),
        (lambda db: db.animate(db.say("hello")).save("hello.xyz"), r"\.mp4"),
        (lambda db: db.sync("missing.TextGrid"), "no such file"),
        (lambda db: db.sync("movie.avi"), "textgrid"),
    ],
)
def test_a_mistake_is_one_line_that_says_what_to_do(db: lipdb.Database, call: object, complaint: str) -> None:
    with pytest.raises(InputError, match=f"(?i){complaint}") as error:
        call(db)  # type: ignore[operator]
    assert "\n" not in str(error.value)


def test_an_unknown_symbol_stops_the_line_unless_it_may_be_mapped_by_articulation(db: lipdb.Database, tmp_path: Path) -> None:
    grid = tmp_path / "a.TextGrid"
    grid.write_text(
        'File type = "ooTextFile"\nObject class = "TextGrid"\n\n0\n1\n<exists>\n1\n"IntervalTier"\n"phones"\n0\n1\n2\n'
        '0\n0.5\n"m"\n0.5\n1\n"ʛ"\n',
        "utf-8",
    )
    with pytest.raises(UnknownSymbolError, match="'ʛ'.*1x"):
        db.sync(grid)
    line = db.sync(grid, allow_unknown=True)
    assert [phone.common for phone in line.schedule.phones] == [("bmp",), ("kg",)]


def test_threads_may_share_a_database(db: lipdb.Database) -> None:
    tracks: list[bytes] = []
    threads = [threading.Thread(target=lambda: tracks.append(db.animate(db.say(ENGLISH)).track.weights.tobytes())) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(tracks) == 4
    assert len(set(tracks)) == 1
