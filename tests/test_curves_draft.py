"""A pair as an editor sees it: its curves in one layer, what is below, what saving changes, and how it plays alone."""

import pytest

from lipdb.curated.folder import read_folder
from lipdb.curves.curve import Curve
from lipdb.curves.draft import Draft, Place, overriding
from lipdb.curves.keys import format_keys
from lipdb.curves.lookup import CurveBook
from lipdb.curves.rehearse import PAUSE, REACH, USUAL, Rehearsal, occurrences, usual_lengths
from lipdb.decisions import pair_uses
from lipdb.errors import CurveError, InputError
from lipdb.paths import data_dir
from lipdb.poses import PoseSet
from lipdb.schedule import Phone, Schedule

PEAK = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))


@pytest.fixture(scope="module")
def records():
    return read_folder(data_dir("phonesets"))


def place(kind="common", pair=("l", "ow"), pose_set="facefx", character="robin") -> Place:
    return Place(*pair, pose_set, "en", character, kind)


def with_rows(records, table, curves):
    rows = {key: {**curve.row(key), "author": "anna"} for key, curve in curves.items()}
    return {**records, table: {**records.get(table, {}), **rows}}


def test_the_common_layer_has_its_own_curves_and_generated_ones_below(records) -> None:
    draft = Draft.load(records, place())
    assert list(draft.lanes) == list(PoseSet.from_records(records, "facefx").poses)
    assert all(lane.own is not None and lane.below.layer == "generated" for lane in draft.lanes.values())
    assert not draft.changed(draft.curves)
    assert draft.rows(draft.curves) == {}


@pytest.mark.parametrize(
    ("kind", "table"), [("language", "en/curves/facefx.tsv"), ("character", "characters/robin/curves/facefx.tsv")]
)  # fmt: skip
def test_a_more_specific_layer_begins_with_what_is_below_it(records, kind, table) -> None:
    draft = Draft.load(records, place(kind))
    common = Draft.load(records, place())
    assert draft.place.table == table
    assert all(lane.own is None and lane.below.layer == "common" for lane in draft.lanes.values())
    assert [lane.keys for lane in draft.lanes.values()] == [lane.keys for lane in common.lanes.values()]


def test_one_edited_pose_is_one_row(records) -> None:
    draft = Draft.load(records, place("language"))
    rows = draft.rows({**draft.curves, "W": PEAK})
    assert list(rows) == [("l", "ow", "W")]
    assert rows["l", "ow", "W"]["keys"] == "0:0 0.5:1 1:0"
    assert rows["l", "ow", "W"]["origin"] == ""  # the store signs it


def test_no_keys_mean_zero_and_none_means_the_layer_below(records) -> None:
    draft = Draft.load(records, place())
    rows = draft.rows({**draft.curves, "W": (), "tRoof": None})
    assert rows["l", "ow", "W"]["keys"] == ""
    assert rows["l", "ow", "tRoof"] is None
    book = CurveBook.from_records(draft.applied(records, {**draft.curves, "W": (), "tRoof": None}), "facefx")
    assert (book.find("l", "ow", "W").layer, book.find("l", "ow", "W").curve.keys) == ("common", ())
    assert book.find("l", "ow", "tRoof").layer == "generated"


def test_an_edit_keeps_the_comment_and_the_warp_of_its_row(records) -> None:
    own = Curve(PEAK, "linear", "imported", "smith", "MIT", "bob", "2026-01-01T00:00:00Z", "traced")
    there = with_rows(records, "en/curves/facefx.tsv", {("l", "ow", "W"): own})
    draft = Draft.load(there, place("language"))
    assert draft.lanes["W"].own == Curve(PEAK, "linear", "imported", "smith", "MIT", "anna", "2026-01-01T00:00:00Z", "traced")
    row = draft.rows({**draft.curves, "W": ((0.0, 0.5),)})["l", "ow", "W"]
    assert (row["keys"], row["warp"], row["comment"]) == ("0:0.5", "linear", "traced")
    above = Draft.load(there, place("character"))
    assert above.rows({**above.curves, "W": PEAK[:2]})["l", "ow", "W"]["warp"] == "linear"


