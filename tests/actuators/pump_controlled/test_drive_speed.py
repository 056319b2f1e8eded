"""Drive: how it sets both pumps' speed, and who pays for their work."""

import numpy as np
import pytest
from bench import axle, circuit
from pydantic import TypeAdapter
from records import blank

from ars_mujoco.actuators.pump_controlled.drive import Drive, fill_drive
from ars_mujoco.actuators.pump_controlled.drive_speed import DRIVE, DriveOutput, DriveState, set_speed, take_work
from ars_mujoco.actuators.pump_controlled.substeps import substeps

RPM = np.pi / 30
H = 1e-3
RAMP = {"kind": "table", "speed": {"join": "linear", "knots": [["1 s", "800 rpm"], ["3 s", "6000 rpm"]]}}


def record(block: dict):
    """The DRIVE record of a block as it stands in an actuator's file."""
    filled = np.zeros(1, DRIVE).view(np.recarray)[0]
    fill_drive(filled, TypeAdapter(Drive).validate_python(block))
    return filled


def pumps(front=314.0, rear=200.0):
    """The Pump records of two circuits at these speeds (rad/s)."""
    both = circuit().pump, circuit("rear").pump
    both[0].speed, both[1].speed = front, rear
    return both


def set_at(drive, time=0.0, road_speed=0.0, now=None):
    """(pump speeds, DriveState, DriveOutput) of a step that begins at `time`."""
    both, later, out = pumps(), blank(DriveState), blank(DriveOutput)
    set_speed(drive, now or blank(DriveState), later, out, both, time, road_speed)
    return [pump.speed for pump in both], later, out


def test_a_constant_drive_leaves_each_pump_its_own_speed():
    speeds, _, out = set_at(record({"kind": "constant"}), 5.0, 30.0)
    assert speeds == [314.0, 200.0]
    assert out.speed == 314.0


@pytest.mark.parametrize(("time", "rpm"), [(0, 800), (1, 800), (2, 3400), (3, 6000), (9, 6000)])
def test_a_table_gives_both_pumps_its_speed_at_the_time(time, rpm):
    speeds, _, out = set_at(record(RAMP), time)
    assert speeds == pytest.approx([rpm * RPM] * 2)
    assert out.speed == pytest.approx(rpm * RPM)


def test_a_belt_turns_the_pumps_faster_than_the_engine():
    speeds, _, out = set_at(record({"kind": "engine", "pump_ratio": "1.5"}))
    assert out.speed == pytest.approx(800 * RPM)
    assert speeds == pytest.approx([1200 * RPM] * 2)


def test_an_engine_tells_its_gear_as_a_driver_counts_it():
    _, later, out = set_at(record({"kind": "engine"}), road_speed=120 / 3.6)
    assert (later.gear, out.gear) == (4.0, 5.0)


def test_an_electric_drive_runs_at_its_speed_less_its_slip():
    now = blank(DriveState)
    now.slip = 10.0
    speeds, _, _ = set_at(record({"kind": "electric"}), now=now)
    assert speeds == pytest.approx([3000 * RPM - 10.0] * 2)


@pytest.mark.parametrize("kind", ["constant", "engine"])
def test_mechanical_drives_give_what_the_pumps_take(kind):
    out = blank(DriveOutput)
    take_work(record({"kind": kind}), blank(DriveState), blank(DriveState), out, -0.3, 0.0, H)
    assert out.power == pytest.approx(-300.0)


def test_a_loaded_electric_drive_settles_where_its_torque_is_the_pumps():
    drive, now, out = record({"kind": "electric"}), blank(DriveState), blank(DriveOutput)
    for _ in range(100):
        take_work(drive, now, now, out, 6.0 * (3000 * RPM - now.slip) * H, 1.0, H)  # 6 Nm of pumps
    assert now.slip == pytest.approx(6.0 / 0.75)
    speed = 3000 * RPM - 8.0
    torque = 6.0 + 4e-4 * speed + 0.03  # the machine's own drag
    current = torque / 0.096
    heat = 1.5 * 0.018 * current**2 + 6.0 + 0.012 * 24.0 * current
    assert out.power == pytest.approx(torque * speed + heat, rel=1e-6)


def test_an_overloaded_electric_drive_stalls_and_does_not_turn_back():
    drive, now, out = record({"kind": "electric"}), blank(DriveState), blank(DriveOutput)
    slips = []
    for _ in range(300):
        take_work(drive, now, now, out, 20.0 * (3000 * RPM - now.slip) * H, 1.0, H)
        slips.append(now.slip)
    one_step = 12.0 / 0.004 * H  # from a stand, before the pumps load it
    assert max(slips) == 3000 * RPM
    assert min(slips[-100:]) >= 3000 * RPM - one_step - 1e-9


def test_a_drive_that_may_stop_stands_2_s_after_the_last_command_and_wakes_with_the_next():
    drive, now, out = record({"kind": "electric", "standby_speed": "0 rpm"}), blank(DriveState), blank(DriveOutput)
    speeds = []
    for i in range(4000):
        asked = np.radians(2.0) if i < 500 or i >= 3500 else np.radians(0.5)
        take_work(drive, now, now, out, 0.4 * (3000 * RPM - now.slip) * H, asked, H)  # what idling pumps take
        speeds.append(3000 * RPM - now.slip)
    settled = 3000 * RPM - 0.4 / 0.75
    assert speeds[2490] == pytest.approx(settled, rel=1e-6)
    assert speeds[3499] == pytest.approx(0.0, abs=0.6)
    ran_up = next(i for i, speed in enumerate(speeds[3500:]) if speed > 0.94 * 3000 * RPM)
    assert H * ran_up == pytest.approx(0.94 * 0.108, rel=0.05)


def test_setting_the_speed_again_changes_nothing():
    now = blank(DriveState)
    now.gear = 2.0
    drive = record({"kind": "engine"})
    first, again = set_at(drive, 1.0, 14.0, now), set_at(drive, 1.0, 14.0, now)
    assert first == again
    assert now.gear == 2.0


def test_the_speed_does_not_change_how_many_substeps_a_step_needs():
    counts = set()
    for rpm in (1e-3, 800, 3000, 6000):
        parameters = circuit()
        parameters.pump.speed = rpm * RPM
        counts.add(substeps(axle(parameters), H))
    assert len(counts) == 1
