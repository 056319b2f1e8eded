"""The full circuit and every stage of pump control linearized, beside matrices written by hand."""

import math

import control
import numpy as np
import pytest
from full_theory import FRONT, REAR, cylinder_matrix, held, plant_matrix
from theory import LOOP

from ars_mujoco.actuators.pump_controlled.pump_control import FULL, REDUCED, THIRD_ORDER
from ars_mujoco.analysis.frequency_response import linear, measured
from ars_mujoco.analysis.line_inertance import with_pipe
from ars_mujoco.analysis.linearization import (
    actuator,
    control_states,
    plant,
    plant_states,
    pump_control,
    state_matrices,
)
from ars_mujoco.analysis.loop import loop_of
from ars_mujoco.analysis.margins import margins
from ars_mujoco.analysis.steady_state import error
from ars_mujoco.hydraulics.oil import viscosity_ratio
from ars_mujoco.studies.inputs import read_inputs

PLANT_SIZES = np.array([1e5, 1e5, 1e5, 1e5, 1e-5, 1e-5, 1e5, 0.01, 1.0])
CONTROL_SIZES = np.array([0.1, 10.0, 0.1, 1e5, 1e5, 0.1])


def assert_same_matrix(found, expected, sizes):
    """Every entry to 1e-4 of itself, or to 1e-7 of the greatest in its row, with the states in units of their sizes."""
    scaled, wanted = (matrix * sizes / sizes[:, None] for matrix in (found, expected))
    near_nothing = 1e-7 * np.abs(wanted).max(axis=1, keepdims=True)
    wrong = np.abs(scaled - wanted) > 1e-4 * np.abs(wanted) + near_nothing
    assert not wrong.any(), np.argwhere(wrong)


@pytest.mark.parametrize("loop", [FRONT, REAR, held(FRONT), held(REAR), FRONT.at({"speed": 600.0, "inertia": 0.1})])
def test_the_full_plant_has_the_matrix_of_the_equations(loop):
    assert_same_matrix(plant(loop).A, plant_matrix(loop), PLANT_SIZES)


@pytest.mark.parametrize("loop", [FRONT, REAR, held(FRONT), held(REAR)])
def test_its_poles_are_within_a_thousandth_of_the_analytic_ones(loop):
    found, expected = (np.sort_complex(poles) for poles in (plant(loop).poles(), np.linalg.eigvals(plant_matrix(loop))))
    slow = np.abs(expected) < 1.0  # a charge that leaks away, in seconds
    np.testing.assert_allclose(found[~slow], expected[~slow], rtol=1e-3)
    np.testing.assert_allclose(found[slow], expected[slow], atol=0.01)


def test_the_full_pump_control_has_the_matrix_of_the_equations():
    loop = LOOP.at_stage(FULL)
    assert_same_matrix(pump_control(loop).A, cylinder_matrix(loop), CONTROL_SIZES)


def test_the_reduced_pump_control_is_the_full_one_between_its_two_pressures():
    reduced = pump_control(LOOP.at_stage(REDUCED)).poles()
    full = pump_control(LOOP.at_stage(FULL)).poles()
    common = full[np.abs(full + 358.9).argmin()]  # both chambers together, which moves nothing
    rest = np.sort_complex(full[full != common])
    np.testing.assert_allclose(np.sort_complex(reduced), rest, rtol=5e-4)


@pytest.mark.parametrize("stage", [THIRD_ORDER, REDUCED, FULL])
@pytest.mark.parametrize("lumps", [1, 4])
def test_states_are_those_that_the_stages_have(stage, lumps):
    loop = with_pipe(FRONT, lumps=lumps).at_stage(stage)
    names = actuator(loop).state_labels
    assert names == [*control_states(loop), *plant_states(loop)]
    assert len(names) == {THIRD_ORDER: 3, REDUCED: 5, FULL: 6}[stage] + 4 * lumps + 5
    assert state_matrices(loop)[0].shape == (len(names), len(names))


@pytest.mark.parametrize("loop", [FRONT, held(FRONT)])
def test_at_rest_the_pressure_is_the_flow_over_all_that_leaks(loop):
    # both checks shut, each side loses its own k_x, which is k_x/2 more of leakage between them; held, k_x of side A
    leakage = loop.circuit.pump.leakage + loop.circuit.motor.leakage
    extra = loop.detail.tank_leakage * (0.5 if loop is FRONT else 1.0)
    flow = loop.circuit.pump.displacement * loop.circuit.pump.speed
    at_rest = float(control.dcgain(actuator(loop)["pressure", "stroke_command"]))
    assert at_rest == pytest.approx(flow / (leakage + extra), rel=1e-2)
    spring = loop.stiffness / loop.circuit.motor.displacement
    assert error(loop) == pytest.approx(1 / (1 + loop.gain * at_rest / spring), rel=1e-9)


def test_a_mirrored_circuit_has_the_same_poles():
    # both shut, neither side is the low one: exchanging A and B leaves the matrix as it is
    A, names = plant(FRONT).A, list(plant_states(FRONT))
    other = [name.replace("_a", "_x").replace("_b", "_a").replace("_x", "_b") for name in names]
    swapped = [names.index(name) for name in other]
    sign = np.diag([-1.0 if name in ("angle", "rate") else 1.0 for name in names])
    np.testing.assert_allclose((sign @ A[np.ix_(swapped, swapped)] @ sign), A, rtol=1e-6, atol=1e-7 * np.abs(A).max())


def test_a_held_low_side_is_softer_than_two_sides_in_series():
    shut, low = (margins(0.5 * FRONT.gain * actuator(each)["angle", "stroke_command"]) for each in (FRONT, held(FRONT)))
    assert low["gain_margin"] < shut["gain_margin"] - 3.0


@pytest.mark.parametrize("actuated", ["pump_controlled", "pump_controlled_full"])
@pytest.mark.parametrize("stage", ["third_order", "full"])
def test_small_sines_get_the_linear_response_with_both_checks_shut(actuated, stage):
    inputs = read_inputs("bench_s_curve", actuated, settings=[f"actuator.pump_control={stage}"])
    loop = loop_of(inputs).without_dry_friction()
    frequencies = np.array([2.0, 10.0, 20.0])
    ratio = measured(loop, math.radians(0.1), frequencies) / linear(loop, frequencies)
    assert np.abs(20 * np.log10(np.abs(ratio))).max() < 0.5
    assert np.abs(np.degrees(np.angle(ratio))).max() < 3.0


def test_the_temperature_of_the_oil_reaches_the_linear_loop():
    inputs = read_inputs("bench_s_curve", settings=["actuator.front.oil.temperature=0 degC"])
    ratio = viscosity_ratio(inputs.actuator.value.front.oil)
    assert ratio > 4
    cold, warm = loop_of(inputs).circuit.motor, LOOP.circuit.motor
    assert cold.viscous_friction == pytest.approx(ratio * warm.viscous_friction)
