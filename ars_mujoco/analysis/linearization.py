"""Linearization: the running circuit as a state space at rest, by central differences of its rates.

Dry friction is left out unless it is asked for. Its rounding over 0.01 rad/s makes the slope of friction at standstill
3516 Nms/rad in place of the viscous 16.5: true within a hundredth of a rad/s only, with a pole at -20,060 1/s and no
hydraulic pole pair. The paper, too, linearizes the viscous term alone (section 4.2.2).

States are those that the loop's stages have, under the names of CONTROL and of the plant; the openings of valves, which
are commanded, are no states here. `Loop.checks` says which side of the check valves' kink is taken.
"""

import control
import numpy as np

from ars_mujoco.actuators.pump_controlled.full_circuit import control_state, detailed_rates
from ars_mujoco.actuators.pump_controlled.full_plant import (
    ANGLE,
    BYPASS,
    FAIL_SAFE,
    FLOW_A,
    FLOW_B,
    GALLERY,
    POWERS,
    RATE,
)
from ars_mujoco.actuators.pump_controlled.full_plant import A as SIDE_A
from ars_mujoco.actuators.pump_controlled.full_plant import B as SIDE_B
from ars_mujoco.actuators.pump_controlled.pump_control import FULL, REDUCED, THIRD_ORDER, control_rates
from ars_mujoco.analysis.loop import BOTH_SHUT, Loop
from ars_mujoco.hydraulics.pump import ideal_flow
from ars_mujoco.kernels.kernel import entry

CONTROL = ("spool", "spool_rate", "control_pressure_a", "control_pressure_b", "stroke", "piston_rate")
OF_STAGE = {THIRD_ORDER: (0, 1, 4), REDUCED: (0, 1, 4, 2, 5), FULL: (0, 1, 4, 2, 3, 5)}  # of CONTROL, the stroke early
PLANT = len(CONTROL)  # where its states begin
OUTPUTS = ["angle", "pressure"]

# around rest the equations are linear up to the saturations, the few Pa of an open check valve, and in the rate over a
# small part of w_s
NUDGES = np.array([1e-3, 1e-2, 1e3, 1e3, 1e-3, 1e-6] + [1.0] * FLOW_A + [1e-9] * (GALLERY - FLOW_A) + [1.0, 1e-4, 1e-6])
COMMAND_NUDGE = 1e-3
LIFT = 1e2  # Pa, by which a line is lifted for its check valve to be shut; at rest it is open by a fifth of that


def plant_states(loop: Loop) -> dict[str, int]:
    """Names of the plant's states and where they lie among those of `full_circuit`."""
    if not loop.has_full_circuit:
        return {"pressure": SIDE_A, "angle": ANGLE, "rate": RATE}
    lumps = int(loop.detail.pipe.lumps)
    nodes = {f"pressure_{side}{j}": at + j for side, at in (("a", SIDE_A), ("b", SIDE_B)) for j in range(lumps + 1)}
    flows = {f"flow_{side}{j + 1}": at + j for side, at in (("a", FLOW_A), ("b", FLOW_B)) for j in range(lumps)}
    return nodes | flows | {"gallery": GALLERY, "angle": ANGLE, "rate": RATE}


def control_states(loop: Loop) -> dict[str, int]:
    """Names of the pump control's states and where they lie in CONTROL."""
    return {CONTROL[i]: i for i in OF_STAGE[float(loop.detail.stage)]}


