"""What the proportional loop leaves of the command."""

import math

import numpy as np
import pytest
from theory import CORNERS, LOOP, full_flow, leakage

from ars_mujoco.actuators.pump_controlled.third_order_circuit import advance
from ars_mujoco.analysis import steady_state
from ars_mujoco.analysis.steady_state import error


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_the_error_is_that_of_the_closed_form(loop):
    D = loop.circuit.motor.displacement
    a, velocity_gain = leakage(loop) * loop.stiffness / D**2, loop.gain * full_flow(loop) / D
    assert error(loop) == pytest.approx(a / (a + velocity_gain), rel=1e-9)


@pytest.mark.parametrize("leaking", [4e-13, 2e-12])
def test_the_running_circuit_comes_to_rest_with_that_error(leaking):
    loop, command = LOOP.at({"leakage": leaking}), math.radians(5)
    state = loop.at_rest()
    advance(loop.axle, state, state, ((command, 0.0, 0.0), loop.gain, 0.0, 0.0), 3.0, 60000)
    assert abs(state.circuit.rate) < 1e-9
    assert 1 - state.circuit.angle / command == pytest.approx(error(loop), rel=1e-6)


def test_the_paper_s_half_a_percent_holds_only_near_the_least_leakage():
    found = steady_state.compute(LOOP)
    (errors,) = (row["error"] for row in found["over_gain"] if row["gain"] == 60.0)
    assert errors[0] == pytest.approx(0.0050, abs=1e-4)
    assert errors[-1] == pytest.approx(0.025, abs=5e-4)
    assert np.all(np.diff(errors) > 0)
