"""Substeps: how many Runge-Kutta steps of the circuit a physics step needs, from the eigenvalues of its equations."""

from functools import partial

import numpy as np

from ars_mujoco.actuators.pump_controlled.full_circuit import detailed_rates, start_plant
from ars_mujoco.actuators.pump_controlled.full_plant import (
    ANGLE,
    BYPASS,
    FAIL_SAFE,
    FLOW_A,
    GALLERY,
    POWERS,
    RATE,
    STATES,
    A,
)
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitState, axle_rates
from ars_mujoco.kernels.kernel import entry
from ars_mujoco.kernels.substeps import derivatives, differences, fewest_substeps, scales, slopes
from ars_mujoco.schema.parameters import record_dtype

IDLE = (0.0, 0.0, 0.0), 0.0, 0.0, 0.0  # a demand for no stroke, on a bar that is not twisted
PLANT_NUDGES = np.array([1e2] * FLOW_A + [1e-9] * (GALLERY - FLOW_A) + [1e2, 1e-6, 1e-6, 1e-4, 1e-4])

_derivatives = derivatives(axle_rates)


def substeps(axle, step: float) -> int:
    """The fewest substeps of a physics step (s) in which all that decays does decay, and oscillations are resolved.

    Looked at where the reduced circuit of `axle` with its pump control is stiffest: at rest (the friction's rounding),
    moving, over the relief valve's pressure and past the mechanical stop. Raises InputError where too many are needed.
    """
    states = np.zeros(4, record_dtype(CircuitState)).view(np.recarray)
    states[1].rate = 1.0  # rad/s
    states[2].pressure = 1.1 * axle.circuit.relief_valve.pressure
    states[3].angle = 1.01 * axle.circuit.motor.stop_angle
    nudges = scales(CircuitState)
    return fewest_substeps([slopes(_derivatives, axle, IDLE, state, nudges) for state in states], step)


def detailed_substeps(axle, step: float, bypassed: bool) -> int:
    """The same for the plant of a detailed circuit, an `axle.Axle` record; its pump control takes implicit steps.

    Looked at also with open check valves, with a shut fail-safe valve and, where it will be `bypassed`, with an open
    bypass valve.
    """
    states = np.zeros((6, STATES))
    for state in states:
        start_plant(axle, state)
    states[:, BYPASS] = bypassed
    states[1, RATE] = 1.0  # rad/s
    states[2, A] += 1.1 * axle.circuit.relief_valve.pressure
    states[3, ANGLE] = 1.01 * axle.circuit.motor.stop_angle
    states[4, GALLERY] *= 2.0
    states[5, FAIL_SAFE] = 0.0
    return fewest_substeps([differences(partial(_plant_rates, axle), state, PLANT_NUDGES) for state in states], step)


def _plant_rates(axle, state: np.ndarray) -> np.ndarray:
    """Derivatives of a detailed circuit's plant at rest of its pump control."""
    rates = np.zeros(STATES)
    _fill_plant_rates(axle, state, rates, np.zeros(POWERS))
    return rates


@entry
def _fill_plant_rates(axle, state, rates, powers):
    detailed_rates(axle, state, rates, powers, 0.0, 0.0, (state[BYPASS], state[FAIL_SAFE]))
