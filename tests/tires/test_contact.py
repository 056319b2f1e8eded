"""Contact of a disc with a plane: closed forms, and a disc sampled point by point."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.tires.contact import deflection, heading, normal, patch_velocity, rolling_radius, vertical_force

slopes = st.floats(-0.3, 0.3)


def test_an_upright_wheel_on_a_level_road_rolls_along_x():
    assert normal(0.0, 0.0) == (0.0, 0.0, 1.0)
    assert heading(0.0, 1.0, 0.0, 0.0, 0.0, 1.0) == (1.0, 0.0, 0.0, 1.0, 0.0)


def test_camber_is_positive_with_the_top_leaning_to_the_right():
    lean = 0.1  # about x: the spin axis, on the left, rises
    *_, cos, sin = heading(0.0, math.cos(lean), math.sin(lean), 0.0, 0.0, 1.0)
    assert math.atan2(sin, cos) == pytest.approx(lean)


@given(steer=st.floats(-0.6, 0.6), lean=st.floats(-0.3, 0.3), slope_x=slopes, slope_y=slopes)
def test_deflection_is_that_of_the_lowest_point_of_the_disc(steer, lean, slope_x, slope_y):
    axis = np.array([-math.sin(steer) * math.cos(lean), math.cos(steer) * math.cos(lean), math.sin(lean)])
    n = np.array(normal(slope_x, slope_y))
    *forward, cos, sin = heading(*axis, *n)
    up = np.cross(forward, axis)
    angles = np.linspace(0.0, 2.0 * math.pi, 721)[:, None]
    rim = 0.3 * (np.cos(angles) * forward + np.sin(angles) * up)
    height = 0.28
    assert deflection(0.3, height, cos) == pytest.approx(-(height + rim @ n).min(), abs=1e-5)
    assert np.dot(forward, axis) == pytest.approx(0.0, abs=1e-12)
    assert np.dot(forward, n) == pytest.approx(0.0, abs=1e-12)


@given(lean=st.floats(-0.3, 0.3), v=st.tuples(*[st.floats(-5, 5)] * 3), w=st.tuples(*[st.floats(-3, 3)] * 3))
def test_the_patch_moves_as_the_hub_does_but_for_its_turn_about_the_spin_axis(lean, v, w):
    axis, n = np.array([0.0, math.cos(lean), math.sin(lean)]), np.array([0.0, 0.0, 1.0])
    *x, cos, sin = heading(*axis, *n)
    y, height = np.cross(n, x), 0.28
    patch = -height / cos * np.cross(x, axis)
    expected = np.array(v) + np.cross(np.array(w) - np.dot(w, axis) * axis, patch)
    along = patch_velocity(*v, *w, *x, *y, *n, height, sin / cos)
    assert along[1:] == pytest.approx((expected @ y, expected @ n), abs=1e-12)
    assert along[0] == pytest.approx(v[0], abs=1e-12)


def test_the_rolling_radius_lies_between_the_unloaded_and_the_loaded_one():
    assert 0.3 - 0.018 < rolling_radius(0.3, 0.018) < 0.3


def test_the_vertical_force_is_that_of_spring_and_damper():
    assert vertical_force(225e3, 150.0, 0.018, 0.5) == 225e3 * 0.018 + 75.0


@given(deflection=st.floats(-0.1, 0.1), rate=st.floats(-100, 100))
def test_the_vertical_force_never_pulls_and_is_zero_off_the_road(deflection, rate):
    force = vertical_force(225e3, 150.0, deflection, rate)
    assert force >= 0.0
    if deflection <= 0.0:
        assert force == 0.0
