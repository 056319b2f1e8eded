"""A pipe against the closed forms of its volume, its mass and its friction."""

import math

import numpy as np
import pytest
from components import PIPE, oil, pipe, record_of
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from scipy.integrate import solve_ivp

from ars_mujoco.hydraulics.pipe import Pipe, area, inertance, pressure_drop, reynolds, volume

BAR = 1e5
FLUID, LINE = record_of(oil()), pipe()
FLOWS = st.floats(-2e-3, 2e-3)


def flow_at(number):
    """Flow (m^3/s) at a Reynolds number."""
    return number * area(LINE) * FLUID.viscosity / LINE.diameter


def test_a_line_of_3_34_m_and_10_mm_holds_the_papers_volume():
    assert volume(pipe(length="3.34 m")) == pytest.approx(2.62e-4, rel=2e-3)


def test_its_mass_is_that_of_its_oil():
    mass = inertance(LINE, FLUID) * area(LINE) ** 2
    assert mass == pytest.approx(FLUID.density * volume(LINE))


def test_a_step_of_pressure_speeds_the_flow_up_and_friction_then_holds_it():
    """I dQ/dt = dp - R Q from rest: Q = dp/R (1 - exp(-R t/I)), laminar."""
    step = 0.1 * BAR
    resistance = 128 * FLUID.viscosity * FLUID.density * 2.0 / (math.pi * 0.01**4)
    lag = inertance(LINE, FLUID) / resistance
    time = np.linspace(0.0, 3 * lag, 31)
    run = solve_ivp(
        lambda t, q: (step - pressure_drop(LINE, FLUID, q[0])) / inertance(LINE, FLUID),
        (0.0, time[-1]), [0.0], "DOP853", time, rtol=1e-10, atol=1e-14,
    )  # fmt: skip
    assert reynolds(LINE, FLUID, run.y[0, -1]) < 2300
    assert run.y[0] == pytest.approx(step / resistance * (1 - np.exp(-time / lag)), rel=1e-8, abs=1e-12)
    assert run.y[0, 1] == pytest.approx(step / inertance(LINE, FLUID) * time[1], rel=0.06)


@given(st.floats(-2299.0, 2299.0))
def test_laminar_flow_loses_the_pressure_of_hagen_and_poiseuille(number):
    flow = flow_at(number)
    expected = 128 * FLUID.viscosity * FLUID.density * 2.0 * flow / (math.pi * 0.01**4)
    assert pressure_drop(LINE, FLUID, flow) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(("number", "coefficient"), [(4001, 0.03978), (10_000, 0.03164), (100_000, 0.01779)])
def test_turbulent_flow_has_the_resistance_coefficient_of_blasius(number, coefficient):
    speed = flow_at(number) / area(LINE)
    drop = pressure_drop(LINE, FLUID, flow_at(number))
    assert drop / (0.5 * FLUID.density * speed**2 * 2.0 / 0.01) == pytest.approx(coefficient, rel=2e-4)


@pytest.mark.parametrize("number", [2300, 4000])
def test_where_the_flow_changes_its_kind_the_pressure_does_not_jump(number):
    below, above = (pressure_drop(LINE, FLUID, flow_at(number * (1 + side))) for side in (-1e-9, 1e-9))
    assert above == pytest.approx(below, rel=1e-7)


def test_between_the_two_the_pressure_is_linear_in_the_flow():
    drops = [pressure_drop(LINE, FLUID, flow_at(number)) for number in (2300, 3150, 4000)]
    assert drops[1] == pytest.approx((drops[0] + drops[2]) / 2)


@given(FLOWS, st.floats(1e-7, 1e-4))
def test_friction_is_odd_takes_energy_and_rises_with_the_flow(flow, more):
    drop = pressure_drop(LINE, FLUID, flow)
    assert pressure_drop(LINE, FLUID, -flow) == -drop
    assert drop * flow >= 0.0
    assert pressure_drop(LINE, FLUID, flow + more) > drop


def test_cold_oil_is_harder_to_move():
    cold = record_of(oil(temperature="0 degC"))
    ratio = cold.viscosity * cold.density / (FLUID.viscosity * FLUID.density)
    assert ratio > 8.0
    assert pressure_drop(LINE, cold, 9e-5) / pressure_drop(LINE, FLUID, 9e-5) == pytest.approx(ratio)


@pytest.mark.parametrize(
    ("lumps", "message"),
    [("2.5", "must be a whole number"), ("0", "must be at least 1"), ("5", "must be at most 4"), ("2 m", "wrong unit")],
)
def test_a_line_is_divided_into_one_to_four_whole_lumps(lumps, message):
    with pytest.raises(ValidationError, match=message):
        Pipe(**PIPE | {"lumps": lumps})
