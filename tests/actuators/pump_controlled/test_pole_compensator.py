"""The second-order compensator: its digital zeros lie on the poles that it cancels."""

import numpy as np
import pytest
from records import filled

from ars_mujoco.actuators.pump_controlled.pole_compensator import STATE, PoleCompensator, compensated

SAMPLE_TIME = 1e-3
FREQUENCY, DAMPING, NEW_DAMPING = 500.0, 0.06, 0.5  # rad/s
COMPENSATOR = filled(PoleCompensator(frequency="500 rad/s", damping="0.06", new_damping="0.5"))
NYQUIST = np.pi / SAMPLE_TIME


def driven(command: np.ndarray) -> np.ndarray:
    """The stroke commands behind the compensator."""
    now, later = (np.zeros(1, STATE).view(np.recarray)[0] for _ in range(2))
    behind = []
    for each in command:
        behind.append(compensated(COMPENSATOR, now, later, each, SAMPLE_TIME))
        now.first, now.second = later.first, later.second
    return np.array(behind)


def response(omega: np.ndarray) -> np.ndarray:
    """Complex response at `omega` (rad/s), from that to one pulse."""
    pulse = driven(np.eye(1, 2000)[0])
    return np.exp(-1j * np.outer(omega * SAMPLE_TIME, np.arange(2000))) @ pulse


def analog(omega: np.ndarray) -> np.ndarray:
    zeros, poles = (
        FREQUENCY**2 - omega**2 + 2j * each * FREQUENCY * omega for each in (DAMPING, NEW_DAMPING)
    )  # fmt: skip
    return zeros / poles


def test_a_command_that_is_held_passes():
    assert driven(np.full(500, 0.3))[-1] == pytest.approx(0.3, rel=1e-12)


def test_at_its_frequency_it_is_the_ratio_of_the_dampings():
    (found,) = response(np.array([FREQUENCY]))
    assert found == pytest.approx(DAMPING / NEW_DAMPING, rel=1e-9)


def test_it_is_the_analog_one_at_a_frequency_warped_by_under_4_percent_up_to_a_fifth_of_half_the_sampling():
    omega = np.geomspace(1.0, NYQUIST / 5.0, 50)
    warped = FREQUENCY * np.tan(0.5 * omega * SAMPLE_TIME) / np.tan(0.5 * FREQUENCY * SAMPLE_TIME)
    np.testing.assert_allclose(response(omega), analog(warped), rtol=1e-9)
    assert np.abs(warped / omega - 1.0).max() < 0.04


def test_equal_dampings_change_nothing():
    same = filled(PoleCompensator(frequency="500 rad/s", damping="0.5", new_damping="0.5"))
    state = np.zeros(1, STATE).view(np.recarray)[0]
    for command in np.random.default_rng(2).normal(0.0, 1.0, 50):
        assert compensated(same, state, state, command, SAMPLE_TIME) == pytest.approx(command, rel=1e-12)


def test_the_opposite_command_gives_the_opposite_output():
    command = np.random.default_rng(1).normal(0.0, 1.0, 100)
    assert np.array_equal(driven(-command), -driven(command))
