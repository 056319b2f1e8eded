"""The vane motor: friction that only takes, and a stop that gives back."""

import math

import pytest
from bench import circuit
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.vane_motor import friction_torque, stop_torque

MOTOR = circuit().motor
STICKY = circuit().motor
STICKY.static_friction = 15.0
RATES = st.floats(-5.0, 5.0)


@pytest.mark.parametrize("rate", [0.05, 0.3, 1.0])
def test_in_motion_friction_is_dry_and_viscous(rate):
    assert friction_torque(MOTOR, rate) == pytest.approx(35.0 * math.tanh(rate / 0.01) + 16.5 * rate, rel=1e-12)


def test_static_friction_fades_with_speed():
    extra = friction_torque(STICKY, 0.1) - friction_torque(MOTOR, 0.1)
    assert extra == pytest.approx(15.0 * math.exp(-20 * 0.1), rel=1e-6)


def test_at_standstill_there_is_no_friction():
    assert friction_torque(STICKY, 0.0) == 0.0


@given(rate=RATES)
def test_friction_is_odd_and_takes_energy(rate):
    assert friction_torque(STICKY, -rate) == -friction_torque(STICKY, rate)
    assert friction_torque(STICKY, rate) * rate >= 0.0


@given(rate=RATES)
def test_friction_is_nowhere_steeper_than_at_standstill(rate):
    at_standstill = (35.0 + 15.0) / 0.01 + 16.5
    slope = (friction_torque(STICKY, rate + 1e-7) - friction_torque(STICKY, rate - 1e-7)) / 2e-7
    assert slope <= at_standstill * (1.0 + 1e-6)


def test_at_standstill_its_slope_is_that_of_the_rounded_sign():
    slope = (friction_torque(STICKY, 1e-7) - friction_torque(STICKY, -1e-7)) / 2e-7
    assert slope == pytest.approx((35.0 + 15.0) / 0.01 + 16.5, rel=1e-5)


@pytest.mark.parametrize("side", [1, -1])
def test_the_stop_is_a_spring_beyond_45_deg(side):
    assert stop_torque(MOTOR, side * math.radians(45.0)) == 0.0
    assert stop_torque(MOTOR, side * math.radians(45.5)) == pytest.approx(side * 2e5 * math.radians(0.5))
