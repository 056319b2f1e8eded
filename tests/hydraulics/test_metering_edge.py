"""Metering edges against eqs. 9 to 11, the powers they take, and their slopes."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from detailed import axle
from hypothesis import assume, given
from hypothesis import strategies as st

from ars_mujoco.hydraulics.metering_edge import (
    common_flow,
    edge_flow_a,
    edge_flow_b,
    largest_stroke_rate,
    mean_supply_power,
    supply_power,
)
from ars_mujoco.hydraulics.orifice import rounded_root

BAR = 1e5
PARAMETERS, _ = axle()
EDGE = PARAMETERS.circuit.metering_edge
SPOOLS, PRESSURES, LOADS = st.floats(-1.0, 1.0), st.floats(0.01 * BAR, 40 * BAR), st.floats(-30 * BAR, 30 * BAR)


def sharp():
    """Edges without leakage, whose flow is turbulent down to a thousandth of a bar."""
    edge = EDGE.copy()
    edge.leakage, edge.laminar_pressure = 0.0, 1e-3 * BAR
    return edge


@pytest.mark.parametrize(
    ("spool", "a", "b"),
    # eqs. 9 and 10 with p_A = 10 bar, p_B = 17 bar between 26 and 1 bar: the drops are those of supply or return
    [(0.4, 16, -16), (-0.4, -9, 9), (1.0, 16, -16)],
)
def test_the_flow_through_an_edge_goes_with_the_root_of_its_pressure(spool, a, b):
    opening = 5.7e-4 * 0.3e-3 * abs(spool)
    assert edge_flow_a(sharp(), spool, 10 * BAR)[0] == pytest.approx(
        math.copysign(opening * math.sqrt(abs(a) * BAR), a), rel=1e-6
    )
    assert edge_flow_b(sharp(), spool, 17 * BAR)[0] == pytest.approx(
        math.copysign(opening * math.sqrt(abs(b) * BAR), b), rel=1e-6
    )


def test_a_closed_valve_leaks_from_supply_to_return_and_holds_the_middle():
    middle = 13.5 * BAR
    assert edge_flow_a(EDGE, 0.0, middle)[0] == pytest.approx(0.0, abs=1e-20)
    assert edge_flow_a(EDGE, 0.0, middle + 2 * BAR)[0] == pytest.approx(-2 * 2e-13 * 2 * BAR)
    assert supply_power(EDGE, 0.0, middle, middle) == pytest.approx(25 * BAR * 2 * 2e-13 * 12.5 * BAR)


@given(SPOOLS, PRESSURES)
def test_chamber_b_is_chamber_a_with_the_spool_the_other_way(spool, pressure):
    a, b = edge_flow_a(EDGE, -spool, pressure), edge_flow_b(EDGE, spool, pressure)
    assert b == (a[0], -a[1], a[2])


@given(SPOOLS, LOADS)
def test_the_common_flow_is_odd(spool, load):
    assume(spool != 0.0)
    flow, by_spool, by_load = common_flow(EDGE, spool, load)
    assert common_flow(EDGE, -spool, -load) == (-flow, by_spool, by_load)


@given(SPOOLS, st.floats(-24 * BAR, 24 * BAR))
def test_with_pressures_about_the_middle_both_edges_carry_the_common_flow(spool, load):
    edge = EDGE.copy()
    edge.leakage = 0.0
    a, b = 13.5 * BAR + 0.5 * load, 13.5 * BAR - 0.5 * load
    flow = common_flow(edge, spool, load)[0]
    assert edge_flow_a(edge, spool, a)[0] == pytest.approx(flow, rel=1e-9, abs=1e-18)
    assert edge_flow_b(edge, spool, b)[0] == pytest.approx(-flow, rel=1e-9, abs=1e-18)


@pytest.mark.parametrize("flow", [edge_flow_a, edge_flow_b, common_flow])
def test_slopes_are_those_of_the_flow(flow):
    random = np.random.default_rng(1)
    for spool, bar in random.uniform([-1, 0.1], [1, 40], (200, 2)):
        _, by_spool, by_pressure = flow(EDGE, spool, bar * BAR)
        ds, dp = 1e-5 * spool, 10.0
        measured = (flow(EDGE, spool + ds, bar * BAR)[0] - flow(EDGE, spool - ds, bar * BAR)[0]) / (2 * ds)
        assert by_spool == pytest.approx(measured, rel=1e-6)
        measured = (flow(EDGE, spool, bar * BAR + dp)[0] - flow(EDGE, spool, bar * BAR - dp)[0]) / (2 * dp)
        assert by_pressure == pytest.approx(measured, rel=1e-5)


@given(SPOOLS, st.floats(1 * BAR, 26 * BAR), st.floats(1 * BAR, 26 * BAR))
def test_the_supply_gives_what_the_chambers_take_and_the_edges_lose(spool, a, b):
    """Flow from the supply = the chambers' gain + flow to the return line, so its power covers both."""
    rise_a, rise_b = a - BAR, b - BAR
    given_power = supply_power(EDGE, spool, a, b)
    gained = edge_flow_a(EDGE, spool, a)[0] * rise_a + edge_flow_b(EDGE, spool, b)[0] * rise_b
    assert given_power >= max(gained, 0.0) - 1e-9


@given(SPOOLS)
def test_without_chamber_pressures_the_supply_is_taken_at_no_load(spool):
    assert mean_supply_power(EDGE, spool) == supply_power(EDGE, spool, 13.5 * BAR, 13.5 * BAR)
    through = 5.7e-4 * 0.3e-3 * abs(spool) * rounded_root(12.5 * BAR, BAR)
    assert mean_supply_power(EDGE, spool) == pytest.approx(25 * BAR * (through + 4e-13 * 12.5 * BAR))


def test_the_shipped_valve_turns_the_swash_plate_nearly_as_fast_as_the_integrator_of_third_order():
    """B y_max sqrt(12.5 bar) / (A x_max): 248 1/s against the 250 1/s of eq. 20."""
    stated = EDGE.constant * EDGE.stroke * math.sqrt(12.5 * BAR) / (1.54e-4 * 5e-3)
    assert largest_stroke_rate(EDGE, SimpleNamespace(area=1.54e-4, travel=5e-3)) == pytest.approx(stated)
    assert stated == pytest.approx(248.3, abs=0.1)
