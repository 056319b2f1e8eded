"""The reference as a control unit computes it: from the filtered reading, once a sample, with the trim on roll."""

import numpy as np
import pytest
from records import blank, filled

from ars_mujoco.actuators.bars import STIFFNESS
from ars_mujoco.actuators.system import Twist, Twists
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.control.reference import (
    ANGLE,
    BOTH,
    PARAMETERS,
    STATE,
    TORQUE,
    commanded,
    own_reference,
    put,
    read_accelerometer,
)
from ars_mujoco.control.sensors import Sensors

STEP = 1e-3
TORSIONS = np.rec.array([(5700.0, 5000.0)], STIFFNESS)[0]  # Nm/rad


def reference(trim_rate=0.0):
    """A linear map of 0.02 rad and 80 Nm front, 0.01 rad and 60 Nm rear, 0.002 rad of roll, over 10 m/s^2; in full from
    3 m/s on.
    """
    record = np.zeros(1, PARAMETERS).view(np.recarray)[0]
    record.map.count = 2
    record.map.sensor[1], record.map.front[1], record.map.rear[1], record.map.roll[1] = 10.0, 0.02, 0.01, 0.002
    record.map.front_torque[1], record.map.rear_torque[1] = 80.0, 60.0
    record.fade.begin, record.fade.full = 1.0, 3.0
    record.trim.rate, record.trim.limit = trim_rate, 0.05
    return record


def states(record, readings, sample_time, **sensed):
    """The STATE after each of the readings of successive steps; `sensed` is what the sensors read all the time."""
    unit, sensors, found = filled(ControlUnit(sample_time=sample_time, delay="0 s")), blank(Sensors), []
    state = np.zeros(1, STATE).view(np.recarray)[0]
    sensors.step, sensors.speed = max(unit.sample_time, STEP), 30.0
    for name, value in sensed.items():
        sensors[name] = value
    for i, reading in enumerate(readings):
        sensors.time, sensors.lateral_acceleration = i * STEP, reading
        own_reference(record, unit, TORSIONS, state, sensors, STEP)
        found.append(state.copy())
    return found


def commands(record, readings, sample_time, **sensed):
    """Angles (front, rear) (n, 2), rad."""
    return np.array([(each.front, each.rear) for each in states(record, readings, sample_time, **sensed)])


def torques(record, readings, sample_time, **sensed):
    """Torques (front, rear) (n, 2), Nm."""
    return np.array([(each.front_torque, each.rear_torque) for each in states(record, readings, sample_time, **sensed)])


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


def test_each_axle_gets_the_torque_of_its_own_map():
    assert torques(reference(), [5.0], "1 ms") == pytest.approx(np.array([[40.0, 30.0]]))
    assert torques(reference(), [-5.0], "1 ms") == pytest.approx(np.array([[-40.0, -30.0]]))


def test_torques_are_held_between_samples_too():
    readings = np.linspace(0.0, 4.0, 20)
    assert torques(reference(), readings, "5 ms")[:, 1] == pytest.approx(np.repeat(6.0 * readings[::5], 5))


@pytest.mark.parametrize(("speed", "share"), [(2.0, 0.5), (30.0, 1.0)])
def test_what_the_trim_adds_to_the_angles_the_bars_turn_into_torques(speed, share):
    args, sensed = (np.full(500, 5.0), "1 ms"), {"roll": 0.004, "speed": speed}
    added = commands(reference(2.0), *args, **sensed) - commands(reference(), *args, **sensed)
    assert added[-1] == pytest.approx(share * 2.0 * (0.004 - 0.001) * 0.5, rel=1e-9)
    in_torque = torques(reference(2.0), *args, **sensed) - torques(reference(), *args, **sensed)
    assert in_torque == pytest.approx(added * [TORSIONS.front, TORSIONS.rear], rel=1e-9)


def test_damping_acts_in_both_at_any_speed():
    record = reference()
    record.trim.damping = 0.1
    still = {"roll_rate": 0.2, "speed": 0.0}
    assert commands(record, [5.0], "1 ms", **still) == pytest.approx(np.array([[0.02, 0.02]]))
    assert torques(record, [5.0], "1 ms", **still) == pytest.approx(np.array([[0.02 * 5700.0, 0.02 * 5000.0]]))


def test_at_walking_pace_torques_act_by_the_same_share():
    for speed, share in [(0.0, 0.0), (2.0, 0.5), (10.0, 1.0)]:
        assert torques(reference(), [5.0], "1 ms", speed=speed) == pytest.approx(share * np.array([[40.0, 30.0]]))


def test_what_was_last_computed_stays_until_the_next_sample():
    now, later = np.zeros(2, STATE).view(np.recarray)
    names = ("memory", "front", "rear", "front_torque", "rear_torque")
    for i, name in enumerate(names):
        now[name], later[name] = i + 1.0, np.nan
    read_accelerometer(reference(), now, later, blank(Sensors), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 0.0, STEP)
    for name in names:
        np.testing.assert_array_equal(later[name], now[name])


# ---- what is handed on

TWISTS = Twists(Twist(0.01, 0.3, 0.02), Twist(-0.02, -0.3, -0.03))


def handed_on(gives, **computed):
    """BarCommands (front, rear) of what was last computed."""
    record, state = reference(), np.zeros(1, STATE).view(np.recarray)[0]
    record.gives = gives
    for name, value in computed.items():
        state[name] = value
    return commanded(record, state, TORSIONS, TWISTS)


def test_the_target_map_gives_its_angles_and_its_torques():
    front, rear = handed_on(BOTH, front=0.05, rear=0.04, front_torque=300.0, rear_torque=200.0)
    assert (front.angle, front.torque) == ((0.05, 0.0, 0.0), 300.0)
    assert (rear.angle, rear.torque) == ((0.04, 0.0, 0.0), 200.0)


def test_a_laws_angle_becomes_the_torque_of_the_bar_turned_by_it():
    """M = c (phi - psi), by the twist as it is now, whatever torque was left in the state."""
    front, rear = handed_on(ANGLE, front=0.05, rear=0.04, front_torque=1e6, rear_torque=1e6)
    assert (front.angle, rear.angle) == ((0.05, 0.0, 0.0), (0.04, 0.0, 0.0))
    assert front.torque == pytest.approx(5700.0 * (0.05 - 0.01), rel=1e-15)
    assert rear.torque == pytest.approx(5000.0 * (0.04 + 0.02), rel=1e-15)


def test_a_laws_torque_becomes_the_angle_at_which_the_bar_gives_it():
    front, rear = handed_on(TORQUE, front=1e6, rear=1e6, front_torque=228.0, rear_torque=-300.0)
    assert (front.torque, rear.torque) == (228.0, -300.0)
    assert front.angle == pytest.approx((0.01 + 0.04, 0.0, 0.0), rel=1e-15)
    assert rear.angle == pytest.approx((-0.02 - 0.06, 0.0, 0.0), rel=1e-15)


@pytest.mark.parametrize(("gives", "kept"), [(ANGLE, ["front", "rear"]), (TORQUE, ["front_torque", "rear_torque"])])
def test_what_a_law_gives_is_kept_as_what_it_is(gives, kept):
    state = np.zeros(1, STATE).view(np.recarray)[0]
    put(state, gives, 3.0, 4.0)
    assert [state[name] for name in kept] == [3.0, 4.0]
    assert sum(state[name] for name in ("front", "rear", "front_torque", "rear_torque")) == 7.0
