"""The check valve: open one way, over its spring's pressure."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.check_valve import CheckValve, check_flow

BAR = 1e5
VALVE = filled(CheckValve(opening_pressure="0.5 bar", conductance="1e-9 m^3/s/Pa"))


def test_it_passes_its_conductance_times_what_exceeds_the_opening_pressure():
    assert check_flow(VALVE, 20 * BAR, 18.5 * BAR) == pytest.approx(1e-4)


@given(st.floats(0.0, 4e7), st.floats(0.0, 4e7))
def test_it_passes_nothing_back_and_takes_energy(ahead, behind):
    flow = check_flow(VALVE, ahead, behind)
    assert flow >= 0.0
    assert flow == 0.0 or ahead - behind > 0.5 * BAR