def state_matrices(loop: Loop, dry_friction: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """A (n, n) and B (n, 1) of the circuit at rest, from the stroke command to the states of pump control and plant
    (SI), in the order of `control_states` and `plant_states`.
    """
    axle = (loop if dry_friction else loop.without_dry_friction()).axle
    rest = _rest(loop)
    own = [*control_states(loop).values(), *(PLANT + i for i in plant_states(loop).values())]
    columns = [_slope(axle, rest, i, 0.0) / NUDGES[i] for i in own]
    command = _slope(axle, rest, None, COMMAND_NUDGE) / COMMAND_NUDGE
    return np.column_stack(columns)[own], command[own, None]


def hydraulic_matrix(loop: Loop) -> np.ndarray:
    """A (2, 2) of eq. 43, from the states (pressure, rate) of eq. 44: a reduced plant without the bar's spring."""
    A, _ = state_matrices(loop)
    names = [*control_states(loop), *plant_states(loop)]
    own = [names.index("pressure"), names.index("rate")]
    return A[np.ix_(own, own)]


def pump_control(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """The inner loop alone: from the stroke command (1) to the stroke (1)."""
    A, B = state_matrices(loop, dry_friction)
    names = list(control_states(loop))
    own = slice(len(names))
    C = [[float(name == "stroke") for name in names]]
    return control.ss(A[own, own], B[own], C, 0.0, inputs="stroke_command", outputs="stroke", states=names)


def plant(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """The plant, eq. 43 with the angle and the bar's spring: from pump flow (m^3/s) to angle (rad), pressure (Pa)."""
    A, _ = state_matrices(loop, dry_friction)
    names, first = list(plant_states(loop)), len(control_states(loop))
    stroke = list(control_states(loop)).index("stroke")
    flow = A[first:, stroke, None] / ideal_flow(loop.circuit.pump, 1.0)
    return control.ss(A[first:, first:], flow, _outputs(loop, names), 0.0, inputs="flow", outputs=OUTPUTS, states=names)


def actuator(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """Pump control and plant: from the stroke command (1) to angle (rad) and pressure (Pa)."""
    A, B = state_matrices(loop, dry_friction)
    names = [*control_states(loop), *plant_states(loop)]
    return control.ss(A, B, _outputs(loop, names), 0.0, inputs="stroke_command", outputs=OUTPUTS, states=names)


def open_loop(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """From the angle's error (rad) to the angle (rad): K_p times the actuator."""
    return loop.gain * actuator(loop, dry_friction)["angle", "stroke_command"]


def closed_loop(loop: Loop, dry_friction: bool = False) -> control.StateSpace:
    """From the commanded angle (rad) to angle (rad) and pressure (Pa)."""
    system = actuator(loop, dry_friction)
    A, B, C = system.A, loop.gain * system.B, system.C
    return control.ss(A - B @ C[:1], B, C, 0.0, inputs="command", outputs=OUTPUTS, states=system.state_labels)


def _outputs(loop: Loop, names: list[str]) -> np.ndarray:
    """C (2, n) from the states `names` to the angle and the pressure across the motor."""
    end = int(loop.detail.pipe.lumps)
    pressure = {f"pressure_a{end}": 1.0, f"pressure_b{end}": -1.0} if loop.has_full_circuit else {"pressure": 1.0}
    return np.array([[float(name == "angle") for name in names], [pressure.get(name, 0.0) for name in names]])


def _rest(loop: Loop) -> np.ndarray:
    """All states at rest, with each line lifted whose check valve is to be shut."""
    state = loop.at_rest()
    if loop.has_full_circuit:
        nodes = int(loop.detail.pipe.lumps) + 1
        state.detail.plant[SIDE_A : SIDE_A + nodes] += LIFT
        if loop.checks == BOTH_SHUT:
            state.detail.plant[SIDE_B : SIDE_B + nodes] += LIFT
    return np.array([*control_state(state), *state.detail.plant])


def _slope(axle, rest, nudged: int | None, command: float) -> np.ndarray:
    """Half the difference of all rates between one nudge ahead and one behind."""
    nudge = np.zeros(len(rest))
    if nudged is not None:
        nudge[nudged] = NUDGES[nudged]
    ahead, behind, powers = np.zeros(len(rest)), np.zeros(len(rest)), np.zeros(POWERS)
    _rates(axle, rest + nudge, command, ahead, powers)
    _rates(axle, rest - nudge, -command, behind, powers)
    return 0.5 * (ahead - behind)


@entry
def _rates(axle, state, stroke_command, rates, powers):
    controlled, plant = (state[0], state[1], state[2], state[3], state[4], state[5]), state[PLANT:]
    pressure = plant[SIDE_A] - plant[SIDE_B]
    derivatives = control_rates(axle.circuit, axle.detail, controlled, stroke_command, pressure)
    for i in range(PLANT):
        rates[i] = derivatives[i]
    detailed_rates(axle, plant, rates[PLANT:], powers, state[4], 0.0, (plant[BYPASS], plant[FAIL_SAFE]))