def test_a_curve_that_a_more_specific_layer_hides_is_said_so(records) -> None:
    there = with_rows(records, "characters/robin/curves/facefx.tsv", {("l", "ow", "W"): Curve(PEAK)})
    there = with_rows(there, "de/curves/facefx.tsv", {("l", "ow", "open"): Curve(PEAK)})
    draft = Draft.load(there, place())
    assert {pose: lane.hidden for pose, lane in draft.lanes.items() if lane.hidden} == {"W": "character:robin"}
    assert overriding(there, place()) == ["character:robin", "language:de"]
    assert overriding(there, place("language")) == ["character:robin"]
    assert overriding(there, place("character")) == []
    assert Draft.load(there, place("character")).lanes["W"].hidden == ""


def test_a_pair_that_comes_through_links_is_saved_as_a_whole(records) -> None:
    crab = place("character", ("l", "eh"), "crab", "crab")
    draft = Draft.load(records, crab)
    assert draft.whole
    curves = {**draft.curves, "smile": PEAK}
    rows = draft.rows(curves)
    assert sorted(rows) == sorted(crab.key(pose) for pose in draft.lanes)
    before, after = crab.book(records), crab.book(draft.applied(records, curves))
    others = [pose for pose in draft.lanes if pose != "smile"]
    assert [after.find(*crab.key(pose)).curve.keys for pose in others] == [before.find(*crab.key(pose)).curve.keys for pose in others]
    assert after.find(*crab.key("smile")).curve.keys == PEAK
    saved = Draft.load(draft.applied(records, curves), crab)
    reset = saved.rows(dict.fromkeys(saved.lanes))
    assert set(reset.values()) == {None}
    assert len(reset) == len(draft.lanes)


def test_a_pair_that_has_curves_of_its_own_is_saved_pose_by_pose(records) -> None:
    draft = Draft.load(records, place("language", ("l", "ow"), "crab", "crab"))
    assert draft.whole
    below = with_rows(records, "curves/crab.tsv", {("l", "ow", "smile"): Curve(PEAK)})
    draft = Draft.load(below, place("character", ("l", "ow"), "crab", "crab"))
    assert not draft.whole
    assert list(draft.rows({**draft.curves, "smile": PEAK})) == [("l", "ow", "smile")]


def test_a_pair_that_is_accepted_is_work_for_nobody_any_more(records) -> None:
    for where in (place(), place("language"), place("character", ("l", "eh"), "crab", "crab")):
        draft = Draft.load(records, where)
        moving = [pose for pose, lane in draft.lanes.items() if lane.keys]
        assert draft.unfinished(draft.curves) == moving
        rows = draft.accepted(draft.curves)
        assert {key[2] for key in rows} == set(draft.lanes if draft.whole else moving)
        signed = {key: {**row, "origin": "authored"} for key, row in rows.items() if row}
        after = {**records, where.table: {**records.get(where.table, {}), **signed}}
        [before], [use] = (pair_uses(where.book(now), [((where.left, where.right), 1.0)]) for now in (records, after))
        assert (before.gap, use.gap) == (True, False)
        assert {pose: found.curve.keys for pose, found in use.curves.items()} == {
            pose: found.curve.keys for pose, found in before.curves.items()
        }
        assert {row["source"] for row in signed.values()} == {found.curve.source for found in before.curves.values()}
        assert Draft.load(after, where).unfinished(Draft.load(after, where).curves) == []


def test_what_is_drawn_and_not_saved_is_drawn_when_the_pair_is_accepted(records) -> None:
    draft = Draft.load(records, place())
    curves = {**draft.curves, "W": PEAK}
    assert "W" not in draft.unfinished(curves)
    assert draft.accepted(curves)["l", "ow", "W"]["keys"] == "0:0 0.5:1 1:0"


def test_what_an_editor_sends_is_checked(records) -> None:
    draft = Draft.load(records, place())
    assert draft.read({"W": [[0, 0], [0.33333, 1]], "open": None})["W"] == ((0.0, 0.0), (0.333, 1.0))
    assert draft.read({"open": None})["open"] is None
    for wrong in ([[0.5, 0], [0.2, 0]], [[0, 2]], [["a", 0]], [[0, float("nan")]], 7, [[0]]):
        with pytest.raises(CurveError):
            draft.read({"W": wrong})
    with pytest.raises(CurveError, match="has no pose 'smirk'"):
        draft.read({"smirk": []})


@pytest.mark.parametrize(("pair", "keys", "what"), [(("_", "l"), [[0, 0.5]], "begins with"), (("l", "_"), [[0, 0.5]], "ends with")])
def test_curves_next_to_silence_are_at_rest_in_it(records, pair, keys, what) -> None:
    with pytest.raises(CurveError, match=what):
        Draft.load(records, place(pair=pair)).read({"W": keys})


