"""The pump: ideal flow, and a torque loss that always costs."""

import numpy as np
import pytest
from bench import circuit

from ars_mujoco.hydraulics.pump import ideal_flow, torque_loss

PUMP = circuit().pump
BAR = 1e5


def test_the_full_stroke_delivers_5_4_litres_a_minute():
    assert ideal_flow(PUMP, 1.0) == pytest.approx(5.4e-3 / 60, rel=1e-12)
    assert ideal_flow(PUMP, -0.25) == pytest.approx(-5.4e-3 / 240, rel=1e-12)


def test_the_mechanical_stop_limits_the_flow():
    assert ideal_flow(PUMP, 1.3) == ideal_flow(PUMP, 1.0)
    assert ideal_flow(PUMP, -1.3) == ideal_flow(PUMP, -1.0)


def test_at_the_normal_point_the_loss_is_the_sum_of_its_coefficients():
    assert torque_loss(PUMP, 1.0, 180 * BAR) == pytest.approx(5.157 * (0.020 + 0.020 + 0.025 + 0.030))


def test_each_coefficient_has_its_own_variable():
    fast = circuit().pump
    fast.speed = 2.0 * PUMP.speed
    idle = torque_loss(PUMP, 0.0, 0.0)
    assert idle == pytest.approx(5.157 * 0.040)
    assert torque_loss(fast, 0.0, 0.0) - idle == pytest.approx(5.157 * 0.020)
    assert torque_loss(PUMP, 0.0, 90 * BAR) - idle == pytest.approx(5.157 * 0.0125)
    assert torque_loss(PUMP, 0.5, 90 * BAR) - idle == pytest.approx(5.157 * (0.0125 + 0.0075))


def test_the_loss_is_the_same_cost_in_all_four_quadrants():
    losses = [torque_loss(PUMP, stroke, pressure) for stroke in (0.7, -0.7) for pressure in (120 * BAR, -120 * BAR)]
    assert losses[0] > 0.0
    assert np.ptp(losses) == 0.0
