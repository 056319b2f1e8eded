"""Dynamic pressure feedback: a digital high-pass that is the analog one, as far as sampling lets it be."""

import numpy as np
import pytest
from records import filled

from ars_mujoco.actuators.pump_controlled.pressure_feedback import STATE, PressureFeedback, fed_back

SAMPLE_TIME = 1e-3
GAIN, CORNER = 2e-8, 60.0  # 1/Pa, rad/s
FEEDBACK = filled(PressureFeedback(gain="0.002 1/bar", corner="60 rad/s"))
NYQUIST = np.pi / SAMPLE_TIME


def driven(pressure: np.ndarray) -> np.ndarray:
    """What is taken off the stroke command, for a pressure (Pa) at each sample."""
    now, later = (np.zeros(1, STATE).view(np.recarray)[0] for _ in range(2))
    taken = []
    for each in pressure:
        taken.append(fed_back(FEEDBACK, now, later, each, SAMPLE_TIME))
        now.pressure, now.stroke = later.pressure, later.stroke
    return np.array(taken)


def response(omega: np.ndarray) -> np.ndarray:
    """Complex response at `omega` (rad/s), from that to one pulse."""
    pulse = driven(np.eye(1, 2000)[0])
    return np.exp(-1j * np.outer(omega * SAMPLE_TIME, np.arange(2000))) @ pulse


def analog(omega: np.ndarray) -> np.ndarray:
    return GAIN * 1j * omega / (1j * omega + CORNER)


def test_a_pressure_that_is_held_takes_nothing_off():
    taken = driven(np.full(2000, 1e7))
    assert taken[0] == pytest.approx(GAIN * 1e7, rel=0.05)
    assert abs(taken[-1]) < 1e-12


def test_at_its_corner_it_is_the_analog_filter():
    np.testing.assert_allclose(response(np.array([CORNER])), analog(CORNER), rtol=1e-9)


def test_at_half_the_sampling_it_has_the_analog_filter_s_full_gain():
    assert response(np.array([NYQUIST]))[0].real == pytest.approx(GAIN, rel=1e-9)


def test_it_is_the_analog_filter_at_a_frequency_warped_by_under_4_percent_up_to_a_fifth_of_half_the_sampling():
    omega = np.geomspace(1.0, NYQUIST / 5.0, 50)
    warped = CORNER * np.tan(0.5 * omega * SAMPLE_TIME) / np.tan(0.5 * CORNER * SAMPLE_TIME)
    np.testing.assert_allclose(response(omega), analog(warped), rtol=1e-9)
    assert np.abs(warped / omega - 1.0).max() < 0.04


def test_the_opposite_pressure_gives_the_opposite_stroke():
    pressure = np.random.default_rng(1).normal(0.0, 1e6, 100)
    assert np.array_equal(driven(-pressure), -driven(pressure))
