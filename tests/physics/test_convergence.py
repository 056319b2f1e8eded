"""The Runge-Kutta substep: its observed order where nothing saturates, and stability of the substeps it is given."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from bench import AT_REST, axle, circuit, linearized
from radau import ATOL, State, VerificationSet, derivative, powers
from records import blank
from scipy.integrate import solve_ivp

from ars_mujoco.actuators.pump_controlled.axle import AxleState
from ars_mujoco.actuators.pump_controlled.substeps import substeps
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitState, advance
from ars_mujoco.schema.errors import InputError

GAIN = 60.0  # 1/rad
COMMAND = (2e-3, 0.04, -0.3)  # rad, rad/s, rad/s^2: at no time over 0.2 deg, where no limit is met
DURATION = 0.03  # s
COUNTS = (120, 240, 480, 960)
STATES = tuple(CircuitState.model_fields)
ENERGIES = ("shaft", "motor", "friction", "capacitance", "pump_leakage")


@pytest.fixture(scope="module")
def exact():
    """States and energies at the end, by an explicit method of order eight on the reference's equations."""
    smooth = replace(VerificationSet(), r_C=0.0)

    def rate(t, s):
        c0, c1, c2 = COMMAND
        power = powers(smooth, State(*s[:6]))
        return [*derivative(smooth, s[:6].tolist(), c0 + t * (c1 + t * c2)), *(power[name] for name in ENERGIES)]

    tolerance = [*1e-4 * ATOL, *np.full(len(ENERGIES), 1e-13)]
    run = solve_ivp(rate, (0.0, DURATION), np.zeros(len(tolerance)), "DOP853", rtol=1e-13, atol=tolerance)
    return dict(zip([*STATES, *ENERGIES], run.y[:, -1], strict=True))


@pytest.fixture(scope="module")
def runs():
    """States and energies at the end for each of COUNTS."""
    parameters, found = circuit(), []
    parameters.motor.coulomb_friction = 0.0
    for count in COUNTS:
        state = blank(AxleState)
        advance(axle(parameters), state, state, (COMMAND, GAIN, 0.0, 0.0), DURATION, count)
        parts = (state.circuit, STATES), (state.energy, ENERGIES)
        found.append({name: record[name] for record, names in parts for name in names})
    return found


@pytest.mark.parametrize("names", [STATES, ENERGIES], ids=["states", "energies"])
def test_states_and_energies_converge_with_order_four(runs, exact, names):
    errors = [np.linalg.norm([run[name] / exact[name] - 1.0 for name in names]) for run in runs]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    print(f"orders {orders}, errors {errors}")
    assert orders == pytest.approx(4.0, abs=0.1)


def corners():
    """Circuits at the corners of the paper's Table 2, with and without dry friction."""
    box = product((4e-14, 8e-14), (0.1, 0.25), (6.5, 26.5), (4e-13, 2e-12), (1500, 6000), (0.0, 35.0))
    for oil, inertia, viscous, leakage, rpm, dry in box:
        parameters = circuit()
        parameters.line.capacitance, parameters.motor.inertia = oil, inertia
        parameters.motor.viscous_friction, parameters.motor.coulomb_friction = viscous, dry
        parameters.pump.leakage, parameters.motor.leakage = 0.5625 * leakage, 0.4375 * leakage
        parameters.pump.speed = rpm * 2 * np.pi / 60
        yield parameters


def amplification(z):
    """Largest |R(z)| of the classical Runge-Kutta step over `z` = eigenvalue times substep."""
    return np.abs(1 + z * (1 + z / 2 * (1 + z / 3 * (1 + z / 4)))).max()


PLACES = {
    "at rest": AT_REST,
    "in motion": (0.0, 0.0, 0.0, 0.0, 0.0, 0.5),
    "relieving": (0.0, 0.0, 0.0, 200e5, 0.0, 0.0),
    "at the stop": (0.0, 0.0, 0.0, 0.0, 0.8, 0.0),
}


@pytest.mark.parametrize("where", PLACES)
@pytest.mark.parametrize("step", [5e-4, 1e-3, 2e-3])
def test_every_stable_eigenvalue_stays_stable_in_the_chosen_substeps(where, step):
    growth = 0.0
    for parameters in corners():
        z = np.linalg.eigvals(linearized(parameters, GAIN, PLACES[where])[0]) * step
        z = z[z.real <= 0] / substeps(axle(parameters), step)
        growth = max(growth, amplification(z))
    print(f"{where}, {step} s: |R| = {growth:.6f}")
    assert growth < 1.0 + 1e-9


def test_a_nominal_step_of_1_ms_takes_8_substeps():
    assert substeps(axle(circuit()), 1e-3) == 8


def test_half_the_substeps_of_the_stiffest_corner_would_not_be_stable():
    parameters = circuit()
    parameters.motor.inertia = 0.1
    z = np.linalg.eigvals(linearized(parameters, GAIN)[0]) * 1e-3 / (substeps(axle(parameters), 1e-3) / 2)
    assert amplification(z) > 1.0


def test_a_circuit_faster_than_any_sensible_number_of_substeps_is_refused():
    parameters = circuit()
    parameters.line.capacitance = 1e-20
    with pytest.raises(InputError, match="fastest eigenvalue, .* needs more than 200 substeps of 1 ms"):
        substeps(axle(parameters), 1e-3)


def test_a_faster_valve_gets_more_substeps():
    parameters = circuit()
    parameters.servo_valve.frequency = 2e4
    assert substeps(axle(parameters), 1e-3) > 8
