"""Signals: their knots, what lies between, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.excitation.knots import JOINS, KNOTS, signal, slope, value
from ars_mujoco.schema.errors import InputError

TIMES, VALUES = [1.0, 2.0, 4.0], [3.0, -1.0, 5.0]


@pytest.mark.parametrize("join", JOINS)
def test_a_signal_goes_through_its_knots_and_keeps_its_ends(join):
    p = signal(TIMES, VALUES, join)
    assert [value(p, t) for t in TIMES] == VALUES
    assert (value(p, -10.0), value(p, 100.0)) == (3.0, 5.0)
    assert (slope(p, 0.999), slope(p, 4.001)) == (0.0, 0.0)


def test_a_step_keeps_the_last_knot():
    p = signal(TIMES, VALUES, "step")
    assert [value(p, t) for t in (1.999999, 2.0, 3.999)] == [3.0, -1.0, -1.0]
    assert slope(p, 1.5) == 0.0


@given(t=st.floats(0.0, 5.0))
def test_a_linear_signal_is_the_interpolation(t):
    assert value(signal(TIMES, VALUES, "linear"), t) == pytest.approx(np.interp(t, TIMES, VALUES), abs=1e-12)


@given(s=st.floats(0.0, 1.0, exclude_max=True))
def test_a_smooth_piece_is_the_quintic_without_slope_at_its_ends(s):
    p = signal([1.0, 3.0], [2.0, 6.0])
    assert value(p, 1.0 + 2.0 * s) == pytest.approx(2.0 + 4.0 * s**3 * (10 - 15 * s + 6 * s**2), abs=1e-9)
    assert (slope(p, 1.0), slope(p, 2.0)) == (0.0, pytest.approx(4.0 / 2.0 * 1.875))


@pytest.mark.parametrize("join", ["linear", "smooth"])
@given(t=st.floats(0.0, 5.0).filter(lambda t: min(abs(t - knot) for knot in TIMES) > 1e-5))
def test_slope_is_the_derivative(join, t):
    p = signal(TIMES, VALUES, join)
    assert slope(p, t) == pytest.approx((value(p, t + 1e-6) - value(p, t - 1e-6)) / 2e-6, abs=1e-6)


def test_a_constant_is_a_single_knot():
    p = signal([0.0], [7.0])
    assert (value(p, -1.0), value(p, 0.0), value(p, 1.0), slope(p, 1.0)) == (7.0, 7.0, 7.0, 0.0)


def test_as_many_knots_as_there_is_room_for():
    times = list(range(KNOTS))
    p = signal(times, times, "linear")
    assert [value(p, t + 0.5) for t in times] == [*np.arange(0.5, KNOTS - 1), KNOTS - 1.0]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([0, 1], [0, 1], "cubic"), "'cubic' is none of step, linear, smooth"),
        (([0, 1], [0]), "1 values at 2 times"),
        (([], []), "1 to 32 knots, not 0"),
        ((range(33), range(33)), "1 to 32 knots, not 33"),
        (([0, 2, 2], [0, 1, 2]), "must rise: 2 s comes after 2 s"),
        (([0, 1], [0, float("nan")]), "finite"),
    ],
)
def test_what_is_no_signal_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        signal(*arguments)


def test_every_problem_is_told_at_once():
    with pytest.raises(InputError) as error:
        signal([1, 0], [0], "cubic")
    assert len(error.value.problems) == 3


@pytest.mark.parametrize("join", JOINS)
@given(t=st.floats(0.0, 5.0))
def test_interpreted_and_compiled_agree(join, t):
    p = signal(TIMES, VALUES, join)
    for function in (value, slope):
        assert getattr(function, "py_func", function)(p, t) == pytest.approx(function(p, t), rel=1e-12, abs=1e-12)
