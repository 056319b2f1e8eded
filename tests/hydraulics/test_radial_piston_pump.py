"""The radial piston pump: its flow limit, its losses, and the restrictor in its intake."""

import math

import pytest
from records import filled

from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.hydraulics.radial_piston_pump import intake_wanted, limited_flow, shaft_loss
from ars_mujoco.schema.document import read

FILE = read(actuator_schema(), "valve_controlled", "actuator").value.pump
PUMP = filled(FILE)
RPM, L_MIN, BAR = math.pi / 30.0, 1e-3 / 60.0, 1e5


@pytest.mark.parametrize(("speed", "flow"), [(750, 5.5), (1450, 8.8), (3000, 9.0), (6000, 9.0)])
def test_its_flow_is_limited(speed, flow):
    assert limited_flow(PUMP, speed * RPM, 1.0) / L_MIN == pytest.approx(flow, rel=0.006)


def test_far_under_the_limit_it_delivers_its_displacement():
    assert limited_flow(PUMP, 300 * RPM, 1.0) == pytest.approx(0.99 * 7.4e-6 * 5.0, rel=1e-6)


def test_a_pump_that_stands_delivers_nothing():
    assert limited_flow(PUMP, 0.0, 1.0) == 0.0


def test_the_restrictor_lowers_the_limit():
    assert limited_flow(PUMP, 3000 * RPM, 0.35) / L_MIN == pytest.approx(3.15, rel=1e-6)


def test_its_drag_at_3000_rpm_and_its_torque_loss_at_100_bar_are_those_of_eq_22():
    assert shaft_loss(PUMP, 3000 * RPM, 0.0) / (3000 * RPM) == pytest.approx(21.2 * 0.018, rel=1e-9)
    indicated = 7.4e-6 / math.tau * 100 * BAR
    loss = shaft_loss(PUMP, 3000 * RPM, 100 * BAR) / (3000 * RPM)
    assert indicated / (indicated + loss) == pytest.approx(0.93, abs=0.005)


def test_its_volumetric_efficiency_at_180_bar_is_0_96():
    unlimited = 7.4e-6 * 3000 / 60
    assert 1.0 - FILE.leakage * 180 * BAR / unlimited == pytest.approx(0.96, abs=0.005)


def test_the_restrictor_opens_while_something_is_asked_for_and_for_a_time_after():
    assert intake_wanted(PUMP.intake, 0.0) == intake_wanted(PUMP.intake, 1.9) == 1.0
    assert intake_wanted(PUMP.intake, 2.0) == 0.35
