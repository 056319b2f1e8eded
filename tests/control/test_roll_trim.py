"""The roll trim: an integrator with a limit, and damping."""

import pytest
from records import filled

from ars_mujoco.control.roll_trim import RollTrim, roll_damping, trim

TRIM = filled(RollTrim(rate="0.5 1/s", limit="2 deg", damping="0.07 s"))
LIMIT = 0.03490658503988659  # rad


def trimmed(settings, error, seconds, step=0.01):
    correction = 0.0
    for _ in range(round(seconds / step)):
        correction = trim(settings, correction, error, step)
    return correction


def test_a_lasting_error_is_integrated():
    assert trimmed(TRIM, 0.01, 2.0) == pytest.approx(0.5 * 0.01 * 2.0)
    assert trimmed(TRIM, 0.01, 2.0, step=0.001) == pytest.approx(trimmed(TRIM, 0.01, 2.0))


@pytest.mark.parametrize("side", [1, -1])
def test_the_correction_is_limited_and_does_not_wind_up(side):
    assert trimmed(TRIM, side * 0.1, 20.0) == pytest.approx(side * LIMIT)
    assert trim(TRIM, trimmed(TRIM, side * 0.1, 20.0), -side * 0.1, 0.01) == pytest.approx(side * (LIMIT - 0.0005))


def test_a_rate_of_zero_turns_it_off():
    assert trimmed(filled(RollTrim(rate="0 1/s", limit="2 deg", damping="0.07 s")), 0.1, 5.0) == 0.0


def test_damping_turns_the_bars_against_the_roll_rate():
    assert roll_damping(TRIM, 0.2) == pytest.approx(0.07 * 0.2)
    assert roll_damping(TRIM, -0.2) == -roll_damping(TRIM, 0.2)
