"""What the shipped curves do in the engine and on Robin's face: lips close on p b m, meet the teeth on f, and open between."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb import engine
from lipdb.characters.human import robin
from lipdb.characters.mouth import measure
from lipdb.curated.folder import read_folder
from lipdb.curves.lookup import CurveBook
from lipdb.poses import PoseSet

SHIPPED = read_folder(Path(__file__).parent.parent / "phonesets")
POSES = PoseSet.from_records(SHIPPED, "facefx")
BOOK = CurveBook.from_records(SHIPPED, "facefx")
PHONES = [phone for (phone,) in SHIPPED["common.tsv"]]
SOUNDS = [phone for phone in PHONES if phone != "_"]
VOWELS = [phone for (phone,), row in SHIPPED["common.tsv"].items() if row["kind"] == "vowel"]
TABLE = BOOK.table(PHONES)
CLOSES = {"bmp": "PBM", "f": "FV"}
RATES = [24, 25, 30, 60]


def play(phones, milliseconds, *, fps):
    edges = np.concatenate(([0], np.cumsum(np.array(milliseconds) * 1000))).tolist()
    return edges, engine.animate(TABLE, POSES, edges, phones, fps=fps)


def within(track, start, end):
    """Frames from *start* to *end* microseconds, half a frame more on each side."""
    half = 0.5 / track.fps
    return (track.times >= start / 1e6 - half) & (track.times <= end / 1e6 + half)


def opening(track):
    return measure(robin(), track.weights, track.poses)[0]


TIMED = st.lists(st.tuples(st.sampled_from(SOUNDS), st.integers(60, 250)), min_size=1, max_size=12)


@given(TIMED, st.sampled_from(RATES))
def test_every_closure_of_60_ms_or_more_reaches_its_authored_peak(timed, fps):
    phones, lengths = ["_", *(phone for phone, _ in timed), "_"], [300, *(length for _, length in timed), 300]
    edges, track = play(phones, lengths, fps=fps)
    for n, phone in enumerate(phones):
        if phone in CLOSES:
            pose = CLOSES[phone]
            authored = max(BOOK.find(*pair, pose).curve.peak for pair in ((phones[n - 1], phone), (phone, phones[n + 1])))
            assert authored >= 0.9
            assert track.pose(pose)[within(track, edges[n], edges[n + 1])].max() >= 0.98 * authored


@given(TIMED, st.sampled_from(RATES))
def test_robins_lips_meet_at_every_closure(timed, fps):
    phones, lengths = ["_", "aa", *(phone for phone, _ in timed), "_"], [300, 150, *(length for _, length in timed), 300]
    edges, track = play(phones, lengths, fps=fps)
    gap = opening(track)
    for n, phone in enumerate(phones):
        if phone == "bmp":
            assert gap[within(track, edges[n], edges[n + 1])].min() < 0.05 * gap.max()


BETWEEN = st.lists(st.tuples(st.sampled_from(["aa", "ah", "ao", "eh", "ih", "ay"]), st.integers(0, 170)), min_size=1, max_size=3)
SHORTEST = {60: (60, 80), 30: (80, 80), 25: (80, 100), 24: (80, 100)}
"""The shortest closure and vowel by frame rate: at 24 frames a second, two frames are as long as a short vowel."""


@given(BETWEEN, st.integers(0, 80), st.sampled_from(RATES))
def test_lips_open_between_closures(vowels, longer, fps):
    """Bob, baby, mama, papa: each vowel opens more than a quarter of the line's widest."""
    closure, vowel = SHORTEST[fps]
    phones, lengths = ["_", "bmp"], [300, closure + longer]
    for name, more in vowels:
        phones += [name, "bmp"]
        lengths += [vowel + more, closure + longer]
    edges, track = play([*phones, "_"], [*lengths, 300], fps=fps)
    gap = opening(track)
    for n, phone in enumerate(phones):
        if phone in VOWELS:
            assert gap[within(track, edges[n], edges[n + 1])].max() > 0.25 * gap.max()


WORDS = {
    "Bob": ["bmp", "aa", "bmp"],
    "baby": ["bmp", "eh", "bmp", "ih"],
    "mama": ["bmp", "aa", "bmp", "ah"],
    "papa": ["bmp", "ah", "bmp", "ah"],
}


@pytest.mark.parametrize("word", WORDS)
@pytest.mark.parametrize("longer", [0, 40, 120])
@pytest.mark.parametrize("fps", RATES)
def test_the_words_of_the_design_open_between_their_closures(word, longer, fps):
    phones, (closure, vowel) = ["_", *WORDS[word], "_"], SHORTEST[fps]
    edges, track = play(phones, [{"_": 300, "bmp": closure}.get(p, vowel + longer) for p in phones], fps=fps)
    gap = opening(track)
    for n, phone in enumerate(phones):
        inside = gap[within(track, edges[n], edges[n + 1])]
        if phone in VOWELS:
            assert inside.max() > 0.25 * gap.max()
        elif phone == "bmp":
            assert inside.min() < 0.05 * gap.max()


def test_vowels_open_as_wide_as_they_sound():
    def widest(vowel):
        return opening(play(["_", "d", vowel, "d", "_"], [300, 80, 160, 80, 300], fps=60)[1]).max()

    assert min(widest("aa"), widest("eh"), widest("ay")) > widest("ih") > widest("er") > widest("w")


def test_the_open_pose_peaks_where_the_constraints_let_it():
    for vowel in ("aa", "ah", "ay", "aw", "eh"):
        peak = play(["_", "d", vowel, "d", "_"], [300, 80, 160, 80, 300], fps=60)[1].pose("open").max()
        assert 0.2 <= peak <= 0.5, vowel


@pytest.mark.parametrize(("phone", "pose"), [("d", "tRoof"), ("l", "tRoof"), ("th", "tTeeth"), ("kg", "tBack")])
def test_the_tongue_reaches_for_its_consonants(phone, pose):
    track = play(["_", "ah", phone, "ah", "_"], [300, 120, 90, 120, 300], fps=60)[1]
    assert track.pose(pose).max() >= 0.7


def test_the_mouth_is_rounder_for_who_than_for_he():
    def width(vowel):
        edges, track = play(["_", "h", vowel, "_"], [300, 80, 200, 300], fps=60)
        return measure(robin(), track.weights, track.poses)[1][within(track, edges[2], edges[3])].min()

    assert width("w") < 0.8 * width("ih")


@given(TIMED)
def test_nothing_pops_between_frames(timed):
    """At 60 frames a second no weight moves faster than the pose set lets it, and the lips not by half their range."""
    phones, lengths = ["_", *(phone for phone, _ in timed), "_"], [300, *(length for _, length in timed), 300]
    track = play(phones, lengths, fps=60)[1]
    assert np.abs(np.diff(track.weights, axis=0)).max() <= 15 / 60 + 1e-9
    assert np.abs(np.diff(opening(track))).max() <= 0.5 * 0.28
