"""Curves from articulation: what the shipped ones keep to, and what making them again changes and leaves alone."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.curated.folder import read_folder
from lipdb.curves.curve import Curve, curves_from_rows
from lipdb.curves.generate import Targets, all_pairs, generated, regenerate, shapes, thinned
from lipdb.curves.remake import remake
from lipdb.errors import CurveError

SHIPPED = read_folder(Path(__file__).parent.parent / "phonesets")
COMMON = curves_from_rows(SHIPPED["curves/facefx.tsv"].values())
TARGETS = Targets.from_records(SHIPPED, "facefx")
ROUNDED = ("w", "ow", "ao", "ue")
NOW = "2030-01-01T00:00:00Z"


def value(curve, time):
    at, weight = np.array(curve.keys or ((0.0, 0.0),)).T
    return float(np.interp(time, at, weight, 0, 0))


def test_the_shipped_curves_are_what_their_targets_give():
    for path, rows in remake(SHIPPED, author="somebody", time=NOW).items():
        assert rows == SHIPPED[path], f"{path}: run `lipdb curves generate`"


def test_there_is_a_curve_for_each_of_528_pairs_and_nine_poses():
    pairs = {key[:2] for key in COMMON}
    assert len(pairs) == 21 * 21 + 43 + 44 == 528
    assert ("_", "_") not in pairs
    assert len(COMMON) == 528 * 9


def test_every_shared_curve_is_marked_generated_and_names_a_source():
    assert {curve.origin for curve in COMMON.values()} == {"generated"}
    sources = {row["source"]: row["licence"] for row in SHIPPED["sources.tsv"].values()}
    assert {(curve.source, curve.licence) for curve in COMMON.values()} <= set(sources.items())


def test_curves_have_few_keys():
    assert max(len(curve.keys) for curve in COMMON.values()) <= 7
    assert all(len(curve.keys) >= 3 for curve in COMMON.values() if curve.keys)


def test_silence_starts_and_ends_at_rest():
    for (left, right, _), curve in COMMON.items():
        if left == "_":
            assert value(curve, 0) == 0
        if right == "_":
            assert value(curve, 1) == 0


@pytest.mark.parametrize(("phone", "pose"), [("bmp", "PBM"), ("f", "FV")])
def test_a_closing_phone_reaches_nine_tenths_with_every_neighbour_and_no_other_phone_closes(phone, pose):
    for (left, right, which), curve in COMMON.items():
        if which == pose:
            assert curve.peak >= 0.9 if phone in (left, right) else curve.peak == 0


def test_the_jaw_is_low_in_the_middle_of_a_closure():
    for (left, right, pose), curve in COMMON.items():
        if pose == "open" and "bmp" in (left, right):
            assert value(curve, 0.25 if left == "bmp" else 0.75) < 0.25


@pytest.mark.parametrize("phone", [*ROUNDED, "sh"])
def test_rounding_starts_before_the_phone(phone):
    pose = "ShCh" if phone == "sh" else "W"
    for left in set(TARGETS.phones) - {phone}:
        curve = COMMON[left, phone, pose]
        assert value(curve, 0.45) > 0.02, (left, phone)
        assert value(curve, 0.5) > value(curve, 0.3) or left in (*ROUNDED, "oy"), (left, phone)


def test_a_diphthong_moves_from_its_first_target_to_its_second():
    assert value(COMMON["d", "aw", "W"], 0.75) < value(COMMON["aw", "d", "W"], 0.25)
    assert value(COMMON["d", "oy", "W"], 0.75) > value(COMMON["oy", "d", "W"], 0.25)
    assert value(COMMON["d", "ay", "wide"], 0.75) < value(COMMON["ay", "d", "wide"], 0.25)


def test_both_pairs_that_cover_a_phone_agree_on_its_middle_so_that_the_maximum_does_not_pop():
    plain = replace(
        TARGETS,
        before=np.zeros_like(TARGETS.before),
        after=np.zeros_like(TARGETS.after),
        lead=TARGETS.lead * 0,
        release=TARGETS.release * 0,
    )
    curves = dict(generated(plain, all_pairs(plain.phones)))
    for left, middle, right in (("d", "ah", "kg"), ("aa", "w", "ih"), ("_", "sh", "ow")):
        before, after = Curve(curves[left, middle, "open"]), Curve(curves[middle, right, "open"])
        assert value(before, 0.75) == pytest.approx(value(after, 0.25), abs=1e-3)


def test_a_phone_that_changes_changes_only_the_pairs_it_is_in():
    target = TARGETS.target.copy()
    target[TARGETS.phones.index("eh")] *= 0.5
    changed = dict(generated(replace(TARGETS, target=target), all_pairs(TARGETS.phones)))
    differing = {key[:2] for key, keys in generated(TARGETS, all_pairs(TARGETS.phones)) if changed[key] != keys}
    assert differing
    assert all("eh" in pair for pair in differing)


@pytest.mark.parametrize("origin", ["authored", "fitted", "imported"])
def test_generating_again_never_overwrites_what_a_person_or_a_recording_made(origin):
    mine = Curve(((0.0, 0.0), (0.5, 0.123), (1.0, 0.0)), origin=origin, author="me", time="2020-01-01T00:00:00Z")
    old = {**COMMON, ("d", "ah", "open"): mine}
    assert regenerate(TARGETS, all_pairs(TARGETS.phones), old, author="x", time=NOW)["d", "ah", "open"] == mine


def test_generating_again_changes_neither_value_nor_time_of_what_comes_out_the_same():
    target = TARGETS.target.copy()
    target[TARGETS.phones.index("eh"), TARGETS.poses.index("open")] = 0.01
    again = regenerate(replace(TARGETS, target=target), all_pairs(TARGETS.phones), COMMON, author="x", time=NOW)
    new = {key for key, curve in again.items() if curve.time == NOW}
    assert new
    assert all("eh" in key[:2] and key[2] == "open" and again[key].keys != COMMON[key].keys for key in new)
    assert all(again[key] == COMMON[key] for key in COMMON if key not in new)


def test_generated_curves_of_a_phone_that_is_gone_go_too_but_not_authored_ones():
    mine = Curve((), origin="authored")
    old = {("d", "zz", "open"): mine, ("zz", "d", "open"): replace(mine, origin="generated")}
    again = regenerate(TARGETS, [("d", "ah")], old, author="x", time=NOW)
    assert ("d", "zz", "open") in again
    assert ("zz", "d", "open") not in again


def test_a_curve_that_outside_numbers_went_into_names_their_source():
    sources = {**TARGETS.sources, ("eh", "open"): ("somewhere", "CC0-1.0")}
    own = replace(TARGETS, sources=sources | {key: ("lipdb", "Apache-2.0") for key in sources if key != ("eh", "open")})
    curves = regenerate(own, [("d", "eh"), ("d", "ah")], {}, author="x", time=NOW)
    assert (curves["d", "eh", "open"].source, curves["d", "eh", "open"].licence) == ("somewhere", "CC0-1.0")
    assert curves["d", "ah", "open"].source == "lipdb"


def test_a_pair_with_a_phone_that_has_no_targets_is_refused():
    with pytest.raises(CurveError, match="no targets for the common phone 'qq'"):
        list(generated(TARGETS, [("qq", "d")]))


@pytest.mark.parametrize(("field", "number"), [("target", -0.1), ("glide", 1.2), ("insistence", 0.0), ("lead", -1.0)])
def test_numbers_out_of_range_are_refused(field, number):
    numbers = getattr(TARGETS, field).copy()
    numbers.flat[3] = number
    with pytest.raises(CurveError, match=r"(targets|timing)/facefx.tsv"):
        replace(TARGETS, **{field: numbers}).check("facefx")


def test_more_pairs_for_a_table_that_nothing_can_generate_are_refused():
    with pytest.raises(CurveError, match="targets/ and timing/"):
        remake(SHIPPED, author="x", time=NOW, more={"characters/crab/curves/octopus.tsv": [("d", "ah")]})


UNIT = st.floats(0, 1)


@given(
    st.lists(UNIT, min_size=4, max_size=4),
    st.lists(st.floats(0.05, 20), min_size=2, max_size=2),
    st.lists(st.floats(0, 2), min_size=4, max_size=4),
)
def test_any_targets_give_curves_within_bounds_that_run_forward_in_time(levels, insistence, reach):
    def array(*numbers):
        return np.array(numbers)[:, None]

    zero = np.zeros((2, 1))
    targets = Targets(
        ("a", "b"),
        ("open",),
        array(*levels[:2]),
        array(*levels[2:]),
        array(*insistence),
        zero,
        zero,
        np.array(reach[:2]),
        np.array(reach[2:]),
        np.array([False]),
    )
    times, weights = shapes(targets, np.array([0]), np.array([1]))
    assert (np.diff(times) >= 0).all()
    assert times.min() >= 0
    assert times.max() <= 1
    assert weights.min() >= 0
    assert weights.max() <= max(levels) + 1e-12
    keys = thinned(times[0, 0], weights[0, 0])
    assert list(keys) == sorted(keys, key=lambda key: key[0])
    drawn = np.interp(np.linspace(0, 1, 200), *np.array(keys or ((0, 0),)).T, 0, 0)
    whole = np.interp(np.linspace(0, 1, 200), times[0, 0], weights[0, 0], 0, 0)
    steep = np.diff(times[0, 0]).min() < 0.01
    assert steep or abs(drawn - whole).max() < 0.1
