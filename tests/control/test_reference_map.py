"""The reference map: odd, linear between its knots, held beyond the last."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.control.reference_map import KNOTS, REFERENCE_MAP, bar_commands

SENSOR = [0.0, 3.0, 6.5, 9.0]
COLUMNS = {"front": [0.0, 0.08, 0.12, 0.10], "rear": [0.0, 0.06, 0.09, 0.095], "roll": [0.0, 0.0, 0.005, 0.023]}
COLUMNS |= {"front_torque": [0.0, 280.0, 550.0, 800.0], "rear_torque": [0.0, 190.0, 370.0, 540.0]}  # Nm


def table(sensor, **columns):
    record = np.zeros(1, REFERENCE_MAP).view(np.recarray)[0]
    record.count = len(sensor)
    record.sensor[: len(sensor)] = sensor
    for name, column in columns.items():
        record[name][: len(column)] = column
    return record


ORDERED = [COLUMNS[name] for name in ("front", "rear", "roll", "front_torque", "rear_torque")]

MAP = table(SENSOR, **COLUMNS)


def close(columns):
    """To rounding: angles of a tenth of a radian to 1e-15 rad, torques of hundreds of Nm to 1e-12 Nm."""
    return [pytest.approx(each, abs=within) for each, within in zip(columns, 3 * [1e-15] + 2 * [1e-12], strict=True)]


@given(reading=st.floats(0.0, 30.0))
def test_it_is_linear_between_its_knots_and_held_beyond(reading):
    expected = [np.interp(reading, SENSOR, column) for column in ORDERED]
    assert list(bar_commands(MAP, reading)) == close(expected)


@given(reading=st.floats(0.0, 30.0))
def test_it_is_odd(reading):
    assert bar_commands(MAP, -reading) == tuple(-angle for angle in bar_commands(MAP, reading))


@pytest.mark.parametrize("knot", range(4))
def test_a_knot_gives_its_own_angles(knot):
    assert list(bar_commands(MAP, SENSOR[knot])) == close([column[knot] for column in ORDERED])


def test_a_full_table_is_used_to_its_end():
    sensor = np.linspace(0.0, 10.0, KNOTS)
    full = table(sensor, front=0.01 * sensor)
    assert bar_commands(full, 9.9)[0] == pytest.approx(0.099)
    assert bar_commands(full, 20.0)[0] == pytest.approx(0.1)


def test_without_a_table_the_bars_stay_in_the_middle():
    assert bar_commands(table([]), 5.0) == (0.0, 0.0, 0.0, 0.0, 0.0)
