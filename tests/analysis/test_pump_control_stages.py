"""Whether the servo valve dominates the inner loop."""

import math

import numpy as np
import pytest
from full_theory import softness
from theory import LOOP, pump_polynomial, same_poles

from ars_mujoco.actuators.pump_controlled.pump_control import FULL
from ars_mujoco.analysis import pump_control_stages
from ars_mujoco.analysis.pump_control_stages import cylinder_frequency, with_cylinder_frequency

RESULT = pump_control_stages.compute(LOOP)


def poles(row):
    upper = np.array(row["poles"]) @ [1, 1j]
    return np.concatenate([upper, upper[upper.imag > 0].conj()])


def test_the_cylinder_s_frequency_is_that_of_eq_16():
    cylinder = LOOP.circuit.control_cylinder
    volume = cylinder.dead_volume + cylinder.area * cylinder.travel
    series = 0.5 * volume * softness(LOOP.at_stage(FULL), 13.5e5)
    expected = math.sqrt((cylinder.area**2 / series + cylinder.centring_stiffness) / cylinder.mass)
    assert cylinder_frequency(LOOP) == pytest.approx(expected, rel=1e-9)
    assert RESULT["cylinder"] == pytest.approx(2632, abs=2)


def test_it_is_40_times_the_valve_s_and_within_the_paper_s_range():
    assert RESULT["cylinder"] / RESULT["valve"] == pytest.approx(39, abs=1)
    assert 400 < RESULT["cylinder"] < 12600


@pytest.mark.parametrize("stage", ["reduced", "full"])
def test_the_cylinder_s_own_pair_lies_at_that_frequency(stage):
    fastest = np.abs(poles(RESULT["stages"][stage])).max()
    assert fastest == pytest.approx(2 * math.pi * RESULT["cylinder"], rel=1e-2)


def test_the_third_order_has_the_poles_of_eqs_18_to_20():
    assert same_poles(poles(RESULT["stages"]["third_order"]), pump_polynomial(LOOP))


@pytest.mark.parametrize("stage", ["reduced", "full"])
def test_the_three_slowest_poles_are_within_1_percent_those_of_the_third_order(stage):
    slow = sorted(poles(RESULT["stages"]["third_order"]), key=abs)
    for pole in slow:
        assert np.abs(poles(RESULT["stages"][stage]) - pole).min() < 0.011 * abs(pole)


def test_the_cylinder_moves_bandwidth_and_phase_by_less_than_1_percent():
    third, full = RESULT["stages"]["third_order"], RESULT["stages"]["full"]
    assert third["bandwidth"] == pytest.approx(280 / (2 * math.pi), rel=1e-4)
    assert full["bandwidth"] == pytest.approx(third["bandwidth"], rel=0.011)
    assert full["phase"] == pytest.approx(third["phase"], abs=0.5)
    assert full["stable"] == pytest.approx(third["stable"], rel=0.005)


def test_even_the_slowest_cylinder_of_the_paper_s_range_costs_2_deg_and_3_percent_of_the_gain():
    third, slow = RESULT["stages"]["third_order"], RESULT["range"]["400"]
    assert third["phase"] - slow["phase"] == pytest.approx(2.0, abs=0.2)
    assert slow["stable"] == pytest.approx(0.975 * third["stable"], rel=0.005)


def test_within_dry_friction_the_valve_does_not_dominate():
    third, dry = RESULT["stages"]["third_order"], RESULT["with_dry_friction"]
    assert third["phase"] - dry["phase"] == pytest.approx(10.6, abs=0.5)
    assert dry["bandwidth"] == pytest.approx(37.5, abs=0.2)


def test_a_lighter_piston_is_faster():
    assert cylinder_frequency(with_cylinder_frequency(LOOP, 5e4)) == pytest.approx(5e4)
