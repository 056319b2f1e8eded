"""Running loop: a loop's own circuit, started at rest and driven by a command as on the bench."""

import numpy as np

from ars_mujoco.actuators.pump_controlled.full_circuit import REDUCED_PLANT, WORK, advance_detailed
from ars_mujoco.actuators.pump_controlled.pump_control import THIRD_ORDER
from ars_mujoco.actuators.pump_controlled.substeps import detailed_substeps, substeps
from ars_mujoco.actuators.pump_controlled.third_order_circuit import advance
from ars_mujoco.analysis.loop import Loop
from ars_mujoco.kernels.kernel import entry, kernel

VALVES = (0.0, 1.0)  # openings: bypass shut, fail-safe open


def started(loop: Loop, step: float) -> tuple[np.record, np.record, np.record]:
    """(axle, state, work) records for `follow`: the loop's circuit, divided for steps of `step` (s), and at rest."""
    axle = loop.axle
    if loop.is_detailed:
        axle.substeps = detailed_substeps(axle, step, bypassed=False)
    else:
        axle.substeps = substeps(axle, step)
    return axle, loop.at_rest(), np.zeros(1, WORK).view(np.recarray)[0]


def step_response(loop: Loop, gain: float, command: float, step: float, count: int) -> np.ndarray:
    """The angle (rad) after each of `count` steps (s), with K_p `gain` (1/rad), for a command (rad) that jumps."""
    angle = np.zeros(count)
    _step_response(*started(loop, step), gain, command, step, angle)
    return angle


@kernel
def follow(axle, state, work, command, gain: float, step: float) -> None:
    """Advance `state` by `step` s under a command (c0, c1, c2) as in `third_order_circuit`, with K_p `gain`."""
    if axle.detail.plant == REDUCED_PLANT and axle.detail.stage == THIRD_ORDER:
        advance(axle, state, state, (command, gain, 0.0, 0.0), step, int(axle.substeps))
    else:
        advance_detailed(axle, state, state, (command, gain, 0.0, 0.0), VALVES, step, work)


@entry
def _step_response(axle, state, work, gain, command, step, angle):
    for i in range(len(angle)):
        follow(axle, state, work, (command, 0.0, 0.0), gain, step)
        angle[i] = state.circuit.angle
