"""What Robin's face does: the shapes of speech as they are seen."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.characters.gltf_write import glb_bytes
from lipdb.characters.human import robin
from lipdb.characters.mesh import vertex_normals
from lipdb.characters.mouth import LOWER, RIGHT, UPPER, measure
from lipdb.characters.sculpt.eyes import EYE, EYE_RADIUS

SPEECH = ("open", "W", "ShCh", "PBM", "FV", "wide", "tRoof", "tTeeth", "tBack")
MOODS = ("smile", "frown", "brow_up", "brow_down", "blink")


def mouth(**weights):
    """Opening and width at these weights."""
    opening, width = measure(robin(), np.array([[weights.get(shape, 0.0) for shape in SPEECH]]), SPEECH)
    return float(opening[0]), float(width[0])


def points(name, **weights):
    """The positions of the part called *name*."""
    index = [part.name for part in robin().parts].index(name)
    return robin().morphed(weights)[index]


def landmark(name, **weights):
    part, vertex = robin().landmarks[name]
    return robin().morphed(weights)[part][vertex]


WIDEST = mouth(open=1)[0]


def test_the_head_has_all_shapes_and_keeps_to_its_budget_of_vertices():
    assert set(SPEECH + MOODS) <= set(robin().shape_names)
    assert robin().vertices <= 15_000


def test_only_parts_that_move_have_shapes():
    still = {part.name for part in robin().parts if not part.shapes}
    assert {"hair", "neck", "shirt", "ear_left", "eye_left"} <= still


def test_building_the_head_again_gives_the_same_bytes():
    first = glb_bytes(robin())
    robin.cache_clear()
    assert glb_bytes(robin()) == first


def test_every_edge_of_the_head_has_at_most_one_face_on_each_side():
    head = robin().parts[0]
    edges = np.concatenate([head.faces[:, [0, 1]], head.faces[:, [1, 2]], head.faces[:, [2, 0]]])
    assert len(np.unique(edges, axis=0)) == len(edges)


def test_normals_of_the_face_point_forwards():
    head = robin().parts[0]
    normals = vertex_normals(head.positions, head.faces)
    face = (head.positions[:, 2] > 0.75) & (np.arange(len(normals)) > robin().landmarks[RIGHT][1])
    assert (normals[face, 2] > 0).mean() > 0.97


def test_the_mouth_is_closed_at_rest_and_opens_with_open():
    openings = [mouth(open=weight)[0] for weight in (0, 0.25, 0.5, 0.75, 1)]
    assert openings[0] == 0
    assert np.allclose(np.diff(openings), WIDEST / 4)
    assert all(mouth(**{shape: 1})[0] < WIDEST / 2 for shape in SPEECH if shape != "open")


def test_w_draws_the_mouth_together_and_wide_draws_it_out():
    rest = mouth()[1]
    assert mouth(W=1)[1] < 0.3 * rest
    assert mouth(ShCh=1)[1] < 0.6 * rest
    assert mouth(wide=1)[1] > 1.15 * rest


def test_w_is_round_and_pushed_forward():
    lips = points("head", W=1)
    upper = robin().landmarks[UPPER][1]
    columns = 4 * (upper - robin().landmarks[RIGHT][1])
    start = robin().landmarks[RIGHT][1]
    ring = lips[start + 9 * columns : start + 10 * columns]  # within the red of the lips
    height, width = np.ptp(ring[:, 1]), np.ptp(ring[:, 0])
    assert 0.75 < height / width < 1.3
    assert landmark(UPPER, W=1)[2] > landmark(UPPER)[2] + 0.12


@pytest.mark.parametrize("opening", [0.0, 0.15, 0.3])
def test_w_hides_the_teeth(opening):
    upper_lip, lower_lip = landmark(UPPER, W=1, open=opening)[1], landmark(LOWER, W=1, open=opening)[1]
    front = lambda teeth: teeth[(teeth[:, 2] > teeth[:, 2].max() - 0.08) & (np.abs(teeth[:, 0]) < 0.06)]  # noqa: E731
    assert front(points("teeth_upper", W=1, open=opening))[:, 1].min() > upper_lip
    assert front(points("teeth_lower", W=1, open=opening))[:, 1].max() < lower_lip


def test_shch_shows_the_teeth_between_lips_that_stand_forward():
    upper_lip, lower_lip = landmark(UPPER, ShCh=1), landmark(LOWER, ShCh=1)
    edge = points("teeth_upper", ShCh=1)[:, 1].min()
    assert lower_lip[1] + 0.01 < edge < upper_lip[1] - 0.01
    assert upper_lip[2] > landmark(UPPER)[2] + 0.06


@pytest.mark.parametrize("shape", ["W", "ShCh", "wide"])
@given(weight=st.floats(0, 1), press=st.floats(0.9, 1))
def test_pressed_lips_stay_closed_whatever_else_the_mouth_does(shape, weight, press):
    assert mouth(PBM=press, **{shape: weight})[0] < 0.05 * WIDEST


def test_pressed_lips_stay_closed_with_some_of_all_that_opens_them():
    for w, shch, wide in itertools.product((0, 0.4), repeat=3):
        assert mouth(PBM=0.9, W=w, ShCh=shch, wide=wide)[0] < 0.05 * WIDEST


def test_in_fv_the_lower_lip_meets_the_upper_teeth_across_the_front():
    teeth, lips = points("teeth_upper", FV=1), points("head", FV=1)
    start, upper = robin().landmarks[RIGHT][1], robin().landmarks[UPPER][1]
    columns = 4 * (upper - start)
    lower = lips[start + columns // 2 : start + columns]
    for x in (-0.1, -0.05, 0.0, 0.05, 0.1):
        lip = lower[np.abs(lower[:, 0] - x).argmin()]
        near = teeth[(np.abs(teeth[:, 0] - x) < 0.03) & (teeth[:, 2] > 0.6)]
        low = near[near[:, 1] < near[:, 1].min() + 0.012]
        edge = low[low[:, 2].argmax()]
        assert abs(lip[1] - edge[1]) < 0.025
        assert abs(lip[2] - edge[2]) < 0.045


def test_in_fv_the_upper_lip_leaves_the_teeth_to_be_seen():
    assert landmark(UPPER, FV=1)[1] > points("teeth_upper", FV=1)[:, 1].min() + 0.02


def test_the_three_tongues_differ_by_what_is_seen_from_the_front():
    tips = {shape: points("tongue", open=0.35, **{shape: 1.0}) for shape in ("tRoof", "tTeeth", "tBack")}
    tip = {shape: tongue[tongue[:, 2].argmax()] for shape, tongue in tips.items()}
    assert tip["tRoof"][1] > tip["tTeeth"][1] + 0.06
    assert tip["tTeeth"][2] > tip["tRoof"][2] + 0.1
    assert tip["tBack"][2] < tip["tRoof"][2] - 0.1
    assert tips["tTeeth"][:, 2].max() > points("teeth_upper")[:, 2].max() - 0.08


@pytest.mark.parametrize("shut", [0.0, 0.5, 1.0])
def test_the_eyeball_never_comes_through_the_lids(shut):
    lids = points("eyelids_left", blink=shut)[40:]
    assert (np.linalg.norm(lids - EYE, axis=1) > 1.005 * EYE_RADIUS).all()


def test_in_a_blink_the_lids_meet():
    edge = points("eyelids_left", blink=1)[40:80]
    upper, lower = edge[1:20], edge[39:20:-1]
    assert np.linalg.norm(upper - lower, axis=1).max() < 0.02
    open_eye = points("eyelids_left")[40:80]
    assert np.linalg.norm(open_eye[10] - open_eye[30]) > 0.12


@given(st.sampled_from(SPEECH + MOODS), st.floats(0, 1))
def test_left_and_right_move_alike(shape, weight):
    lips = points("head", **{shape: weight})
    start, columns = robin().landmarks[RIGHT][1], 4 * (robin().landmarks[UPPER][1] - robin().landmarks[RIGHT][1])
    line = lips[start : start + columns]
    mirrored = line[(columns // 2 - np.arange(columns)) % columns] * [-1, 1, 1]
    assert np.allclose(line, mirrored, atol=1e-4)
