"""Electric motor: its rotor by closed forms, its power by the first law."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.machines.electric_motor import ElectricMotor, electrical_power, turn

STRONG = filled(ElectricMotor(kind="electric", torque_limit="1e6 Nm"))
WEAK = filled(ElectricMotor(kind="electric"))  # as shipped: 12 Nm
H = 1e-3


def turned(motor, slip, load, steps):
    """The slips (rad/s) from `slip` on, and the motor's mean torques (Nm)."""
    slips, torques = [slip], []
    for _ in range(steps):
        slip, torque = turn(motor, slips[-1], load, H)
        slips.append(slip)
        torques.append(torque)
    return np.array(slips), np.array(torques)


@pytest.mark.parametrize("load", [0.0, 6.0, -4.0])
def test_the_rotor_settles_exponentially_where_its_torque_is_the_load(load):
    time, settled = H * np.arange(51), load / 0.75
    slips, torques = turned(STRONG, 314.0, load, 50)
    expected = settled + (314.0 - settled) * np.exp(-0.75 / 0.004 * time)
    assert slips == pytest.approx(expected, rel=1e-9)
    assert turned(STRONG, 314.0, load, 200)[1][-1] == pytest.approx(load, abs=1e-9)
    assert torques[0] == pytest.approx(0.75 * (slips[0] + slips[1]) / 2, rel=0.02)


def test_from_a_stand_it_first_speeds_up_with_its_greatest_torque():
    slips, torques = turned(WEAK, 314.0, 2.0, 300)
    limited = torques == 12.0
    assert -np.diff(slips)[limited] == pytest.approx(H * (12.0 - 2.0) / 0.004)
    assert limited.sum() == pytest.approx((314.0 - 12.0 / 0.75) / (H * (12.0 - 2.0) / 0.004), abs=1)
    assert slips[-1] == pytest.approx(2.0 / 0.75)


@pytest.mark.parametrize("inertia", [1e-6, 1e-4, 0.004, 1.0])
def test_no_inertia_makes_it_overshoot(inertia):
    motor = WEAK.copy()
    motor.inertia = inertia
    slips, torques = turned(motor, 314.0, 2.0, 100)
    assert np.all(np.diff(slips) <= 1e-12) and slips[-1] >= 2.0 / 0.75 - 1e-12
    assert np.abs(torques).max() <= 12.0


@given(slip=st.floats(-300, 300), load=st.floats(-30, 30))
def test_torque_times_mean_speed_is_what_the_load_takes_and_the_rotor_gains(slip, load):
    later, torque = turn(WEAK, slip, load, H)
    before, after = 314.0 - slip, 314.0 - later
    gained = 0.5 * WEAK.inertia * (after**2 - before**2)
    mean = 0.5 * (before + after)
    assert torque * mean * H == pytest.approx(gained + load * mean * H, abs=1e-9)


def test_the_supply_pays_the_losses_driving_and_braking():
    assert electrical_power(WEAK, 850.0) == pytest.approx(1000.0)
    assert electrical_power(WEAK, -1000.0) == pytest.approx(-850.0)
    assert math.copysign(1.0, electrical_power(WEAK, 0.0)) == 1.0
