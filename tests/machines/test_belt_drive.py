"""The belt drive: a constant speed, a table, or an engine with its belt's ratio."""

import math

import numpy as np
import pytest
from pydantic import TypeAdapter
from records import blank

from ars_mujoco.machines.belt_drive import (
    BELT_DRIVE,
    BeltDrive,
    BeltDriveState,
    fill_belt_drive,
    first_speed,
    pump_speed,
)

RPM = math.pi / 30.0


def record(**file):
    made = np.zeros(1, BELT_DRIVE).view(np.recarray)[0]
    fill_belt_drive(made, TypeAdapter(BeltDrive).validate_python(file))
    return made


def speed(drive, time=0.0, road_speed=0.0):
    return pump_speed(drive, blank(BeltDriveState), blank(BeltDriveState), time, road_speed)


def test_a_constant_speed_is_that():
    drive = record(kind="constant", speed="3000 rpm")
    assert speed(drive) == first_speed(drive) == pytest.approx(3000 * RPM)


def test_a_table_is_followed():
    drive = record(kind="table", speed={"join": "linear", "knots": [["1 s", "3000 rpm"], ["2 s", "0 rpm"]]})
    assert first_speed(drive) == pytest.approx(3000 * RPM)
    assert [speed(drive, time) for time in (0.0, 1.5, 3.0)] == pytest.approx([3000 * RPM, 1500 * RPM, 0.0])


def test_at_an_idle_of_650_rpm_the_belt_turns_the_pump_at_750():
    drive = record(kind="engine", idle_speed="650 rpm", pump_ratio="1.15")
    assert speed(drive) == first_speed(drive) == pytest.approx(750 * RPM, rel=0.005)


def test_the_engine_shifts_with_the_road_speed():
    drive, later = record(kind="engine", pump_ratio="1.15"), blank(BeltDriveState)
    fast = pump_speed(drive, blank(BeltDriveState), later, 0.0, 100.0 / 3.6)
    assert later.gear == 4.0
    assert fast == pytest.approx(1.15 * 2864 * RPM, rel=0.01)
