"""The running circuit's response to sines, beside the linear one."""

import math

import numpy as np
import pytest
from theory import LOOP

from ars_mujoco.analysis.frequency_response import linear, measured
from ars_mujoco.analysis.margins import bandwidth

SMOOTH = LOOP.without_dry_friction()
FREQUENCIES = np.geomspace(0.5, 60.0, 40)


def deviation(loop, amplitude, frequencies):
    """(dB, deg) of the measured response over the linear one."""
    ratio = measured(loop, math.radians(amplitude), frequencies) / linear(loop, frequencies)
    return 20 * np.log10(np.abs(ratio)), np.degrees(np.angle(ratio))


@pytest.mark.parametrize("amplitude", [0.1, 0.2, 0.5])
def test_without_dry_friction_small_sines_get_the_linear_response_up_to_20_hz(amplitude):
    decibels, degrees = deviation(SMOOTH, amplitude, np.geomspace(0.5, 20.0, 12))
    assert np.abs(decibels).max() < 0.5
    assert np.abs(degrees).max() < 3.0


def test_the_smallest_sines_get_it_far_closer():
    decibels, degrees = deviation(SMOOTH, 0.01, np.geomspace(0.5, 60.0, 12))
    assert np.abs(decibels).max() < 1e-3
    assert np.abs(degrees).max() < 0.01


def test_dry_friction_makes_a_small_fast_sine_lag_25_deg_more():
    _, degrees = deviation(LOOP, 0.1, np.array([20.0]))
    assert degrees[0] == pytest.approx(-25, abs=2)


@pytest.mark.parametrize(("amplitude", "hertz"), [(0.5, 21), (1.0, 15), (2.0, 8), (5.0, 3.3), (10.0, 1.7)])
def test_the_flow_limits_the_bandwidth_of_large_sines(amplitude, hertz):
    response = measured(LOOP, math.radians(amplitude), FREQUENCIES)
    at_rest = abs(linear(LOOP, np.zeros(1))[0])
    assert bandwidth(2 * math.pi * FREQUENCIES, response, at_rest) == pytest.approx(hertz, rel=0.04)


def test_12_hz_holds_up_to_1_2_deg():
    at_rest = abs(linear(LOOP, np.zeros(1))[0])
    inside, outside = (abs(measured(LOOP, math.radians(a), [12.0])[0]) / at_rest for a in (1.2, 1.4))
    assert inside > math.sqrt(0.5) > outside


def test_where_a_full_stroke_needs_all_of_the_spool_s_speed_the_phase_jumps():
    valve, plate = LOOP.circuit.servo_valve, LOOP.circuit.swash_plate
    limit = math.sqrt(valve.max_rate * plate.max_rate) / (2 * math.pi)
    before, after = np.degrees(np.angle(measured(LOOP, math.radians(5), limit * np.array([0.97, 1.1]))))
    assert limit == pytest.approx(25.2, abs=0.1)
    assert (before - after) % 360 > 75


def test_a_large_sine_swings_no_faster_than_the_pump_delivers():
    amplitude, frequency = math.radians(10), 5.0
    speed = amplitude * abs(measured(LOOP, amplitude, [frequency])[0]) * 2 * math.pi * frequency
    full = LOOP.circuit.pump.displacement * LOOP.circuit.pump.speed / LOOP.circuit.motor.displacement
    assert 0.8 * full < speed < 4 / math.pi * full  # between a triangle's and a square's fundamental
