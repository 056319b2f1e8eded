"""The gear pump's torque loss: eq. 22 at speed, a boundary friction at creep, and a sign that can be solved."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.hydraulics.fixed_pump import FixedPump, fixed_pump_extrapolation, loss_torque

RPM = math.pi / 30.0
PUMP = filled(
    FixedPump(
        displacement="1.8 cm^3/rev",
        leakage="2.25e-13 m^3/s/Pa",
        torque_loss={
            "norm": "5.157 Nm",
            "normal_speed": "3000 rpm",
            "normal_pressure": "180 bar",
            "coefficients": {"k_000": 0.030, "k_010": 0.020, "k_001": 0.050},
            "validity": {"stroke": [1, 1], "speed": ["0 rpm", "4000 rpm"], "pressure": ["0 bar", "250 bar"]},
        },
        boundary_friction={"share": 0.05, "decay_speed": "100 rpm", "sign_speed": "5 rad/s"},
    )
)


def test_at_its_rated_point_a_tenth_of_its_torque_is_lost():
    assert loss_torque(PUMP, 3000 * RPM, 180e5) == pytest.approx(5.157 * 0.100, rel=1e-9)
    assert 1.8e-6 / math.tau * 180e5 / (1.8e-6 / math.tau * 180e5 + 0.5157) == pytest.approx(0.91, abs=0.002)


def test_as_it_creeps_its_gears_run_dry():
    expected = 5.157 * (0.030 + 0.020 * 96 / 3000 + 0.050 * 72 / 180 + 0.05 * math.exp(-0.96)) * math.tanh(96 * RPM / 5)
    assert loss_torque(PUMP, 96 * RPM, 72e5) == pytest.approx(expected, rel=1e-9)


@given(speed=st.floats(-400.0, 400.0), pressure=st.floats(-200e5, 200e5))
def test_it_takes_energy_in_all_four_quadrants_alike(speed, pressure):
    assert loss_torque(PUMP, speed, pressure) * speed >= 0.0
    assert loss_torque(PUMP, -speed, pressure) == -loss_torque(PUMP, speed, pressure)
    assert loss_torque(PUMP, speed, -pressure) == loss_torque(PUMP, speed, pressure)


def test_at_standstill_its_slope_is_that_of_the_rounded_sign():
    slope = (loss_torque(PUMP, 1e-4, 90e5) - loss_torque(PUMP, -1e-4, 90e5)) / 2e-4
    assert slope == pytest.approx(5.157 * (0.030 + 0.025 + 0.05) / 5.0, rel=1e-4)


def test_outside_its_measured_range_it_says_so():
    assert fixed_pump_extrapolation(PUMP, 330.0, 180e5) == 0.0
    assert fixed_pump_extrapolation(PUMP, 330.0, 300e5) == pytest.approx(0.2)
