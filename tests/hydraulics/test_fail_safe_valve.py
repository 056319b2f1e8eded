"""The fail-safe valve: its rating, a drop that grows as it closes, and shut at the end."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.fail_safe_valve import FailSafeValve, fail_safe_drop, fail_safe_flow, is_shut

BAR = 1e5
RATED = 20e-3 / 60  # m^3/s
VALVE = filled(FailSafeValve(flow="20 L/min", pressure="2 bar", time="20 ms"))
OPENINGS, FLOWS = st.floats(0.05, 1.0), st.floats(-1e-3, 1e-3)


def test_open_it_takes_2_bar_of_20_litres_a_minute():
    assert fail_safe_drop(VALVE, 1.0, RATED) == pytest.approx(2 * BAR * 1.0025**0.5, rel=1e-9)


def test_twice_the_flow_or_half_the_opening_takes_four_times_the_pressure():
    drop = fail_safe_drop(VALVE, 1.0, RATED)
    assert fail_safe_drop(VALVE, 1.0, 2 * RATED) == pytest.approx(4 * drop, rel=2e-3)
    assert fail_safe_drop(VALVE, 0.5, RATED) == pytest.approx(4 * drop, rel=1e-12)


def test_a_small_flow_is_laminar():
    small = 1e-4 * RATED
    assert fail_safe_drop(VALVE, 1.0, small) == pytest.approx(2 * BAR * 1e-4 * 0.05, rel=1e-5)


@given(OPENINGS, FLOWS)
def test_its_drop_is_odd_and_takes_energy(opening, flow):
    drop = fail_safe_drop(VALVE, opening, flow)
    assert fail_safe_drop(VALVE, opening, -flow) == -drop
    assert drop * flow >= 0.0


@pytest.mark.parametrize(("opening", "shut"), [(0.0, True), (0.049, True), (0.05, False), (1.0, False)])
def test_it_is_shut_below_a_twentieth_of_its_stroke(opening, shut):
    assert is_shut(VALVE, opening) == shut


def test_the_flow_through_it_is_rated_too_and_there_is_none_through_a_shut_one():
    assert fail_safe_flow(VALVE, 1.0, 2 * BAR) == pytest.approx(RATED * (1.0 + 0.25) ** -0.25, rel=1e-9)
    assert fail_safe_flow(VALVE, 0.5, -2 * BAR) == -0.5 * fail_safe_flow(VALVE, 1.0, 2 * BAR)
    assert fail_safe_flow(VALVE, 0.049, 200 * BAR) == 0.0
