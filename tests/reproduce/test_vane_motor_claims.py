"""Vane motor and main circuit."""

import math

import pytest
from verdicts import ours, verdict


def test_torque_losses_of_2_to_5_percent_more_than_double_the_damping(claims):
    frictions, damping, table = ours(claims["friction_and_damping"])
    assert frictions == pytest.approx((29.9, 74.8), rel=2e-3)
    assert damping[1] / damping[0] > 2.4
    assert table[1] / table[0] > 3.5
    assert verdict(claims["friction_and_damping"]) == "contradicts itself"


def test_leakage_is_a_small_part_of_the_damping(claims):
    assert ours(claims["leakage_and_damping"])[2] == pytest.approx(6.6, abs=0.1)
    assert verdict(claims["leakage_and_damping"]) == "does not follow from Table 2"


def test_without_friction_leakage_would_be_all_of_it(with_settings):
    claim = with_settings("leakage_and_damping", "actuator.front.motor.viscous_friction=0 Nms/rad")
    assert ours(claim)[2] == pytest.approx(100.0)


def test_static_friction_sticks_and_slips_below_the_closed_form_s_rate(claims):
    slope, damping, rate = ours(claims["stick_slip"])
    assert slope > damping
    assert math.radians(rate) == pytest.approx(math.log(slope / damping) / 20.0, rel=0.02)
    assert verdict(claims["stick_slip"]).startswith("holds only where")


def test_much_viscous_friction_keeps_it_from_slipping(with_settings):
    assert verdict(with_settings("stick_slip", "actuator.front.motor.viscous_friction=310 Nms/rad")) == "reproduced"


def test_one_side_alone_is_slower_by_the_root_of_two(claims):
    series, one_sided = ours(claims["one_sided_capacitance"])
    assert series / one_sided == pytest.approx(math.sqrt(2), rel=1e-4)
    assert verdict(claims["one_sided_capacitance"]) == "contradicts itself"
