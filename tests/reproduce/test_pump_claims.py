"""Pump and pump control."""

import pytest
from verdicts import ours, verdict


def test_the_cylinder_is_far_faster_than_the_valve_and_in_the_paper_s_range(claims):
    frequency, ratio = ours(claims["cylinder_eigenfrequency"])
    assert 2000 < frequency < 3500
    assert ratio == pytest.approx(frequency / 66.85, rel=1e-3)
    assert verdict(claims["cylinder_eigenfrequency"]) == "reproduced"


def test_a_heavy_slack_cylinder_is_not(with_settings):
    heavy = with_settings("cylinder_eigenfrequency", "actuator.front.control_cylinder.mass=15 kg")
    assert verdict(heavy).startswith("does not follow")


def test_the_printed_valve_constant_is_76_l_min(claims):
    needed, flow = ours(claims["servo_valve_constant"])
    assert flow == pytest.approx(76.5, rel=3e-3)
    assert needed == pytest.approx(5.7e-4, rel=0.02)
    assert verdict(claims["servo_valve_constant"]).startswith("does not follow")


def test_the_s_curve_asks_little_of_the_pump_control(claims):
    mean, greatest, opened = ours(claims["control_flow"])
    assert mean < greatest < 1e3 * opened
    assert opened == pytest.approx(250 * 1.54e-4 * 5e-3 * 6e4)  # L/min
    assert verdict(claims["control_flow"]) == "reproduced"


def test_the_load_takes_little_of_the_flow_only_with_little_leakage(claims):
    assert ours(claims["flow_and_load"])[0] == pytest.approx((4.5, 22.5))
    assert verdict(claims["flow_and_load"]).startswith("holds only with the least leakage")


def test_the_loss_polynomial_has_its_number_of_coefficients(claims):
    assert verdict(claims["coefficients"]) == "reproduced"


def test_a_full_step_of_the_valve_takes_longer_than_a_small_one(claims, with_settings):
    small, large = ours(claims["valve_step_size"])
    assert small < large
    assert large > 9.0  # ms, at 100 strokes/s
    assert verdict(claims["valve_step_size"]) == "reproduced"
    unlimited = with_settings("valve_step_size", "actuator.front.servo_valve.max_rate=1e4 1/s")
    assert verdict(unlimited).startswith("does not follow")
