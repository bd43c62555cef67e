"""Curves carried over to another pose set through links: the same rule as for weights, kept as few straight lines."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipdb.curves.curve import Curve
from lipdb.curves.through import Link, carried

TIMES = np.linspace(0, 1, 101)[1:-1] + 0.0003
"""Between the three decimals that keys have, so that a step is never met."""


def drawn(keys):
    return np.interp(TIMES, *np.array(keys).T, 0, 0) if keys else np.zeros(len(TIMES))


def test_gain_scales_a_curve():
    curve = carried([Link("open", "jaw", 0.5, "sum", ())], {"open": Curve(((0.0, 0.0), (0.5, 0.8), (1.0, 0.0)))})
    assert curve.keys == ((0.0, 0.0), (0.5, 0.4), (1.0, 0.0))


def test_sums_stop_at_one_where_the_line_crosses_it():
    links = [Link("a", "x", 1.0, "sum", ()), Link("b", "x", 1.0, "sum", ())]
    curve = Curve(((0.0, 0.0), (0.5, 0.8), (1.0, 0.0)))
    assert carried(links, {"a": curve, "b": curve}).keys == ((0.0, 0.0), (0.312, 1.0), (0.5, 1.0), (0.688, 1.0), (1.0, 0.0))


def test_the_largest_of_two_changes_over_where_they_cross():
    links = [Link("a", "x", 1.0, "max", ()), Link("b", "x", 1.0, "max", ())]
    up, down = Curve(((0.0, 0.0), (1.0, 1.0))), Curve(((0.0, 1.0), (1.0, 0.0)))
    assert carried(links, {"a": up, "b": down}).keys == ((0.0, 1.0), (0.5, 0.5), (1.0, 1.0))


def test_a_bend_adds_keys_at_its_corners():
    bend = ((0.0, 0.0), (0.4, 0.0), (0.8, 1.0))
    curve = carried([Link("a", "x", 1.0, "sum", bend)], {"a": Curve(((0.0, 0.0), (1.0, 1.0)))})
    assert curve.keys == ((0.0, 0.0), (0.4, 0.0), (0.8, 1.0), (1.0, 1.0))


def test_no_curve_at_all_gives_the_empty_curve():
    assert carried([Link("a", "x", 1.0, "sum", ())], {}).keys == ()
    assert carried([Link("a", "x", 1.0, "sum", ())], {"a": Curve(())}).keys == ()
    assert carried([], {"a": Curve(((0.0, 1.0), (1.0, 1.0)))}).keys == ()


@st.composite
def curves(draw):
    times = sorted(draw(st.lists(st.integers(0, 20), min_size=2, max_size=5, unique=True)))
    return Curve(tuple((time / 20, draw(st.integers(0, 10)) / 10) for time in times))


BENDS = st.sampled_from([(), ((0.0, 0.0), (0.5, 0.9), (1.0, 1.0)), ((0.2, 0.0), (0.7, 1.0))])
LINKS = st.builds(Link, st.sampled_from("abc"), st.just("x"), st.sampled_from([0.3, 1.0, 1.5]), st.sampled_from(["sum", "max"]), BENDS)


@given(st.lists(LINKS, min_size=1, max_size=4), st.fixed_dictionaries({name: curves() for name in "abc"}))
def test_a_carried_curve_has_the_weights_that_the_links_would_give(links, given_curves):
    sums, largest = np.zeros(len(TIMES)), np.zeros(len(TIMES))
    for link in links:
        weight = drawn(given_curves[link.pose].keys)
        bent = np.interp(weight, *np.array(link.curve).T) if link.curve else weight
        if link.combine == "max":
            largest = np.maximum(largest, link.gain * bent)
        else:
            sums = sums + link.gain * bent
    expected = np.clip(np.maximum(sums, largest), 0, 1)
    got = drawn(carried(links, given_curves).keys)
    # Three decimals of time and weight: steep lines may be off by their slope times half a thousandth.
    assert got == pytest.approx(expected, abs=0.06)
