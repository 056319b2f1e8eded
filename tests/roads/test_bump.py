"""The bump: where it is, how high, and that its slope is its derivative."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import filled

from ars_mujoco.roads.bump import Bump, height_and_slope

BUMP = filled(Bump(side=1, height="40 mm", length="1 m", position="20 m"))


def test_it_is_highest_in_its_middle_on_its_side_only():
    assert height_and_slope(BUMP, 20.5, 0.78) == pytest.approx((0.04, 0.0, 0.0), abs=1e-15)
    assert height_and_slope(BUMP, 20.5, -0.78) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("y", [-0.78, 0.0, 0.78])
def test_a_road_without_a_side_is_flat(y):
    assert height_and_slope(filled(Bump()), 0.5, y) == (0.0, 0.0, 0.0)


@given(x=st.one_of(st.floats(-1e3, 20.0), st.floats(21.0, 1e3)))
def test_it_is_flat_before_and_after(x):
    assert height_and_slope(BUMP, x, 0.78) == (0.0, 0.0, 0.0)


@given(x=st.floats(19.5, 21.5))
def test_its_slope_is_its_derivative(x):
    after, before = height_and_slope(BUMP, x + 1e-6, 0.78)[0], height_and_slope(BUMP, x - 1e-6, 0.78)[0]
    assert height_and_slope(BUMP, x, 0.78)[1] == pytest.approx((after - before) / 2e-6, abs=1e-6)


@given(x=st.floats(19.5, 21.5))
def test_interpreted_and_compiled_agree(x):
    interpreted = getattr(height_and_slope, "py_func", height_and_slope)
    assert interpreted(BUMP, x, 0.78) == pytest.approx(height_and_slope(BUMP, x, 0.78), rel=1e-12, abs=1e-15)
