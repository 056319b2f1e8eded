"""The shipped circuit and runs of it on the bench."""

from pathlib import Path

import numpy as np
from records import blank, filled

from ars_mujoco.actuators.pump_controlled.axle import Axle
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitState, rates
from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.hydraulics.line import ONE_SIDED
from ars_mujoco.recording.recording import Recording
from ars_mujoco.rigs.setup import prepare
from ars_mujoco.schema.document import read
from ars_mujoco.simulation.simulation import Simulation, simulate
from ars_mujoco.studies.inputs import read_inputs

STIFFNESS = 5700.0  # Nm/rad, of the bench's bar
AT_REST = (0.0,) * 6
NUDGES = (1e-6, 1e-4, 1e-6, 1.0, 1e-8, 1e-7)  # of the six states, for differences
ANGLE = list(CircuitState.model_fields).index("angle")


def circuit(axle: str = "front") -> np.record:
    """The record of the shipped ReducedCircuit of an axle."""
    return filled(getattr(read(actuator_schema(), "pump_controlled", "actuator").value, axle))


def axle(circuit: np.record, stiffness: float = STIFFNESS) -> np.record:
    """The Axle record of a circuit on a bar."""
    parameters = blank(Axle)
    parameters.circuit, parameters.stiffness = circuit, stiffness
    return parameters


def one_sided() -> np.record:
    """The shipped front circuit with the capacitance of its high-pressure side alone, twice that of both in series."""
    parameters = circuit()
    parameters.line.sides = ONE_SIDED
    parameters.line.capacitance *= 2.0
    return parameters


def bench(cycle: str | Path, *settings: str, actuator: str | None = None) -> Simulation:
    """The simulation of a bench cycle, with settings as the command line takes them."""
    inputs = read_inputs(str(cycle), actuator, settings=settings)
    return prepare(inputs.cycle.value, inputs.actuator.value, inputs.controller.value, inputs.vehicle.value)


def drive(cycle: str | Path, *settings: str, actuator: str | None = None) -> Recording:
    """The recording of a bench cycle, with settings as the command line takes them."""
    return simulate(bench(cycle, *settings, actuator=actuator))


def linearized(parameters: np.record, gain: float = 0.0, at: tuple = AT_REST) -> tuple[np.ndarray, np.ndarray]:
    """(6, 6) derivatives of the circuit's rates by its state, the outer loop closed with `gain`, and (6,) by the stroke
    command; central differences of the running code.
    """

    def rate(by, by_command):
        stroke_command = by_command - gain * by[ANGLE]
        return np.array(rates(parameters, STIFFNESS, tuple(np.add(at, by)), stroke_command, 0.0)[0])

    def slope(by, by_command):
        return (rate(by, by_command) - rate(-by, -by_command)) / 2.0

    states = [slope(nudge, 0.0) / nudge.sum() for nudge in np.diag(NUDGES)]
    return np.column_stack(states), slope(np.zeros(6), 1e-6) / 1e-6
