"""The accelerometer: gravity when it rolls, the lateral acceleration when it moves, and its filter."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import blank, filled

from ars_mujoco.control.accelerometer import Accelerometer, AccelerometerState, low_pass, specific_force

G = 9.81
LEVEL = (0.0, 1.0, 0.0)
STILL = (0.0, 0.0, 0.0)


def reading(before, after, axis=LEVEL, step=1e-3):
    """What a sensor reads whose velocity went from one to the other in a step."""
    first, second, third = (blank(AccelerometerState) for _ in range(3))
    specific_force(first, second, before, axis, G, step)
    return specific_force(second, third, after, axis, G, step)


@given(roll=st.floats(-1.0, 1.0))
def test_at_rest_it_reads_the_gravity_along_its_axis(roll):
    right_side_down = (0.0, math.cos(roll), math.sin(roll))
    assert reading(STILL, STILL, right_side_down) == pytest.approx(G * math.sin(roll), abs=1e-12)


@given(acceleration=st.floats(-20.0, 20.0), step=st.sampled_from([5e-4, 1e-3, 2e-3]))
def test_level_it_reads_the_lateral_acceleration_alone(acceleration, step):
    assert reading((30.0, 0.0, 0.0), (30.0, acceleration * step, 0.0), step=step) == pytest.approx(acceleration)


def test_braking_and_heaving_are_not_lateral():
    assert reading((30.0, 1.0, 0.0), (29.9, 1.0, 0.4)) == 0.0


def test_in_a_steady_turn_it_reads_speed_times_yaw_rate():
    speed, yaw_rate, step = 30.0, 0.2, 1e-3
    turned = yaw_rate * step
    velocity = (speed * math.cos(turned), speed * math.sin(turned), 0.0)
    axis = (-math.sin(turned), math.cos(turned), 0.0)
    assert reading((speed, 0.0, 0.0), velocity, axis) == pytest.approx(speed * yaw_rate, rel=1e-6)


def test_a_first_reading_knows_no_velocity_before_and_reads_gravity_alone():
    first, second = blank(AccelerometerState), blank(AccelerometerState)
    axis = (0.0, math.cos(0.1), math.sin(0.1))
    assert specific_force(first, second, (30.0, 5.0, 0.0), axis, G, 1e-3) == pytest.approx(G * math.sin(0.1))


@pytest.mark.parametrize("steps", [1, 7, 1000])
def test_the_filter_has_its_time_constant_at_any_step(steps):
    sensor, time_constant = filled(Accelerometer(cutoff="10 Hz")), 1.0 / (2 * math.pi * 10.0)
    now, later = blank(AccelerometerState), blank(AccelerometerState)
    for _ in range(steps):
        low_pass(sensor, now, later, 5.0, time_constant / steps)
        now, later = later, now
    assert now.filtered == pytest.approx(5.0 * (1.0 - math.exp(-1.0)), rel=1e-12)
