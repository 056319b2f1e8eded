"""A switching valve's stroke: as long as stated, ending at the command without overshoot."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled
from scipy.integrate import solve_ivp

from ars_mujoco.hydraulics.bypass_valve import BypassValve
from ars_mujoco.hydraulics.valve_opening import opening_rate

VALVE = filled(BypassValve(flow="60 L/min", pressure="10 bar", time="20 ms"))
SHARES = st.floats(0.0, 1.0)


@pytest.mark.parametrize(("start", "command"), [(0.0, 1.0), (1.0, 0.0)])
def test_a_full_stroke_takes_its_time_but_for_the_last_twentieth(start, command):
    time = np.linspace(0.0, 0.03, 301)
    opening = solve_ivp(
        lambda t, o: opening_rate(VALVE, o[0], command), (0.0, 0.03), [start], "DOP853", time, rtol=1e-10, max_step=1e-4
    ).y[0]
    way = np.abs(opening - start)
    near = time > 0.019
    assert way[~near] == pytest.approx(time[~near] / 0.02, abs=1e-6)
    assert way[near] == pytest.approx(1 - 0.05 * np.exp(-(time[near] - 0.019) / 0.001), abs=1e-6)


@given(SHARES, SHARES)
def test_it_moves_towards_its_command_and_no_faster_than_its_stroke_allows(opening, command):
    rate = opening_rate(VALVE, opening, command)
    assert rate * (command - opening) >= 0.0
    assert abs(rate) <= 1 / VALVE.time


def test_once_there_it_stands():
    assert opening_rate(VALVE, 0.3, 0.3) == 0.0
