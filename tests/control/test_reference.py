"""The reference as a control unit computes it: from the filtered reading, once a sample, with the trim on roll."""

import numpy as np
import pytest
from records import blank, filled

from ars_mujoco.actuators.bars import STIFFNESS
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.control.reference import PARAMETERS, STATE, own_reference
from ars_mujoco.control.sensors import Sensors

STEP = 1e-3
TORSIONS = np.rec.array([(5700.0, 5000.0)], STIFFNESS)[0]  # Nm/rad


def reference(trim_rate=0.0):
    """A linear map of 0.02 rad front and 0.01 rad rear, 0.002 rad of roll, over 10 m/s^2; in full from 3 m/s on."""
    record = np.zeros(1, PARAMETERS).view(np.recarray)[0]
    record.map.count = 2
    record.map.sensor[1], record.map.front[1], record.map.rear[1], record.map.roll[1] = 10.0, 0.02, 0.01, 0.002
    record.fade.begin, record.fade.full = 1.0, 3.0
    record.trim.rate, record.trim.limit = trim_rate, 0.05
    return record


def commands(record, readings, sample_time, roll=0.0, speed=30.0):
    """(front, rear) (n, 2) for the readings of successive steps."""
    unit, sensors, found = filled(ControlUnit(sample_time=sample_time, delay="0 s")), blank(Sensors), []
    state = np.zeros(1, STATE).view(np.recarray)[0]
    sensors.step, sensors.roll, sensors.speed = max(unit.sample_time, STEP), roll, speed
    for i, reading in enumerate(readings):
        sensors.time, sensors.lateral_acceleration = i * STEP, reading
        own_reference(record, unit, TORSIONS, state, sensors, STEP)
        found.append((float(state.front), float(state.rear)))
    return np.array(found)


def test_each_axle_gets_its_own_angle():
    assert commands(reference(), [5.0], "1 ms") == pytest.approx(np.array([[0.01, 0.005]]))


def test_the_command_is_held_between_samples():
    readings = np.linspace(0.0, 4.0, 20)
    assert commands(reference(), readings, "5 ms")[:, 0] == pytest.approx(np.repeat(0.002 * readings[::5], 5))


@pytest.mark.parametrize("sample_time", ["1 ms", "5 ms"])
def test_roll_outward_of_its_target_winds_both_bars_up(sample_time):
    trimmed = commands(reference(trim_rate=2.0), np.full(500, 5.0), sample_time, roll=0.004)
    untrimmed = np.array([0.01, 0.005])
    assert trimmed[-1] - untrimmed == pytest.approx(2.0 * (0.004 - 0.001) * 0.5, rel=1e-9)


def test_at_walking_pace_the_reference_acts_by_its_share():
    for speed, share in [(0.0, 0.0), (2.0, 0.5), (10.0, 1.0)]:
        assert commands(reference(), [5.0], "1 ms", speed=speed) == pytest.approx(share * np.array([[0.01, 0.005]]))
