"""The electric drive: within its limits, within its share, and with every watt accounted for."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.machines.electric_drive import current_rate, granted, power_share, running, wish
from ars_mujoco.machines.electric_machine import DRIVEN, OPEN, SHORTED
from ars_mujoco.schema.document import read

DRIVE = filled(read(actuator_schema(), "electro_hydrostatic", "actuator").value.front.drive)
U = 48.0  # V
SPEEDS, TORQUES = st.floats(-400.0, 400.0), st.floats(-12.0, 12.0)


def drawn_at(current: float, speed: float) -> float:
    return running(DRIVE, current, speed, U, DRIVEN).drawn


@pytest.mark.parametrize(("rpm", "most"), [(0, 9.0), (2500, 9.0), (3000, 8.4)])
def test_it_gives_the_torque_that_current_and_voltage_allow(rpm, most):
    assert 0.12 * wish(DRIVE, 20.0, rpm * math.pi / 30.0, U, DRIVEN).current == pytest.approx(most, rel=0.03)


@given(SPEEDS, TORQUES)
def test_what_it_draws_is_work_and_heat(speed, torque):
    wished = wish(DRIVE, torque, speed, U, DRIVEN)
    run = running(DRIVE, wished.current, speed, U, DRIVEN)
    assert run.drawn == pytest.approx(run.torque * speed + run.copper + run.inverter)
    assert run.drawn >= wished.power - 1e-9  # a wish does not yet know of the current that weakens the field


@given(SPEEDS, TORQUES, st.floats(0.0, 1.0))
def test_a_share_of_its_power_is_not_passed(speed, torque, share):
    wished = wish(DRIVE, torque, speed, U, DRIVEN)
    current = granted(DRIVE, wished, share, speed, U)
    assert abs(current) <= abs(wished.current)
    assert current * wished.current >= 0.0
    if wished.power > 0.0 and abs(speed) < 250.0 and current != 0.0:  # where the field is not weakened
        standby = 6.0  # W, of an inverter that is on
        assert drawn_at(current, speed) <= max(share * wished.power, standby) + 1e-9 * wished.power


def test_two_drives_share_a_budget_and_what_one_gives_back_feeds_the_other():
    assert power_share(1000.0, 600.0, 300.0) == 1.0
    assert power_share(1000.0, 1500.0, 500.0) == pytest.approx(0.5)
    assert power_share(1000.0, 1500.0, -500.0) == 1.0
    assert power_share(1000.0, 3000.0, -500.0) == pytest.approx(0.5)


def test_with_open_phases_it_neither_draws_nor_brakes():
    assert running(DRIVE, 20.0, 300.0, U, OPEN) == (0.0, 0.0, 0.0, 0.0)
    assert wish(DRIVE, 5.0, 100.0, U, OPEN) == (0.0, 0.0)


@pytest.mark.parametrize("speed", [-300.0, -20.0, 5.0, 60.0, 330.0])
def test_shorted_it_brakes_and_turns_the_work_to_heat(speed):
    run = running(DRIVE, 0.0, speed, U, SHORTED)
    assert run.torque * speed < 0.0
    assert run.copper == pytest.approx(-run.torque * speed)
    assert run.drawn == 0.0


def test_its_current_follows_at_300_hertz():
    assert current_rate(DRIVE, 10.0, 14.0) == pytest.approx(4.0 * math.tau * 300.0, rel=1e-3)
