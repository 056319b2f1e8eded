"""The shipped detailed circuits: their records, their rates in Python, and runs of them on the bench."""

import numpy as np
import shipped

from ars_mujoco.actuators.pump_controlled.full_circuit import detailed_rates
from ars_mujoco.actuators.pump_controlled.full_plant import BYPASS, FAIL_SAFE, POWERS, STATES
from ars_mujoco.recording.recording import Recording

ACTUATORS = {"reduced": "pump_controlled", "full": "pump_controlled_full"}
STAGES = ("third_order", "reduced", "full")
VARIANTS = [(circuit, stage) for circuit in ACTUATORS for stage in STAGES]


def axle(circuit: str = "full", stage: str = "full", *settings: str) -> tuple[np.record, np.record]:
    """(Axle, AxleState) records of the front on the bench, at rest and free to change."""
    chosen = (f"actuator.pump_control={stage}", *settings)
    _, world = shipped.own_copy(shipped.simulation("bench_step_1deg", ACTUATORS[circuit], *chosen))
    return world.parameters.stabilizers.front.copy(), world.now.stabilizers.front.copy()


def drive(cycle: str, circuit: str = "full", stage: str = "full", *settings: str) -> Recording:
    """The recording of a bench cycle."""
    return shipped.recording(cycle, ACTUATORS[circuit], f"actuator.pump_control={stage}", *settings)


def rates(parameters, x, stroke: float = 0.0, twist: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Derivatives and powers of the plant's states `x`, its valves told to stay."""
    derivatives, powers = np.zeros(STATES), np.zeros(POWERS)
    detailed_rates(parameters, x, derivatives, powers, stroke, twist, (x[BYPASS], x[FAIL_SAFE]))
    return derivatives, powers
