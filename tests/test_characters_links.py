"""Characters from curated tables, and the links from poses to their own shapes."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lipdb.characters.character import Character
from lipdb.characters.links import closing_shapes, identity_links, through_links
from lipdb.characters.own_links import bend_drawn
from lipdb.curated.folder import read_folder
from lipdb.curated.schema import table_of
from lipdb.curated.tsv import canonical_row
from lipdb.curves.curve import Curve
from lipdb.curves.through import Link, carried
from lipdb.errors import InputError, MeshError, PhonesetError
from lipdb.track import Track

POSES = ("open", "W", "PBM")
SOURCED = {"source": "lipdb", "comment": ""}


def track(*rows):
    return Track(np.array(rows, float), POSES, 60.0)


def link(pose, shape, gain=1.0, combine="sum", curve=()):
    return Link(pose, shape, gain, combine, curve)


def records(own=(), shared=(), **row):
    poses = {(p,): pose_row(p, i) for i, p in enumerate(POSES)}
    character = {"character": "ann", "pose_set": "face", "shapes": "", "drawing": "built:robin", "title": "Ann", **SOURCED, **row}
    return {
        "poses/sets.tsv": {("face",): {"pose_set": "face", "window": "0.18", "threshold": "2", "title": "", **SOURCED}},
        "poses/face.tsv": poses,
        "characters/ann/character.tsv": {("ann",): character},
        "characters/ann/links.tsv": {(r["pose"], r["shape"]): r for r in own},
        "links/face/other.tsv": {(r["pose"], r["shape"]): r for r in shared},
    }


def pose_row(pose, position):
    must = "yes" if pose == "PBM" else "no"
    return {"pose": pose, "position": str(position), "priority": "", "speed": "15", "must_reach": must, "description": "", **SOURCED}


def row(pose, shape, gain="1", combine="sum", curve=""):
    return {"pose": pose, "shape": shape, "gain": gain, "combine": combine, "curve": curve, **SOURCED}


@pytest.fixture(scope="module")
def shipped():
    return read_folder(Path(__file__).parent.parent / "phonesets")


def test_gains_add_up_and_stay_within_0_and_1():
    shapes = through_links(track([0.5, 0.4, 0], [1, 1, 0]), [link("open", "jaw", 0.8), link("W", "jaw", 0.5), link("W", "pucker", -1)])
    assert shapes.poses == ("jaw", "pucker")
    assert np.allclose(shapes.weights, [[0.6, 0], [1, 0]])
    assert shapes.fps == 60


def test_of_links_that_take_the_largest_the_largest_counts_against_the_sum():
    links = [link("open", "jaw", 0.5), link("W", "jaw", 0.25), link("PBM", "jaw", 0.9, "max")]
    assert np.allclose(through_links(track([1, 1, 0], [1, 1, 1]), links).weights[:, 0], [0.75, 0.9])


def test_a_curve_bends_the_weight_before_the_gain_and_holds_its_ends():
    bend = ((0.2, 0.0), (0.6, 1.0), (0.8, 0.5))
    shapes = through_links(track([0.1, 0, 0], [0.4, 0, 0], [0.7, 0, 0], [1, 0, 0]), [link("open", "D", 0.5, curve=bend)])
    assert np.allclose(shapes.weights[:, 0], [0, 0.25, 0.375, 0.25])


def test_a_pose_that_the_track_lacks_weighs_nothing():
    assert through_links(track([1, 1, 1]), [link("smile", "grin")]).weights.tolist() == [[0]]


@given(arrays(float, (7, 3), elements=st.floats(0, 1)))
def test_links_to_poses_of_their_own_name_change_nothing(weights):
    shapes = through_links(Track(weights, POSES, 30.0), identity_links(POSES))
    assert shapes.poses == POSES
    assert (shapes.weights == weights).all()


LINKS = st.builds(
    Link, st.sampled_from(POSES), st.just("jaw"), st.floats(-1, 1).map(lambda g: round(g, 2)), st.sampled_from(["sum", "max"]),
    st.sampled_from([(), ((0.0, 0.0), (0.5, 1.0), (1.0, 0.5))]),
)  # fmt: skip


@given(arrays(float, (9, 3), elements=st.floats(0, 1)), st.lists(LINKS, max_size=5))
def test_shapes_stay_within_0_and_1_whatever_the_links(weights, links):
    shapes = through_links(Track(weights, POSES, 30.0), links).weights
    assert ((shapes >= 0) & (shapes <= 1)).all()


@given(st.lists(LINKS, min_size=1, max_size=4), st.lists(st.integers(0, 10), min_size=9, max_size=9))
def test_weights_go_through_links_as_curves_do(links, tenths):
    """A curve carried over to a set, and a track sent through the links, meet at the curve's keys."""
    times = (0.0, 0.5, 1.0)
    values = np.array(tenths).reshape(3, 3) / 10
    curves = {pose: Curve(tuple(zip(times, values[:, i].tolist(), strict=True))) for i, pose in enumerate(POSES)}
    keys = carried(links, curves).keys
    expected = through_links(Track(values, POSES, 1.0), links).weights[:, 0]
    at = np.interp(times, [t for t, _ in keys], [w for _, w in keys]) if keys else np.zeros(3)
    assert np.allclose(at, expected, atol=2e-3)


