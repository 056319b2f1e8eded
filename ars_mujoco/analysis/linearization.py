"""Linearization: the running circuit as a state space at rest, by central differences of `reduced_circuit.rates`.

Dry friction is left out unless it is asked for. Its rounding over 0.01 rad/s makes the slope of friction at standstill
3516 Nms/rad in place of the viscous 16.5: true within a hundredth of a rad/s only, with a pole at -20,060 1/s and no
hydraulic pole pair. The paper, too, linearizes the viscous term alone (section 4.2.2).
"""

import control
import numpy as np

from ars_mujoco.analysis.loop import Loop
from ars_mujoco.hydraulics.pump import ideal_flow
from ars_mujoco.hydraulics.reduced_circuit import CircuitState, rates
from ars_mujoco.kernel import entry

STATES = list(CircuitState.model_fields)
STROKE, PRESSURE, ANGLE, RATE = (STATES.index(name) for name in ("stroke", "pressure", "angle", "rate"))
PLANT = [PRESSURE, ANGLE, RATE]
OUTPUTS = ["angle", "pressure"]

# around rest the equations are linear up to the saturations and, in the rate, over a small part of w_s
NUDGES = (1e-3, 1e-2, 1e-3, 1e3, 1e-4, 1e-6)
COMMAND_NUDGE = 1e-3


def state_matrices(loop: Loop, dry_friction: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """A (6, 6) and B (6, 1) of the circuit at rest, from the stroke command to the states of CircuitState (SI)."""
    circuit = (loop if dry_friction else loop.without_dry_friction()).circuit
    states = [_slope(circuit, loop.stiffness, nudge, 0.0) / nudge.sum() for nudge in np.diag(NUDGES)]
    command = _slope(circuit, loop.stiffness, np.zeros(len(NUDGES)), COMMAND_NUDGE) / COMMAND_NUDGE
    return np.column_stack(states), command[:, None]


def hydraulic_matrix(loop: Loop) -> np.ndarray:
    """A (2, 2) of eq. 43, from the states (pressure, rate) of eq. 44: the plant without the bar's spring."""
    A, _ = state_matrices(loop)
    return A[np.ix_([PRESSURE, RATE], [PRESSURE, RATE])]


def plant(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """The plant, eq. 43 with the angle and the bar's spring: from pump flow (m^3/s) to angle (rad), pressure (Pa)."""
    A, _ = state_matrices(loop, dry_friction)
    flow = A[PLANT, STROKE, None] / ideal_flow(loop.circuit.pump, 1.0)
    C = np.eye(3)[[PLANT.index(ANGLE), PLANT.index(PRESSURE)]]
    names = [STATES[i] for i in PLANT]
    return control.ss(A[np.ix_(PLANT, PLANT)], flow, C, 0.0, inputs="flow", outputs=OUTPUTS, states=names)


def actuator(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """Pump control and plant: from the stroke command (1) to angle (rad) and pressure (Pa)."""
    A, B = state_matrices(loop, dry_friction)
    C = np.eye(len(STATES))[[ANGLE, PRESSURE]]
    return control.ss(A, B, C, 0.0, inputs="stroke_command", outputs=OUTPUTS, states=STATES)


def pump_control(loop: Loop) -> control.StateSpace:
    """The inner loop alone: from the stroke command (1) to the stroke (1)."""
    A, B = state_matrices(loop)
    own = [STATES.index(name) for name in ("spool", "spool_rate", "stroke")]
    return control.ss(A[np.ix_(own, own)], B[own], [[0.0, 0.0, 1.0]], 0.0)


def open_loop(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """From the angle's error (rad) to the angle (rad): K_p times the actuator."""
    return loop.gain * actuator(loop, dry_friction)["angle", "stroke_command"]


def closed_loop(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """From the commanded angle (rad) to angle (rad) and pressure (Pa)."""
    system = actuator(loop, dry_friction)
    A, B, C = system.A, loop.gain * system.B, system.C
    return control.ss(A - B @ C[:1], B, C, 0.0, inputs="command", outputs=OUTPUTS, states=STATES)


def _slope(circuit, stiffness, nudge, command) -> np.ndarray:
    ahead = _rates(circuit, stiffness, tuple(nudge), command)
    behind = _rates(circuit, stiffness, tuple(-nudge), -command)
    return 0.5 * np.subtract(ahead, behind)


@entry
def _rates(circuit, stiffness, state, stroke_command):
    return rates(circuit, stiffness, state, stroke_command, 0.0)[0]
