"""Lines and chambers: two volumes in series, and what their oil does when it is compressed."""

import math

import pytest
from bench import circuit
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.line import capacitance, capacitance_slope, middle_volume

FRONT, REAR = circuit("front"), circuit("rear")
ANGLES = st.floats(-math.pi / 4, math.pi / 4)
BULK_MODULUS = 1.4e9  # Pa


def test_a_side_holds_its_line_and_half_the_motor():
    assert middle_volume(FRONT.line, FRONT.motor) == pytest.approx(2.62e-4 + 5.24e-4 / 8)


@given(angle=ANGLES)
def test_the_two_sides_are_capacitances_in_series(angle):
    line, motor = circuit().line, FRONT.motor
    middle = middle_volume(line, motor)
    line.capacitance = middle / (2.0 * BULK_MODULUS)
    swept = motor.displacement * angle
    series = 1.0 / (BULK_MODULUS * (1.0 / (middle + swept) + 1.0 / (middle - swept)))
    assert capacitance(line, motor, angle) == pytest.approx(series, rel=1e-12, abs=0.0)


@given(angle=ANGLES)
def test_the_slope_is_that_of_the_capacitance(angle):
    ahead, behind = (capacitance(FRONT.line, FRONT.motor, angle + h) for h in (1e-5, -1e-5))
    expected = (ahead - behind) / 2e-5
    assert capacitance_slope(FRONT.line, FRONT.motor, angle) == pytest.approx(expected, abs=1e-22)


def test_the_shipped_rear_line_is_the_front_one_with_more_of_the_same_oil():
    ratio = middle_volume(REAR.line, REAR.motor) / middle_volume(FRONT.line, FRONT.motor)
    assert REAR.line.volume > FRONT.line.volume
    assert REAR.line.capacitance == pytest.approx(ratio * FRONT.line.capacitance, rel=2e-3, abs=0.0)
