"""Lines and chambers: two volumes in series, and what their oil does when it is compressed."""

import math

import pytest
from bench import circuit, one_sided
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.line import ONE_SIDED, SERIES, Line, capacitance, capacitance_slope, middle_volume
from ars_mujoco.schema.document import Document
from ars_mujoco.schema.errors import InputError

FRONT, REAR = circuit("front"), circuit("rear")
LINES, SIDES = (FRONT.line, one_sided().line), ("series", "one_sided")
ANGLES, PRESSURES = st.floats(-math.pi / 4, math.pi / 4), st.floats(-3e7, 3e7)
BULK_MODULUS = 1.4e9  # Pa


def test_a_side_holds_its_line_and_half_the_motor():
    assert middle_volume(FRONT.line, FRONT.motor) == pytest.approx(2.62e-4 + 5.24e-4 / 8)


@given(angle=ANGLES, pressure=PRESSURES)
def test_the_two_sides_are_capacitances_in_series(angle, pressure):
    line, motor = circuit().line, FRONT.motor
    middle = middle_volume(line, motor)
    line.capacitance = middle / (2.0 * BULK_MODULUS)
    swept = motor.displacement * angle
    series = 1.0 / (BULK_MODULUS * (1.0 / (middle + swept) + 1.0 / (middle - swept)))
    assert capacitance(line, motor, angle, pressure) == pytest.approx(series, rel=1e-12, abs=0.0)


@given(angle=ANGLES, pressure=st.floats(1.0, 3e7))
def test_one_sided_the_high_pressure_side_counts_alone(angle, pressure):
    line, motor = one_sided().line, FRONT.motor
    middle = middle_volume(line, motor)
    line.capacitance = middle / BULK_MODULUS
    swept = motor.displacement * angle
    side_a, side_b = (middle + swept) / BULK_MODULUS, (middle - swept) / BULK_MODULUS
    assert capacitance(line, motor, angle, pressure) == pytest.approx(side_a, rel=1e-12, abs=0.0)
    assert capacitance(line, motor, angle, -pressure) == pytest.approx(side_b, rel=1e-12, abs=0.0)


@pytest.mark.parametrize("line", LINES, ids=SIDES)
@given(angle=ANGLES, pressure=PRESSURES)
def test_a_mirrored_state_has_the_same_capacitance_to_the_last_bit(line, angle, pressure):
    now, mirrored = (capacitance(line, FRONT.motor, side * angle, side * pressure) for side in (1.0, -1.0))
    assert now == mirrored


@pytest.mark.parametrize("line", LINES, ids=SIDES)
@given(angle=ANGLES, pressure=PRESSURES)
def test_the_slope_is_that_of_the_capacitance(line, angle, pressure):
    ahead, behind = (capacitance(line, FRONT.motor, angle + h, pressure) for h in (1e-5, -1e-5))
    expected = (ahead - behind) / 2e-5
    assert capacitance_slope(line, FRONT.motor, angle, pressure) == pytest.approx(expected, abs=1e-22)


def test_a_file_names_the_sides_and_leaves_them_in_series_unless_it_does():
    values = {"volume": "0.262 L", "capacitance": "1e-13 m^3/Pa"}
    assert Line(**values).sides == Line(**values, sides="series").sides == SERIES
    assert Line(**values, sides="one_sided").sides == ONE_SIDED
    assert Line(**values, sides="one_sided").model_dump(mode="json")["sides"] == "one_sided"


def test_other_sides_are_refused_with_those_there_are():
    with pytest.raises(InputError) as refusal:
        Document("line.yaml", "volume: 0.262 L\ncapacitance: 1e-13 m^3/Pa\nsides: one_side").validate(Line)
    known = "unknown; did you mean 'one_sided'?; allowed: series, one_sided"
    assert str(refusal.value) == f"line.yaml:3: sides: 'one_side': {known}"


def test_the_shipped_rear_line_is_the_front_one_with_more_of_the_same_oil():
    ratio = middle_volume(REAR.line, REAR.motor) / middle_volume(FRONT.line, FRONT.motor)
    assert REAR.line.volume > FRONT.line.volume
    assert REAR.line.capacitance == pytest.approx(ratio * FRONT.line.capacitance, rel=2e-3, abs=0.0)
