"""The orifice's rounded root: a root from far off, a straight line near by."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.orifice import in_series, rounded_root

BAR = 1e5


@pytest.mark.parametrize("difference", [100 * BAR, 300 * BAR])
def test_far_above_its_rounding_it_is_the_square_root(difference):
    assert rounded_root(difference, BAR) == pytest.approx(math.sqrt(difference), rel=1e-4)


def test_far_below_it_is_proportional():
    assert rounded_root(0.001 * BAR, BAR) == pytest.approx(0.001 * BAR / math.sqrt(BAR), rel=1e-6)


@given(st.floats(-3e7, 3e7), st.floats(1.0, 1e4))
def test_it_is_odd_and_rises_with_the_difference(difference, more):
    assert rounded_root(-difference, BAR) == -rounded_root(difference, BAR)
    assert rounded_root(difference + more, BAR) > rounded_root(difference, BAR)


def test_of_two_in_series_the_pressure_drops_add_up():
    first, second, flow = 3e-7, 5e-7, 1e-4
    drops = (flow / first) ** 2 + (flow / second) ** 2
    assert in_series(first, second) * math.sqrt(drops) == pytest.approx(flow)


def test_nothing_passes_two_in_series_of_which_one_is_shut():
    assert in_series(0.0, 5e-7) == in_series(5e-7, 0.0) == 0.0
