"""The loss polynomial: what eqs. 21 and 22 say, and what keeps a fitted one from giving energy."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from records import filled

from ars_mujoco.hydraulics.loss_polynomial import HIGHEST, FlowLoss, TorqueLoss, beyond, even_loss, odd_loss

BAR, RPM = 1e5, 2 * np.pi / 60
NORM, SPEED, PRESSURE = 5.0, 3000 * RPM, 180 * BAR
SHARES = st.floats(-0.2, 0.2)


def polynomial(coefficients, kind=TorqueLoss, **changes):
    """A loss whose norm is 5 SI, at 3000 rpm and 180 bar."""
    block = {
        "norm": {TorqueLoss: "5 Nm", FlowLoss: "5 m^3/s"}[kind],
        "normal_speed": "3000 rpm",
        "normal_pressure": "180 bar",
        "coefficients": coefficients,
        "validity": {"stroke": ["10 %", "1"], "speed": ["500 rpm", "6000 rpm"], "pressure": ["0 bar", "200 bar"]},
    }
    return kind.model_validate(block | changes)


def named(table):
    return {"k_{}{}{}".format(*term): float(table[term]) for term in np.ndindex(table.shape)}


@pytest.mark.parametrize("orders", [*((n, n, n) for n in range(HIGHEST + 1)), (1, 0, 3), (4, 1, 2), (0, 2, 1)])
def test_it_is_the_triple_sum_in_whole_fractions(orders):
    random = np.random.default_rng(1)
    table = random.uniform(0.0, 0.1, np.add(orders, 1))
    loss = polynomial(named(table))
    assert loss.order == max(orders)
    for x, n, y in random.uniform(0.0, 2.0, (20, 3)):
        expected = NORM * np.polynomial.polynomial.polyval3d(x, n, y, table)
        assert even_loss(filled(loss), x, n * SPEED, y * PRESSURE) == pytest.approx(expected, rel=1e-12)


def test_a_flow_loss_runs_from_the_high_to_the_low_side():
    table = np.random.default_rng(2).uniform(0.0, 0.1, (3, 3, 3))
    loss = filled(polynomial(named(table), FlowLoss))
    for stroke, pressure in product((0.6, -0.6), (90 * BAR, -90 * BAR)):
        expected = np.sign(pressure) * NORM * np.polynomial.polynomial.polyval3d(0.6, 0.5, 0.5, table)
        assert odd_loss(loss, stroke, 0.5 * SPEED, pressure) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("pressure", [1e-3, 1.0, BAR, 180 * BAR])
def test_a_term_of_the_pressure_alone_is_a_linear_leakage_from_zero_on(pressure):
    loss = filled(polynomial({"k_001": 0.03}, FlowLoss))
    for signed in (pressure, -pressure):
        assert odd_loss(loss, 0.4, SPEED, signed) == pytest.approx(0.03 * NORM * signed / PRESSURE, rel=1e-12)


def test_what_is_lost_without_pressure_takes_its_direction_within_a_hundredth_of_the_normal_pressure():
    loss = filled(polynomial({"k_000": 0.02}, FlowLoss))
    assert odd_loss(loss, 1.0, SPEED, 0.0) == 0.0
    assert odd_loss(loss, 1.0, SPEED, 0.9 * BAR) == pytest.approx(0.5 * 0.02 * NORM)
    assert odd_loss(loss, 1.0, SPEED, -1.8 * BAR) == pytest.approx(-0.02 * NORM)
    assert odd_loss(loss, 1.0, SPEED, 100 * BAR) == pytest.approx(0.02 * NORM)


@given(
    st.lists(SHARES, min_size=27, max_size=27), st.floats(-1.0, 1.0), st.floats(0.0, 2.0 * SPEED),
    st.floats(-2.0 * PRESSURE, 2.0 * PRESSURE),
)  # fmt: skip
def test_no_polynomial_gives_energy_in_any_quadrant(coefficients, stroke, speed, pressure):
    coefficients = named(np.reshape(coefficients, (3, 3, 3)))
    torque, flow = filled(polynomial(coefficients)), filled(polynomial(coefficients, FlowLoss))
    paid, leaked = even_loss(torque, stroke, speed, pressure), odd_loss(flow, stroke, speed, pressure)
    assert paid >= 0.0
    assert leaked * pressure >= 0.0
    for x, p in product((stroke, -stroke), (pressure, -pressure)):
        assert even_loss(torque, x, speed, p) == paid
        assert odd_loss(flow, x, speed, p) * p == leaked * pressure


def test_a_point_outside_the_range_is_told_by_how_much():
    loss = filled(polynomial({"k_000": 0.02}))
    assert beyond(loss, 0.5, SPEED, 100 * BAR) == beyond(loss, -0.5, SPEED, -200 * BAR) == 0.0
    assert beyond(loss, 0.5, SPEED, -220 * BAR) == pytest.approx(0.1)
    assert beyond(loss, 0.5, 6600 * RPM, 0.0) == pytest.approx(0.1)
    assert beyond(loss, 0.02, SPEED, 0.0) == pytest.approx(0.08)


def test_a_coefficient_that_is_not_named_is_zero():
    loss = filled(polynomial({}))
    assert even_loss(loss, 1.0, SPEED, PRESSURE) == 0.0


@given(st.floats(0.1, 10.0), st.floats(0.0, 1.0), st.floats(0.1, 2.0), st.floats(0.0, 1.5))
def test_a_similar_pump_loses_the_same_share_at_the_same_speed_of_its_sliding_parts(ratio, stroke, n, y):
    table = np.random.default_rng(3).uniform(0.0, 0.1, (2, 3, 2))
    length = ratio ** (1 / 3)
    here, there = n * SPEED, n * SPEED / length
    for kind, kernel, ideal in ((TorqueLoss, even_loss, ratio), (FlowLoss, odd_loss, ratio / length)):
        loss = polynomial(named(table), kind)
        scaled = filled(loss.scaled(ratio))
        lost = kernel(filled(loss), stroke, here, y * PRESSURE)
        assert kernel(scaled, stroke, there, y * PRESSURE) == pytest.approx(ideal * lost, rel=1e-9)
        assert beyond(scaled, stroke, there, y * PRESSURE) == pytest.approx(
            beyond(filled(loss), stroke, here, y * PRESSURE), rel=1e-6, abs=1e-12
        )


def test_scaling_there_and_back_changes_nothing():
    loss = polynomial({"k_111": 0.3}, FlowLoss)
    back = loss.scaled(8.0).scaled(1 / 8.0)
    assert back.norm == pytest.approx(loss.norm)
    assert back.normal_speed == pytest.approx(loss.normal_speed)
    assert loss.scaled(8.0).norm == pytest.approx(4.0 * loss.norm)


@pytest.mark.parametrize(
    ("changes", "error"),
    [
        ({"coefficients": {"k_500": "1"}}, "'k_500' is no coefficient; allowed: k_ijk with the orders i"),
        ({"coefficients": {"k_0": "1"}}, "each 0 to 4"),
        ({"coefficients": {"k_000": "nan"}}, "not a finite number"),
        ({"norm": "5 L/min"}, "wrong unit; allowed: Nm"),
        (
            {"validity": {"stroke": ["0", "1"], "speed": ["9 rpm", "5 rpm"], "pressure": ["0 bar", "1 bar"]}},
            "a range goes from its least to its largest value",
        ),
    ],
)
def test_what_is_no_polynomial_is_refused(changes, error):
    with pytest.raises(ValidationError, match=error):
        polynomial(**({"coefficients": {}} | changes))
