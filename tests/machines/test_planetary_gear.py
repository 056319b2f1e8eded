"""Planetary gear: friction in all four quadrants, backlash, stiffness; and the inverter's losses."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.machines.inverter import Inverter, inverter_loss
from ars_mujoco.machines.planetary_gear import PlanetaryGear, gear_friction, mesh_energy, mesh_torque

ETA, M_0 = 0.88, 8.0
GEAR = filled(
    PlanetaryGear(
        ratio=160, efficiency=ETA, friction="8 Nm", damping="0 Nms/rad", sign_speed="0.5 deg/s", backlash="0.2 deg",
        stiffness="4e4 Nm/rad",
    )
)  # fmt: skip
FAST = 0.5  # rad/s of the output


def output(driving: float, speed: float) -> float:
    """Torque (Nm) that the output gives at constant speed for i T of the machine: M = i T - friction(i T, M)."""
    load = 0.0
    for _ in range(200):
        load = driving - gear_friction(GEAR, driving, load, speed)
    return load


@pytest.mark.parametrize("driving", [200.0, 900.0, 1440.0])
def test_driving_the_output_gets_the_share_eta(driving):
    lossless = 0.5 * M_0 * (1.0 + ETA)  # of the friction that is there without load
    assert output(driving, FAST) == pytest.approx(ETA * driving - lossless, rel=1e-9)


@pytest.mark.parametrize("load", [300.0, 1000.0])
def test_driven_back_the_machine_gets_eta_which_is_within_2_percent_of_the_exact_share(load):
    held = (load - M_0 - (1 - ETA) / (1 + ETA) * load) / (1 + (1 - ETA) / (1 + ETA))
    assert output(held, -FAST) == pytest.approx(load, rel=1e-9)
    assert (held + M_0) / load == pytest.approx(2 - 1 / ETA, rel=0.025)


@given(driving=st.floats(-1500, 1500), load=st.floats(-1500, 1500), speed=st.floats(-3, 3))
def test_friction_never_drives_and_is_the_same_mirrored(driving, load, speed):
    friction = gear_friction(GEAR, driving, load, speed)
    assert friction * speed >= 0.0
    assert gear_friction(GEAR, -driving, -load, -speed) == -friction


@given(twist=st.floats(-0.05, 0.05))
def test_the_teeth_carry_nothing_within_the_backlash_and_are_a_spring_beyond(twist):
    half = math.radians(0.1)
    expected = math.copysign(4e4 * max(abs(twist) - half, 0.0), twist)
    assert mesh_torque(GEAR, twist) == pytest.approx(expected, abs=1e-9)
    assert mesh_energy(GEAR, twist) == pytest.approx(expected**2 / 8e4, abs=1e-12)


def test_half_the_backlash_is_worth_20_Nm_of_the_bars_torque():
    assert 5700.0 * 2 * math.radians(0.1) == pytest.approx(20.0, abs=0.2)


def test_an_inverter_loses_its_standby_and_a_share_of_its_apparent_power():
    inverter = filled(Inverter(standby_power="6 W", loss_share="1.2 %"))
    assert inverter_loss(inverter, 48.0, 0.0) == 6.0
    assert inverter_loss(inverter, 48.0, 75.0) == pytest.approx(6.0 + 0.012 * 48.0 * 0.5 * 75.0)
