"""The shipped detailed circuits: their records, their rates in Python, and runs of them on the bench."""

import numpy as np
import shipped
from bench import STIFFNESS
from records import blank

from ars_mujoco.actuators.pump_controlled.axle import DetailedAxle, DetailedAxleState
from ars_mujoco.actuators.pump_controlled.file import fill_axle
from ars_mujoco.actuators.pump_controlled.full_circuit import detailed_rates, start_detailed
from ars_mujoco.actuators.pump_controlled.full_plant import BYPASS, FAIL_SAFE, POWERS, STATES
from ars_mujoco.actuators.pump_controlled.substeps import detailed_substeps
from ars_mujoco.recording.recording import Recording
from ars_mujoco.studies.inputs import read_inputs

ACTUATORS = {"reduced": "verification", "full": "pump_controlled_full"}
FIXED = (  # the verification set's loop, and its plate that only the flow knows to be at its stop
    "actuator.control.loop.gain=60 1/rad", "actuator.control.loop.schedule=0", "actuator.front.swash_plate.stop=flow",
)  # fmt: skip
STAGES = ("third_order", "reduced", "full")
VARIANTS = [(circuit, stage) for circuit in ACTUATORS for stage in STAGES]


def axle(circuit: str = "full", stage: str = "full", *settings: str) -> tuple[np.record, np.record]:
    """(DetailedAxle, DetailedAxleState) records of the front on the bench, at rest and free to change."""
    chosen = (*FIXED, f"actuator.pump_control={stage}", *settings)
    file = read_inputs("bench_step_1deg", ACTUATORS[circuit], settings=chosen).actuator.value
    parameters, state = blank(DetailedAxle), blank(DetailedAxleState)
    fill_axle(parameters, file, "front", STIFFNESS, 1e-3)
    if (circuit, stage) == ("reduced", "third_order"):  # which the verification set takes at once; here in two
        parameters.substeps = detailed_substeps(parameters, 1e-3, bypassed=False)
    start_detailed(parameters, state)
    return parameters, state


def drive(cycle: str, circuit: str = "full", stage: str = "full", *settings: str) -> Recording:
    """The recording of a bench cycle."""
    return shipped.recording(cycle, ACTUATORS[circuit], *FIXED, f"actuator.pump_control={stage}", *settings)


def rates(parameters, x, stroke: float = 0.0, twist: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Derivatives and powers of the plant's states `x`, its valves told to stay."""
    derivatives, powers = np.zeros(STATES), np.zeros(POWERS)
    detailed_rates(parameters, x, derivatives, powers, stroke, twist, (x[BYPASS], x[FAIL_SAFE]))
    return derivatives, powers
