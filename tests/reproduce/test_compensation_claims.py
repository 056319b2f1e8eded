"""Compensation of the hydraulic poles, Figs. 12 and 13."""

import pytest
from verdicts import ours, verdict


@pytest.mark.parametrize("name", ["pressure_feedback", "second_order_compensator", "sample_time", "robot_joint"])
def test_futile_here_and_of_use_on_the_robot(claims, name):
    assert verdict(claims[name]) == "reproduced"


def test_pressure_feedback_damps_the_robot_s_joint_tenfold_and_not_the_bar(claims):
    without, drawn, turned, *_ = ours(claims["pressure_feedback"])
    assert drawn == pytest.approx(without, rel=0.01)
    assert without < turned < 2 * without
    _, robot_without, robot_drawn, *_ = ours(claims["robot_joint"])
    assert robot_drawn > 10 * robot_without


def test_the_pump_control_has_to_be_the_faster_one_unless_the_sign_is_turned(claims):
    own, needed, most = ours(claims["pump_over_hydraulics"])
    assert own == pytest.approx(280 / 834, rel=2e-3)
    assert needed > 1.0
    assert most > 0.5
    assert verdict(claims["pump_over_hydraulics"]) == "holds only with the sign as drawn"


def test_slow_hydraulics_of_this_actuator_can_be_damped(with_settings):
    heavy = with_settings("pressure_feedback", "actuator.front.motor.inertia=20 kg*m^2")
    assert verdict(heavy).startswith("does not follow")