def test_shapes_that_a_must_reach_pose_drives_close_the_mouth():
    links = [link("PBM", "lips", 0.9), link("PBM", "cheek", 0.2), link("open", "jaw")]
    assert closing_shapes(links, ["PBM"]) == ("lips",)


def test_a_character_has_the_shared_links_of_its_set_and_its_own_on_top():
    shared = [row("open", "jaw", "0.7"), row("W", "pucker"), row("PBM", "press")]
    own = [row("open", "jaw", "1"), row("W", "pucker", "0"), row("W", "funnel")]
    ann = Character.from_records(records(own, shared, shapes="other"), "ann")
    assert [(x.pose, x.shape, x.gain) for x in ann.links] == [("open", "jaw", 1), ("W", "funnel", 1), ("PBM", "press", 1)]
    assert ann.closures == ("press",)
    assert (ann.name, ann.title, ann.pose_set, ann.drawing) == ("ann", "Ann", "face", "built:robin")


def test_a_character_of_the_pose_sets_own_shapes_has_them_one_to_one():
    ann = Character.from_records(records(shapes="face"), "ann")
    weights = track([0.1, 0.2, 0.3])
    assert (ann.shapes(weights).weights == weights.weights).all()
    assert ann.closures == ("PBM",)


@pytest.mark.parametrize(
    ("name", "changes", "error", "message"),
    [
        ("bob", {}, InputError, "there is no character 'bob'; there are ann"),
        ("../ann", {}, InputError, "there is no character '../ann'"),
        ("ann", {}, PhonesetError, "no links to its shapes"),
        ("ann", {"shapes": "none_such"}, PhonesetError, "there is no links/face/none_such.tsv"),
        ("ann", {"shapes": "face", "pose_set": "body"}, PhonesetError, "pose set 'body'"),
    ],
)
def test_a_character_that_can_not_be_is_refused(name, changes, error, message):
    with pytest.raises(error, match=message):
        Character.from_records(records(**changes), name)


@pytest.mark.parametrize(
    ("drawing", "message"),
    [
        ("built:dragon", "no such face comes with lipdb; there are crab, flat, robin"),
        ("mesh.glb", "mesh.glb is missing; copy it from where"),
    ],
)
def test_a_drawing_that_is_not_there_is_named(tmp_path, drawing, message):
    ann = Character.from_records(records(shapes="face", drawing=drawing), "ann", folder=tmp_path)
    with pytest.raises(MeshError, match=message):
        _ = ann.mesh


@pytest.mark.parametrize("drawing", ["foo", "built:", "built:../robin", "../mesh.glb", "pictures/x"])
def test_a_character_that_draws_nothing_is_refused_in_its_row(drawing):
    table = table_of("characters/ann/character.tsv")
    row = {"character": "ann", "pose_set": "face", "drawing": drawing, "title": "Ann", "source": "user"}
    with pytest.raises(ValueError, match="is nothing to draw; write built:NAME, mesh.glb or pictures"):
        canonical_row(table, row)


def test_the_shipped_characters_have_meshes_with_all_the_shapes_their_links_lead_to(shipped):
    for name in ("robin", "crab"):
        who = Character.from_records(shipped, name)
        assert {x.shape for x in who.links} <= set(who.mesh.shape_names)
        assert who.pictures == {}
        assert who.closures[0] in {"PBM", "lips_press"}


def test_the_flat_mouth_has_a_picture_for_every_shape_its_links_lead_to(shipped):
    flat = Character.from_records(shipped, "flat")
    assert flat.mesh is None
    assert set(flat.pictures) == set("ABCDEFGHX")
    assert {x.shape for x in flat.links} <= set(flat.pictures)
    assert set(flat.closures) == {"A", "G"}


def test_the_flat_mouths_drawings_are_plain_svg_that_refers_to_nothing(shipped):
    for file in Character.from_records(shipped, "flat").pictures.values():
        text = file.read_text("utf-8")
        assert text.startswith('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 240 180">')
        assert "href" not in text
        assert "<script" not in text


def test_pressed_lips_win_on_the_flat_mouth(shipped):
    flat = Character.from_records(shipped, "flat")
    poses = ("open", "W", "ShCh", "PBM", "FV", "wide", "tRoof", "tTeeth", "tBack")
    weights = np.zeros((2, 9))
    weights[0, poses.index("PBM")], weights[0, poses.index("W")] = 0.96, 0.5
    weights[1, poses.index("FV")], weights[1, poses.index("wide")] = 0.96, 0.4
    shapes = flat.shapes(Track(weights, poses, 60.0))
    assert [shapes.poses[i] for i in shapes.weights.argmax(axis=1)] == ["A", "G"]


def test_what_reaches_the_shape_is_the_bent_weight_times_the_gain_and_at_most_one() -> None:
    assert dict(bend_drawn((), 0.5))[1.0] == 0.5
    drawn = dict(bend_drawn(((0.2, 0.1), (0.5, 0.8)), 1.5))
    assert (drawn[0.0], drawn[0.2]) == pytest.approx((0.15, 0.15))  # the first key holds before it
    assert (drawn[0.5], drawn[1.0]) == (1.0, 1.0)
    assert set(dict(bend_drawn((), -1.0)).values()) == {0.0}
