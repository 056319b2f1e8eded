"""Table 3 as it follows from Table 2."""

import math

import numpy as np
import pytest
from theory import CORNERS, LOOP, leakage

from ars_mujoco.analysis import hydraulic_poles
from ars_mujoco.analysis.hydraulic_poles import pole_pair

RESULT = hydraulic_poles.compute(LOOP)


def test_the_full_box_gives_590_to_1324_rad_s_and_a_damping_of_0_022_to_0_155():
    assert RESULT["full_box"]["frequency"] == pytest.approx([590, 1324], rel=1e-3)
    assert RESULT["full_box"]["damping"] == pytest.approx([0.022, 0.155], abs=5e-4)


def test_one_parameter_at_a_time_gives_682_to_1078_rad_s():
    assert RESULT["one_at_a_time"]["frequency"] == pytest.approx([682, 1078], rel=1e-3)


def test_table_3_as_printed_follows_from_neither():
    for way in ("full_box", "one_at_a_time"):
        assert RESULT[way]["frequency"] != pytest.approx([686, 1320], rel=5e-3)
        assert RESULT[way]["damping"] != pytest.approx([0.037, 0.139], rel=0.04)


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_frequency_and_damping_are_those_of_the_closed_form(loop):
    motor, C, k = loop.circuit.motor, loop.circuit.line.capacitance, leakage(loop)
    frequency = math.sqrt((motor.displacement**2 + k * motor.viscous_friction) / (C * motor.inertia))
    damping = (k / C + motor.viscous_friction / motor.inertia) / (2.0 * frequency)
    assert pole_pair(loop) == pytest.approx((frequency, damping), rel=1e-9)


def test_the_speed_of_the_pump_does_not_move_the_poles():
    assert pole_pair(LOOP.at({"speed": 600.0})) == pole_pair(LOOP)


def test_the_printed_table_needs_small_capacitance_and_much_friction():
    box = [
        pole_pair(LOOP.at({"leakage": k, "capacitance": C, "inertia": theta, "viscous_friction": r}))
        for k in (4e-13, 2e-12) for C in (4e-14, 6e-14) for theta in (0.1, 0.25) for r in (13.1, 26.5)
    ]  # fmt: skip
    frequency, damping = np.transpose(box)
    assert [frequency.min(), frequency.max()] == pytest.approx([686, 1320], rel=0.012)
    assert [damping.min(), damping.max()] == pytest.approx([0.037, 0.139], rel=0.025)
