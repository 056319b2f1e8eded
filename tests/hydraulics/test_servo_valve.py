"""The servo valve against the closed forms of a second-order lag."""

import numpy as np
import pytest
from bench import circuit
from scipy.integrate import solve_ivp

from ars_mujoco.hydraulics.servo_valve import spool_acceleration

VALVE = circuit().servo_valve
W, D = VALVE.frequency, VALVE.damping


def spool(command, time):
    """Stroke and rate (2, n) at `time` (n,) s after a step of the command, from rest."""
    return solve_ivp(
        lambda t, s: (s[1], spool_acceleration(VALVE, s[0], s[1], command)),
        (0.0, time[-1]), (0.0, 0.0), "DOP853", time, rtol=1e-10, atol=1e-13, max_step=1e-4,
    ).y  # fmt: skip


def test_a_small_step_is_that_of_a_second_order_lag():
    time = np.linspace(0.0, 0.03, 301)
    damped = W * np.sqrt(1.0 - D * D)
    decay = np.exp(-D * W * time)
    stroke = 0.2 * (1.0 - decay * (np.cos(damped * time) + D * W / damped * np.sin(damped * time)))
    assert spool(0.2, time)[0] == pytest.approx(stroke, abs=1e-9)


def test_its_gain_falls_by_3_db_at_420_rad_s():
    stiffness = -spool_acceleration(VALVE, 1e-3, 0.0, 0.0) / 1e-3
    lag = -spool_acceleration(VALVE, 0.0, 1e-3, 0.0) / 1e-3
    gain = spool_acceleration(VALVE, 0.0, 0.0, 1e-3) / 1e-3 / (stiffness + 420j * lag - 420**2)
    assert abs(gain) == pytest.approx(0.5**0.5, rel=1e-9)


def test_a_large_step_is_limited_to_the_spool_speed():
    time = np.linspace(0.0, 0.02, 201)
    stroke, rate = spool(1.0, time)
    assert 0.95 * VALVE.max_rate < rate.max() <= VALVE.max_rate
    assert 1.0 / VALVE.max_rate < np.interp(0.95, stroke[:130], time[:130]) < 1.3 / VALVE.max_rate


def test_the_valve_knows_no_side():
    for stroke, rate, command in [(0.1, 20.0, 0.5), (-0.3, 90.0, 1.0), (0.9, -150.0, -1.0)]:
        mirrored = spool_acceleration(VALVE, -stroke, -rate, -command)
        assert mirrored == -spool_acceleration(VALVE, stroke, rate, command)
