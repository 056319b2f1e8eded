"""The bypass valve: its rating, and no side."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.bypass_valve import BypassValve, bypass_flow

BAR = 1e5
VALVE = filled(BypassValve(flow="60 L/min", pressure="10 bar", time="20 ms"))


def test_it_passes_60_litres_a_minute_at_10_bar_less_the_rounding_at_1_bar():
    assert bypass_flow(VALVE, 1.0, 10 * BAR) == pytest.approx(1e-3 / 1.01**0.25, rel=1e-9)


def test_four_times_the_pressure_doubles_the_flow():
    assert bypass_flow(VALVE, 1.0, 160 * BAR) / bypass_flow(VALVE, 1.0, 40 * BAR) == pytest.approx(2.0, rel=2e-4)


def test_shut_it_passes_nothing_and_half_open_half():
    assert bypass_flow(VALVE, 0.0, 100 * BAR) == 0.0
    assert bypass_flow(VALVE, 0.5, 100 * BAR) == 0.5 * bypass_flow(VALVE, 1.0, 100 * BAR)


@given(st.floats(0.0, 1.0), st.floats(-4e7, 4e7))
def test_it_is_odd_and_takes_energy(opening, difference):
    flow = bypass_flow(VALVE, opening, difference)
    assert bypass_flow(VALVE, opening, -difference) == -flow
    assert flow * difference >= 0.0
