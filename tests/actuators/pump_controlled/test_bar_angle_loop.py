"""The bar-angle loop: a gain that is fixed or keeps the loop the same at every speed, and the range of its command."""

import math

import pytest
from bench import circuit
from records import filled

from ars_mujoco.actuators.pump_controlled.bar_angle_loop import BarAngleLoop, limited, outer_gain
from ars_mujoco.hydraulics.pump import ideal_flow

RPM = 2 * math.pi / 60
SPEEDS = [1500, 3000, 6000]


def loop(schedule):
    return filled(BarAngleLoop(gain="60 1/rad", gain_speed="3000 rpm", schedule=str(schedule), max_angle="14.46 deg"))


@pytest.mark.parametrize("rpm", SPEEDS)
def test_a_fixed_gain_is_the_same_at_every_speed(rpm):
    assert outer_gain(loop(0), rpm * RPM) == 60.0


@pytest.mark.parametrize("rpm", SPEEDS)
def test_a_scheduled_gain_asks_for_the_same_flow_at_every_speed(rpm):
    pump = circuit().pump
    pump.speed = rpm * RPM
    error = 0.001
    assert ideal_flow(pump, outer_gain(loop(1), pump.speed) * error) == pytest.approx(0.06 * 9e-5, rel=1e-12)


def test_a_scheduled_gain_at_idle_is_still_the_schedule_s_and_finite_where_the_engine_is_off():
    assert outer_gain(loop(1), 800 * RPM) == pytest.approx(60 * 3000 / 800)
    assert outer_gain(loop(1), 0.0) == outer_gain(loop(1), 50.0) == pytest.approx(60 * 3000 * RPM / 50.0)


def test_a_half_schedule_lies_between():
    assert outer_gain(loop(0.5), 1500 * RPM) == pytest.approx(90.0)


def test_the_command_stays_within_the_bars_range():
    assert limited(loop(0), 0.1) == 0.1
    assert limited(loop(0), 0.3) == pytest.approx(math.radians(14.46))
    assert limited(loop(0), -0.3) == -limited(loop(0), 0.3)
