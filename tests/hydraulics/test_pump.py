"""The pump: ideal flow, and a torque loss that always costs."""

import numpy as np
import pytest
from bench import circuit

from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.hydraulics.pump import extrapolation, flow_loss, ideal_flow, torque_loss
from ars_mujoco.schema.document import override, read
from ars_mujoco.schema.errors import InputError

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


def test_the_shipped_pump_loses_flow_to_its_linear_leakage_alone():
    for pressure in (180 * BAR, -3 * BAR, 0.0):
        assert flow_loss(PUMP, 0.7, pressure) == 2.25e-13 * pressure


def test_a_flow_loss_comes_on_top_of_the_leakage():
    pump = circuit().pump
    pump.flow_loss = pump.torque_loss  # any polynomial, here of k_000, k_010, k_001 and k_101
    pump.flow_loss.norm = 9e-5
    share = 0.020 + 0.020 + 0.025 + 0.030
    for side in (1, -1):
        expected = side * (9e-5 * share + 2.25e-13 * 180 * BAR)
        assert flow_loss(pump, 1.0, side * 180 * BAR) == pytest.approx(expected, rel=1e-12)


def test_the_range_of_either_loss_counts():
    pump = circuit().pump
    pump.flow_loss = pump.torque_loss
    assert extrapolation(PUMP, -1.3, 299 * BAR) == 0.0
    assert extrapolation(PUMP, 1.0, -330 * BAR) == pytest.approx(0.1)
    pump.flow_loss.limits[2, 1] = 200 * BAR
    assert extrapolation(pump, 1.0, 220 * BAR) == pytest.approx(0.1)


def test_a_speed_outside_the_range_of_a_loss_is_refused():
    setting = override("front.pump.speed=7000 rpm")
    with pytest.raises(InputError) as refused:
        read(actuator_schema(), "pump_controlled", "actuator", [setting])
    assert "front.pump: speed: 7000 rpm is outside the range of torque_loss; allowed: 500 to 6500 rpm" in str(
        refused.value
    )


def test_the_loss_is_the_same_cost_in_all_four_quadrants():
    losses = [torque_loss(PUMP, stroke, pressure) for stroke in (0.7, -0.7) for pressure in (120 * BAR, -120 * BAR)]
    assert losses[0] > 0.0
    assert np.ptp(losses) == 0.0
