"""Pump drive: its rotor by closed forms, its power by the first law, its start as fast as it was derived."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.machines.electric_machine import copper_loss, drag, field_current, torque_constant
from ars_mujoco.machines.pump_drive import PumpDrive, PumpMachine, electrical_power, turn, wanted_slip

DRIVE = filled(PumpDrive(kind="electric"))
STRONG = filled(PumpDrive(kind="electric", voltage="1e6 V", machine={"current_limit": "1e7 A"}))
H, FULL = 1e-3, 100.0 * math.pi  # s; rad/s, 3000 rpm


def turned(drive, slip, load, steps, wanted=0.0):
    """The slips (rad/s) from `slip` on, and the drive's mean torques (Nm)."""
    slips, torques = [slip], []
    for _ in range(steps):
        slip, torque = turn(drive, slips[-1], wanted, load, H)
        slips.append(slip)
        torques.append(torque)
    return np.array(slips), np.array(torques)


@pytest.mark.parametrize("load", [0.0, 6.0, -4.0])
def test_the_rotor_settles_exponentially_where_its_torque_is_the_load(load):
    time, settled = H * np.arange(51), load / 0.75
    slips, torques = turned(STRONG, FULL, load, 50)
    expected = settled + (FULL - settled) * np.exp(-0.75 / 0.004 * time)
    assert slips == pytest.approx(expected, rel=1e-9)
    assert turned(STRONG, FULL, load, 200)[1][-1] == pytest.approx(load, abs=1e-9)
    assert torques[0] == pytest.approx(0.75 * (slips[0] + slips[1]) / 2, rel=0.02)


def test_from_a_stand_it_starts_against_idling_pumps_in_108_ms():
    slips, torques = turned(DRIVE, FULL, 0.4, 300)
    assert torques[:90] == pytest.approx(12.0, abs=0.2)  # but for the machine's own drag
    reached = H * np.argmax(slips < 12.0 / 0.75)  # from where the speed loop takes over
    assert reached == pytest.approx(0.108 * (1.0 - 16.0 / FULL), rel=0.02)
    assert slips[-1] == pytest.approx(0.4 / 0.75)


@pytest.mark.parametrize("inertia", [1e-6, 1e-4, 0.004, 1.0])
def test_no_inertia_makes_it_overshoot(inertia):
    drive = DRIVE.copy()
    drive.inertia = inertia
    slips, torques = turned(drive, FULL, 2.0, 100)
    assert np.all(np.diff(slips) <= 1e-12) and slips[-1] >= 2.0 / 0.75 - 1e-12
    assert np.abs(torques).max() <= 12.0


def test_at_12_Nm_and_3000_rpm_it_uses_26_1_of_26_3_V_and_heats_its_windings_with_422_W():
    machine = filled(PumpMachine())
    current, electrical = 12.0 / torque_constant(machine), 4 * FULL
    assert current == pytest.approx(125.0)
    assert copper_loss(machine, current, 0.0) == pytest.approx(422.0, abs=0.5)
    volts = math.hypot(electrical * 85e-6 * current, 0.018 * current + electrical * 0.016)
    assert volts == pytest.approx(26.1, abs=0.1)
    assert field_current(machine, current, FULL, 48.0) == 0.0


@given(slip=st.floats(-300, 300), load=st.floats(-30, 30))
def test_torque_times_mean_speed_is_what_the_load_takes_and_the_rotor_gains(slip, load):
    later, torque = turn(DRIVE, slip, 0.0, load, H)
    before, after = FULL - slip, FULL - later
    gained = 0.5 * DRIVE.inertia * (after**2 - before**2)
    mean = 0.5 * (before + after)
    assert torque * mean * H == pytest.approx(gained + load * mean * H, abs=1e-9)


@given(torque=st.floats(-11, 11), speed=st.floats(1, 300))
def test_the_supply_pays_the_shaft_and_every_loss(torque, speed):
    whole = torque + drag(DRIVE.machine, speed)
    current = whole / 0.096
    heat = 1.5 * 0.018 * current**2 + 6.0 + 0.012 * 24.0 * abs(current)
    assert electrical_power(DRIVE, torque, speed) == pytest.approx(whole * speed + heat, rel=1e-9, abs=1e-9)


def test_it_rests_only_after_its_hold_and_only_where_it_may():
    resting = filled(PumpDrive(kind="electric", standby_speed="800 rpm"))
    assert wanted_slip(DRIVE, 100.0) == 0.0
    assert wanted_slip(resting, 1.999) == 0.0
    assert wanted_slip(resting, 2.0) == pytest.approx(2200 * math.pi / 30)
