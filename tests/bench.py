"""The shipped circuit and runs of it on the bench."""

from pathlib import Path

import numpy as np
from records import filled

from ars_mujoco.actuators.actuator import Actuator
from ars_mujoco.files import read
from ars_mujoco.hydraulics.reduced_circuit import CircuitState, rates
from ars_mujoco.inputs import read_inputs
from ars_mujoco.recording.recording import Recording
from ars_mujoco.setup import Simulation, prepare
from ars_mujoco.simulation import simulate

STIFFNESS = 5700.0  # Nm/rad, of the bench's bar
AT_REST = (0.0,) * 6
NUDGES = {"spool": 1e-6, "spool_rate": 1e-4, "stroke": 1e-6, "pressure": 1.0, "angle": 1e-8, "rate": 1e-7}


def circuit(axle: str = "front") -> np.record:
    """The record of the shipped ReducedCircuit of an axle."""
    return filled(getattr(read(Actuator, "pump_controlled", "actuator").value, axle))


def bench(cycle: str | Path, *settings: str) -> Simulation:
    """The simulation of a bench cycle, with settings as the command line takes them."""
    inputs = read_inputs(str(cycle), settings=settings)
    return prepare(inputs.cycle.value, inputs.actuator.value, inputs.controller.value, inputs.vehicle.value)


def drive(cycle: str | Path, *settings: str) -> Recording:
    """The recording of a bench cycle, with settings as the command line takes them."""
    return simulate(bench(cycle, *settings))


def linearized(parameters: np.record, gain: float = 0.0, at: tuple = AT_REST) -> tuple[np.ndarray, np.ndarray]:
    """(6, 6) derivatives of the circuit's rates by its state, the outer loop closed with `gain`, and (6,) by the stroke
    command; central differences of the running code.
    """

    def slope(by, by_command):
        ahead, behind = (
            rates(parameters, STIFFNESS, tuple(np.add(at, h * by)), h * (by_command - gain * by[4]), 0.0)[0] for h in (1, -1)
        )
        return np.subtract(ahead, behind) / 2.0

    nudges = np.diag([NUDGES[name] for name in CircuitState.model_fields])
    states = np.column_stack([slope(nudge, 0.0) / nudge.sum() for nudge in nudges])
    return states, slope(np.zeros(6), 1e-6) / 1e-6
