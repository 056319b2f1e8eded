"""The control cylinder's forces and volumes against closed forms (paper eqs. 1 to 8)."""

import math

import numpy as np
import pytest
from detailed import axle
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.control_cylinder import (
    chamber_capacitance,
    chamber_volumes,
    common_capacitance,
    cylinder_friction,
    piston_acceleration,
    stop_force,
)

BAR = 1e5
PARAMETERS, _ = axle()
CYLINDER, FLUID = PARAMETERS.circuit.control_cylinder, PARAMETERS.detail.fluid
TRAVELS, RATES = st.floats(-5e-3, 5e-3), st.floats(-2.0, 2.0)


def stribeck():
    """The cylinder with a static friction, too."""
    cylinder = CYLINDER.copy()
    cylinder.static_friction, cylinder.static_decay = 7.0, 40.0
    return cylinder


def test_friction_is_stribecks_away_from_standstill():
    assert cylinder_friction(CYLINDER, 0.5)[0] == pytest.approx(13 + 30 * 0.5)
    assert cylinder_friction(stribeck(), 0.02)[0] == pytest.approx(13 + 7 * math.exp(-0.8) + 30 * 0.02)


@given(RATES)
def test_friction_is_odd_and_takes_energy(rate):
    for cylinder in (CYLINDER, stribeck()):
        force, slope = cylinder_friction(cylinder, rate)
        assert cylinder_friction(cylinder, -rate) == (-force, slope)
        assert force * rate >= 0.0


def test_its_slope_is_that_of_the_force():
    random = np.random.default_rng(1)
    for rate in np.concatenate([random.uniform(-5e-3, 5e-3, 50), random.uniform(-1, 1, 50)]):
        for cylinder in (CYLINDER, stribeck()):
            ahead, behind = (cylinder_friction(cylinder, rate + side)[0] for side in (1e-7, -1e-7))
            assert cylinder_friction(cylinder, rate)[1] == pytest.approx((ahead - behind) / 2e-7, rel=1e-4)


def test_the_stop_is_a_damped_spring_beyond_the_travel_alone():
    assert stop_force(CYLINDER, 5e-3, 1.0) == (0.0, 0.0, 0.0)
    force, by_travel, by_rate = stop_force(CYLINDER, -5.001e-3, -0.1)
    assert force == pytest.approx(-(5e7 * 1e-6 + 1500 * 0.1))
    assert (by_travel, by_rate) == (5e7, 1500.0)
    assert stop_force(CYLINDER, -5.001e-3, 0.1) == (0.0, 0.0, 0.0)  # on its way back faster than the stop follows


def test_the_piston_is_pushed_by_oil_spring_and_swash_plate():
    acceleration, by_travel, by_rate = piston_acceleration(CYLINDER, 200.0, 2e-3, 0.1, 90 * BAR)
    assert 0.15 * acceleration == pytest.approx(200 - 1e4 * 2e-3 - 110 * 0.5 - 13 - 30 * 0.1)
    assert 0.15 * by_travel == pytest.approx(-1e4)
    assert 0.15 * by_rate == pytest.approx(-30.0)


@given(TRAVELS)
def test_what_one_chamber_gains_the_other_loses(travel):
    a, b = chamber_volumes(CYLINDER, travel)
    assert a - b == pytest.approx(2 * 1.54e-4 * travel, abs=1e-20)
    assert a + b == pytest.approx(2 * (4e-7 + 1.54e-4 * 5e-3))


@given(TRAVELS, st.floats(0.5 * BAR, 30 * BAR))
def test_the_common_capacitance_is_that_of_both_chambers_in_series(travel, pressure):
    """Eq. 8 with the minus sign: C_H = V_0 b/2 (1 - (A x/V_0)^2)."""
    a, b = (chamber_capacitance(FLUID, volume, pressure)[0] for volume in chamber_volumes(CYLINDER, travel))
    common, middle = (common_capacitance(CYLINDER, FLUID, x, pressure) for x in (travel, 0.0))
    assert common == pytest.approx(a * b / (a + b))
    share = 1.54e-4 * travel / (4e-7 + 1.54e-4 * 5e-3)
    assert common == pytest.approx(middle * (1.0 - share * share))


@given(st.floats(0.1 * BAR, 40 * BAR))
def test_a_chamber_grows_softer_as_its_pressure_falls(pressure):
    capacitance, slope = chamber_capacitance(FLUID, 1e-6, pressure)
    nudge = 1e-4 * pressure
    ahead, behind = (chamber_capacitance(FLUID, 1e-6, pressure + side)[0] for side in (nudge, -nudge))
    assert capacitance == pytest.approx(1e-6 * (1 / 1.4e9 + 0.005 * BAR / pressure**2))
    assert slope == pytest.approx((ahead - behind) / (2 * nudge), rel=1e-6)
