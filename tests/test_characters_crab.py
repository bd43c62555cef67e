"""What the crab's face does, with shapes of its own."""

import numpy as np
import pytest

from lipdb.characters.crab import crab
from lipdb.characters.gltf_write import glb_bytes
from lipdb.characters.mouth import LOWER, UPPER, measure
from lipdb.characters.sculpt.crab_eyes import BALL, RADIUS

SHAPES = ("bare_teeth", "frown", "smile", "mouth_open", "mouth_oo", "tongue_up", "tongue_teeth", "tongue_back", "lips_press")


def mouth(**weights):
    opening, width = measure(crab(), np.array([[weights.get(shape, 0.0) for shape in SHAPES]]), SHAPES)
    return float(opening[0]), float(width[0])


def points(name, **weights):
    return crab().morphed(weights)[[part.name for part in crab().parts].index(name)]


def landmark(name, **weights):
    part, vertex = crab().landmarks[name]
    return crab().morphed(weights)[part][vertex]


def test_the_crab_has_its_own_shapes_and_keeps_to_its_budget_of_vertices():
    assert {*SHAPES, "brow_up", "brow_down", "blink"} == set(crab().shape_names)
    assert crab().vertices <= 15_000


def test_building_the_crab_again_gives_the_same_bytes():
    first = glb_bytes(crab())
    crab.cache_clear()
    assert glb_bytes(crab()) == first


def test_mouth_open_opens_widest_and_mouth_oo_is_narrow():
    assert mouth()[0] == 0
    assert mouth(mouth_open=1)[0] > 2 * max(mouth(**{shape: 1})[0] for shape in SHAPES if shape != "mouth_open")
    assert mouth(mouth_oo=1)[1] < 0.3 * mouth()[1]


@pytest.mark.parametrize("shape", ["bare_teeth", "mouth_oo", "mouth_open"])
def test_pressed_lips_close_what_the_engine_lets_stand_beside_them(shape):
    assert mouth(lips_press=1, **{shape: 0.15})[0] < 0.05 * mouth(mouth_open=1)[0]
    assert mouth(lips_press=1)[0] == 0


def test_pressed_lips_close_a_round_mouth_too():
    assert mouth(lips_press=0.9, mouth_oo=1)[0] < 0.05 * mouth(mouth_open=1)[0]


def test_bare_teeth_shows_both_rows():
    upper, lower = landmark(UPPER, bare_teeth=1)[1], landmark(LOWER, bare_teeth=1)[1]
    assert lower < points("teeth_upper", bare_teeth=1)[:, 1].min() < upper
    assert lower < points("teeth_lower", bare_teeth=1)[:, 1].max() < upper


def test_at_rest_the_teeth_are_behind_the_lips():
    shell = points("body")
    lip = landmark(UPPER)[2]
    assert max(points("teeth_upper")[:, 2].max(), points("teeth_lower")[:, 2].max()) < lip
    assert shell[:, 2].max() > lip


def test_the_corners_go_up_in_a_smile_and_down_in_a_frown():
    corner = crab().landmarks["inner_corner_right"][1]
    rest, smile, frown = (points("body", **weights)[corner, 1] for weights in ({}, {"smile": 1}, {"frown": 1}))
    assert frown + 0.08 < rest < smile - 0.08


def test_the_three_tongues_differ():
    tips = {shape: points("tongue", **{shape: 1.0})[-8:].mean(axis=0) for shape in ("tongue_up", "tongue_teeth", "tongue_back")}
    assert tips["tongue_up"][1] > tips["tongue_teeth"][1] + 0.1
    assert tips["tongue_teeth"][2] > tips["tongue_up"][2] + 0.1 > tips["tongue_back"][2] + 0.1


@pytest.mark.parametrize("shut", [0.0, 1.0])
@pytest.mark.parametrize("lid", ["eyelid_upper_left", "eyelid_lower_left"])
def test_the_lids_lie_round_the_ball(lid, shut):
    outside = points(lid, blink=shut)[26:]
    assert (np.linalg.norm(outside - BALL, axis=1) > 1.01 * RADIUS).all()


def test_in_a_blink_the_upper_lid_comes_down_over_the_lower_one():
    middle = 26 + 13
    assert points("eyelid_upper_left", blink=1)[middle, 1] < points("eyelid_lower_left", blink=1)[middle, 1]
    assert points("eyelid_upper_left")[middle, 1] > points("eyelid_lower_left")[middle, 1] + RADIUS
