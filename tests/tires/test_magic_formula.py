"""Steady tire forces against the formula's closed forms, and what must hold for any slip."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.tires.magic_formula import MagicFormula, cornering_stiffness, forces, friction

P = filled(MagicFormula())
SLIPS = np.linspace(1e-4, 1.0, 4000)
LOADS = (1000.0, 4000.0, 8000.0)

slips = st.floats(-5.0, 5.0)
cambers = st.floats(-0.2, 0.2)
loads = st.floats(0.0, 30e3)


def lateral(slip, load=4000.0, kappa=0.0, camber=0.0, mu=1.0):
    return forces(P, mu, load, kappa, slip, camber)[1]


def longitudinal(kappa, load=4000.0, slip=0.0, mu=1.0):
    return forces(P, mu, load, kappa, slip, 0.0)[0]


def published_curve(B, C, D, E, slip):
    """The Magic Formula as Pacejka writes it."""
    return D * math.sin(C * math.atan(B * slip - E * (B * slip - math.atan(B * slip))))


@pytest.mark.parametrize("load", LOADS)
def test_cornering_stiffness_is_the_published_function_of_load(load):
    expected = 22.0 * 4000.0 * math.sin(2.0 * math.atan(load / (2.0 * 4000.0)))
    assert cornering_stiffness(P, load) * load == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("load", LOADS)
def test_slopes_at_zero_slip_are_the_stiffnesses(load):
    assert -lateral(1e-7, load) / 1e-7 == pytest.approx(cornering_stiffness(P, load) * load, rel=1e-8)
    assert longitudinal(1e-7, load) / 1e-7 == pytest.approx(21.5 * load, rel=1e-8)


def test_cornering_stiffness_of_the_sedan_is_70_kilonewton_a_radian_at_nominal_load():
    assert cornering_stiffness(P, 4000.0) * 4000.0 == pytest.approx(70.4e3)


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("slip", [-0.3, -0.05, 0.01, 0.1, 1.0])
def test_pure_slip_gives_the_pure_curves(load, slip):
    dfz = load / 4000.0 - 1.0
    D, K = (1.05 - 0.18 * dfz) * load, 22.0 * 4000.0 * math.sin(2.0 * math.atan(load / 8000.0))
    assert lateral(slip, load) == pytest.approx(-published_curve(K / (1.35 * D), 1.35, D, -0.8, slip), rel=1e-12)
    D, K = (1.15 - 0.10 * dfz) * load, 21.5 * load
    assert longitudinal(slip, load) == pytest.approx(published_curve(K / (1.65 * D), 1.65, D, 0.3, slip), rel=1e-12)


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("mu", [0.3, 1.0])
def test_peak_is_friction_times_load(load, mu):
    mu_x, mu_y = friction(P, mu, load)
    assert max(-lateral(slip, load, mu=mu) for slip in SLIPS) == pytest.approx(mu_y * load, rel=1e-5)
    assert max(longitudinal(slip, load, mu=mu) for slip in SLIPS) == pytest.approx(mu_x * load, rel=1e-5)


def test_friction_falls_with_load_and_is_held_where_the_fit_ends():
    assert friction(P, 1.0, 4000.0)[1] == pytest.approx(1.05)
    assert friction(P, 1.0, 8000.0)[1] == pytest.approx(0.87)
    assert friction(P, 1.0, 50e3) == friction(P, 1.0, 10e3)


@pytest.mark.parametrize("name", ["pDx2", "pDy2"])
def test_friction_that_would_fall_below_zero_is_refused(name):
    with pytest.raises(ValueError, match=name):
        MagicFormula(**{name: -1.0})


@given(load=loads, mu=st.floats(0.1, 1.2))
def test_no_slip_no_force(load, mu):
    assert forces(P, mu, load, 0.0, 0.0, 0.0) == (0.0, 0.0, 0.0)


@given(kappa=slips, slip=slips, camber=cambers)
def test_no_load_no_force(kappa, slip, camber):
    assert forces(P, 1.0, 0.0, kappa, slip, camber) == (0.0, 0.0, 0.0)


@given(load=loads, kappa=slips, slip=slips, camber=cambers)
def test_a_mirrored_tire_gives_exactly_the_mirrored_force(load, kappa, slip, camber):
    Fx, Fy, Mz = forces(P, 1.0, load, kappa, slip, camber)
    assert forces(P, 1.0, load, kappa, -slip, -camber) == (Fx, -Fy, -Mz)


@given(load=loads, kappa=slips, slip=slips, camber=cambers)
def test_combined_slip_never_leaves_the_friction_ellipse(load, kappa, slip, camber):
    Fx, Fy, _ = forces(P, 1.0, load, kappa, slip, camber)
    mu_x, mu_y = friction(P, 1.0, load)
    assert math.hypot(Fx / mu_x, Fy / mu_y) <= load * (1.0 + 1e-12)


@given(load=st.floats(10.0, 30e3), kappa=slips, slip=slips)
def test_slip_always_dissipates(load, kappa, slip):
    Fx, Fy, _ = forces(P, 1.0, load, kappa, slip, 0.0)
    assert Fx * kappa >= 0.0 and Fy * slip <= 0.0


@given(slip=st.floats(0.02, 1.0))
def test_driving_and_braking_take_away_lateral_force(slip):
    kappas = np.linspace(0.0, 1.0, 50)
    grip = [-lateral(slip, kappa=kappa) for kappa in kappas]
    assert grip[-1] < 0.75 * grip[0]
    assert grip == [-lateral(slip, kappa=-kappa) for kappa in kappas]


@given(direction=st.floats(-math.pi, math.pi), size=st.sampled_from([1e-15, 1e-12, 1e-9, 1e-6]))
def test_force_is_linear_in_any_direction_through_zero_slip(direction, size):
    kappa, slip = size * math.cos(direction), size * math.sin(direction)
    Fx, Fy, _ = forces(P, 1.0, 4000.0, kappa, slip, 0.0)
    assert math.hypot(Fx - 86e3 * kappa, Fy + 70.4e3 * slip) < 1e-4 * 86e3 * size + 86e3 * 1e-12


def test_camber_thrust_points_where_the_top_leans():
    assert lateral(0.0, camber=0.01) == pytest.approx(-0.92 * 4000.0 * 0.01, rel=1e-3)


def test_aligning_moment_turns_the_wheel_out_of_its_slip_and_fades_before_the_force():
    moment = [forces(P, 1.0, 4000.0, 0.0, slip, 0.0)[2] for slip in SLIPS]
    force = [-lateral(slip) for slip in SLIPS]
    assert moment[0] / force[0] == pytest.approx(0.03, rel=1e-3)
    assert min(moment) > 0.0
    assert np.argmax(moment) < 0.6 * np.argmax(force)
    assert 40.0 < max(moment) < 100.0


@given(load=loads, kappa=slips, slip=slips, camber=cambers)
def test_interpreted_and_compiled_agree(load, kappa, slip, camber):
    compiled = forces(P, 1.0, load, kappa, slip, camber)
    interpreted = getattr(forces, "py_func", forces)(P, 1.0, load, kappa, slip, camber)
    assert compiled == pytest.approx(interpreted, rel=1e-12, abs=1e-12)
