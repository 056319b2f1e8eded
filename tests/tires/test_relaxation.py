"""Transient slip: the lag's closed form and order, and that no speed or sliding can wind up the carcass."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.tires.magic_formula import MagicFormula, forces
from ars_mujoco.tires.relaxation import Relaxation, advance, damping, limit

P = filled(Relaxation())


def deflection_after(distance, speed, rate, steps):
    h, deflection = distance / speed / steps, 0.0
    for _ in range(steps):
        deflection = advance(deflection, rate, speed, P.lateral, h)
    return deflection


@pytest.mark.parametrize("speed", [0.5, 10.0, 50.0])
def test_slip_follows_a_step_over_the_relaxation_length(speed):
    slip = deflection_after(P.lateral, speed, 0.05 * speed, 1000) / P.lateral
    assert slip == pytest.approx(0.05 * (1.0 - math.exp(-1.0)), rel=1e-6)


def test_the_update_is_of_second_order():
    exact = 0.05 * P.lateral * (1.0 - math.exp(-1.0))
    errors = [abs(deflection_after(P.lateral, 20.0, 1.0, steps) - exact) for steps in (20, 40, 80, 160)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx(2.0, abs=0.05)


@given(speed=st.floats(0.0, 1e4), h=st.floats(1e-5, 0.1), start=st.floats(-0.1, 0.1), slip=st.floats(-1.0, 1.0))
def test_at_any_speed_and_step_the_deflection_goes_to_its_end_without_overshoot(speed, h, start, slip):
    end = slip * P.lateral
    after = advance(start, slip * speed, speed, P.lateral, h)
    assert min(start, end) - 1e-12 <= after <= max(start, end) + 1e-12


def test_at_standstill_the_deflection_is_the_displacement():
    assert advance(0.01, 0.5, 0.0, P.lateral, 1e-3) == 0.01 + 0.5e-3
    assert advance(0.01, 0.0, 0.0, P.lateral, 1e-3) == 0.01


def test_the_damper_fades_smoothly_before_its_speed():
    speeds = np.linspace(0.0, 3.0, 301)
    damper = np.array([damping(P, speed) for speed in speeds])
    assert damper[0] == P.standstill_damping
    assert np.all(damper[speeds >= P.standstill_speed] == 0.0)
    assert np.all(np.diff(damper) <= 0.0)


def test_a_tire_at_standstill_holds_the_peak_of_its_force():
    magic = filled(MagicFormula())
    mu_x, mu_y = 1.15, 1.05
    longitudinal = forces(magic, 1.0, 4000.0, P.peak_slip * mu_x / 21.5, 0.0, 0.0)[0]
    lateral = forces(magic, 1.0, 4000.0, 0.0, P.peak_slip * mu_y / 17.6, 0.0)[1]
    assert longitudinal == pytest.approx(mu_x * 4000.0, rel=2e-3)
    assert lateral == pytest.approx(-mu_y * 4000.0, rel=2e-3)


@given(rho=st.floats(1e-12, 50.0), speed=st.floats(0.0, 60.0))
def test_the_limit_is_the_peak_at_standstill_and_away_when_moving(rho, speed):
    most = P.peak_slip * (1.0 + speed / P.sliding_speed)
    assert limit(P, rho, speed) * rho == pytest.approx(min(rho, most), rel=1e-12)
