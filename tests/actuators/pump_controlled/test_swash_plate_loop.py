"""The inner loop with valve and swash plate, linearized from the running circuit: its stated bandwidth."""

import numpy as np
import pytest
from bench import circuit, linearized
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.actuators.pump_controlled.swash_plate_loop import valve_command

CIRCUIT = circuit()


def test_its_poles_are_a_real_one_and_a_pair():
    poles = np.linalg.eigvals(linearized(CIRCUIT)[0][:3, :3])
    assert sorted(poles, key=lambda s: s.imag) == pytest.approx([-157 - 253j, -280, -157 + 253j], abs=1)


def test_the_stroke_follows_its_command_to_minus_3_db_at_280_rad_s():
    states, command = linearized(CIRCUIT)
    response = np.linalg.solve(280j * np.eye(3) - states[:3, :3], command[:3])
    assert abs(response[2]) == pytest.approx(0.5**0.5, rel=1e-5)


@given(command=st.floats(-1, 1), stroke=st.floats(-1.2, 1.2))
def test_it_asks_for_no_more_than_the_valves_full_stroke(command, stroke):
    asked = valve_command(CIRCUIT.swash_plate_loop, CIRCUIT.swash_plate, command, stroke)
    assert asked == pytest.approx(np.clip(140.4579128014667 / 250 * (command - stroke), -1, 1), abs=1e-12)