def test_places_that_cannot_be_are_refused(records) -> None:
    with pytest.raises(InputError, match="two silences"):
        place(pair=("_", "_"))
    with pytest.raises(InputError, match="no layer"):
        place("line")
    with pytest.raises(InputError, match="no common phone 'q'"):
        Draft.load(records, place(pair=("q", "ow")))


def test_a_rehearsal_plays_the_pair_between_silences() -> None:
    loop = Rehearsal.of("l", "ow", (0.06, 0.12))
    assert loop.schedule.common()[1] == ("_", "l", "ow", "_")
    assert (loop.start, loop.border, loop.end) == pytest.approx((PAUSE, PAUSE + 0.06, PAUSE + 0.18))
    out = Rehearsal.of("_", "l", (9.0, 0.1))
    assert out.schedule.common()[1] == ("_", "l", "_")
    assert (out.start, out.border, out.end) == pytest.approx((PAUSE - REACH, PAUSE, PAUSE + 0.1))
    into = Rehearsal.of("l", "_", (0.1, 9.0))
    assert (into.start, into.border, into.end) == pytest.approx((PAUSE, PAUSE + 0.1, PAUSE + 0.1 + REACH))


def test_what_is_drawn_is_what_the_engine_makes_of_the_pair_alone(records) -> None:
    pose_set, book = PoseSet.from_records(records, "facefx"), CurveBook.from_records(records, "facefx")
    drawn = Rehearsal.of("bmp", "ah", (0.08, 0.12)).drawn(book, pose_set)
    assert list(drawn) == list(pose_set.poses)
    assert max(weight for _, weight in drawn["PBM"]) > 0.98 * book.find("bmp", "ah", "PBM").curve.peak
    assert max(weight for _, weight in drawn["open"]) <= 0.5 + 1e-9  # lips hold the jaw
    assert drawn["tTeeth"] and not any(weight for _, weight in drawn["tTeeth"])
    times = [time for time, _ in drawn["open"]]
    assert (times, times[0], times[-1]) == (sorted(times), 0, 1)


def test_the_border_is_drawn_in_the_middle_however_unequal_the_phones(records) -> None:
    pose_set = PoseSet.from_records(records, "facefx")
    steps = {("f", "ah", "open"): Curve(((0.5, 0.4), (1.0, 0.4)))}
    book = CurveBook.from_records(records, "facefx", line=steps)
    for lengths in ((0.1, 0.4), (0.4, 0.1)):
        drawn = Rehearsal.of("f", "ah", lengths).drawn(book, pose_set)["open"]
        assert max(w for t, w in drawn if t < 0.3) < 0.05
        assert max(w for t, w in drawn if t > 0.6) > 0.3


def test_playing_the_loop_hears_its_neighbours_too(records) -> None:
    pose_set, book = PoseSet.from_records(records, "facefx"), CurveBook.from_records(records, "facefx")
    loop = Rehearsal.of("l", "ow", (0.06, 0.12))
    track = loop.play(book, pose_set)
    assert len(track.weights) == round(loop.duration * 60) + 1
    assert track.weights[0].max() == track.weights[-1].max() == 0


def spoken(*phones: tuple[str, int]) -> Schedule:
    edges = [0]
    for _, length in phones:
        edges.append(edges[-1] + length * 1000)
    return Schedule(tuple(edges), tuple(Phone(name, (name,)) for name, _ in phones))


def test_where_a_pair_stands_and_how_long_its_phones_last() -> None:
    schedule = spoken(("l", 60), ("ow", 100), ("_", 900), ("l", 80), ("ow", 140))
    places = {
        ("l", "ow"): [(0.0, 0.06, 0.16), (1.06, 1.14, 1.28)],
        ("_", "l"): [(-0.25, 0.0, 0.06), (0.81, 1.06, 1.14)],
        ("ow", "_"): [(0.06, 0.16, 0.41), (1.14, 1.28, 1.53)],
    }
    for pair, times in places.items():
        assert [tuple(round(time, 6) for time in place) for place in occurrences(schedule, *pair)] == times
    assert usual_lengths([schedule], "l", "ow") == (0.07, 0.12)
    assert usual_lengths([schedule], "_", "l") == (REACH, 0.07)
    assert usual_lengths([], "z", "ow") == (USUAL, USUAL)


def test_keys_are_those_of_the_text(records) -> None:
    draft = Draft.load(records, place())
    row = records["curves/facefx.tsv"]["l", "ow", "W"]
    assert format_keys(draft.lanes["W"].keys) == row["keys"]
