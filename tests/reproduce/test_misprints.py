"""Equations as printed, beside their right forms."""

import math

import pytest
from verdicts import ours, verdict


def test_a_closed_chamber_keeps_its_oil_only_with_volumes_5_and_6_exchanged(claims):
    printed, right = ours(claims["chamber_equations"])
    share = 1.54e-4 * 5e-3 / (4e-7 + 1.54e-4 * 5e-3)
    assert printed == pytest.approx(100 * (1 - share) ** 2, rel=1e-5)
    assert right == pytest.approx(100.0, abs=1e-4)
    assert verdict(claims["chamber_equations"]) == "contradicts itself"


def test_eq_4_leaves_the_closed_cylinder_without_a_spring(claims):
    right, printed = ours(claims["chamber_b"])
    assert right == pytest.approx(2 * 1.4e9 * 1.54e-4**2 / 1.17e-6 / 1e6)
    assert printed == 0.0
    assert verdict(claims["chamber_b"]) == "contradicts itself"


@pytest.mark.parametrize(("name", "share"), [("cylinder_capacitance", 0.77 / 1.17), ("motor_capacitance", 0.2)])
def test_chambers_in_series_take_a_minus(claims, name, share):
    printed, right = ours(claims[name])
    assert printed == pytest.approx((1 + share**2) / (1 - share**2), rel=1e-3)
    assert right == pytest.approx(1.0, rel=1e-9)
    assert verdict(claims[name]).startswith("does not follow from the equation's own")


def test_eq_11_needs_the_sign_of_y_in_its_root(claims):
    printed, right = ours(claims["valve_flow"])
    assert printed == pytest.approx(math.sqrt(15 / 35), rel=5e-3)
    assert right == pytest.approx(1.0, rel=1e-9)
    assert verdict(claims["valve_flow"]) == "does not follow from eqs. 9 and 10"


def test_eqs_11_and_14_hold_together_only_without_flow(claims):
    assert ours(claims["valve_flow_signs"]) == pytest.approx([2.0, 0.0], abs=1e-9)
    assert verdict(claims["valve_flow_signs"]) == "contradicts itself"


def test_the_printed_state_vector_misses_the_pressure(claims):
    assert ours(claims["state_vector"]) == [2, 3]
    assert verdict(claims["state_vector"]) == "contradicts itself"


def test_eq_20_as_printed_is_a_valve_of_32_rad_s(claims):
    right, printed = ours(claims["servo_pump_lag"])
    assert right == pytest.approx(420.0, rel=1e-4)
    assert printed == pytest.approx(math.sqrt(420.0) * math.sqrt(1 + math.sqrt(2)), rel=0.01)  # hardly damped
    assert verdict(claims["servo_pump_lag"]) == "contradicts itself"


def test_the_printed_polynomial_depends_on_the_units_put_in(claims):
    right, printed, in_bar = ours(claims["loss_polynomial"])
    assert right == pytest.approx(0.095)
    assert printed != pytest.approx(in_bar, rel=0.1)
    assert verdict(claims["loss_polynomial"]) == "contradicts itself"


def test_one_arm_is_within_a_percent_of_two_at_the_greatest_angle(claims):
    assert ours(claims["bar_twist"])[1] == pytest.approx(math.degrees(2 * math.asin(0.5 * math.sin(0.25238))), rel=1e-4)
    assert verdict(claims["bar_twist"]) == "reproduced within 0.8 %"


def test_four_symbols_have_another_unit_than_they_need(claims):
    assert ours(claims["units"]) == [7, 4]
    assert all(name in claims["units"].why for name in ("c_stabi", "C_H", "r_v", "B^2"))
