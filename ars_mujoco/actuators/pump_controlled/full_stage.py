"""Full circuits, each with its pump control at any stage."""

import sys

from ars_mujoco.actuators.pump_controlled.axle import DetailedAxle, DetailedAxleState
from ars_mujoco.actuators.pump_controlled.channels import FullOutput as Output
from ars_mujoco.actuators.pump_controlled.file import File, fill_system, start_system
from ars_mujoco.actuators.pump_controlled.full_circuit import WORK, advance_apart, shaft_work
from ars_mujoco.actuators.pump_controlled.report import report_full as report
from ars_mujoco.actuators.pump_controlled.strokes import advance_stage, is_beyond, parameters, sense, states
from ars_mujoco.actuators.pump_controlled.third_order_stage import BEYOND, EVENTS, FOLLOWS, IN_UNIT, NAME, PLOTS
from ars_mujoco.actuators.system import Input
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import record_dtype

PARAMETERS, STATE = parameters(record_dtype(DetailedAxle)), states(record_dtype(DetailedAxleState))
CIRCUITS = sys.modules[__name__]
advance_circuits = advance_apart
INPUTS = {
    "front_bypass": Input("1", 0.0, 0.0, 1.0),  # openings: 0 shut, 1 open
    "front_fail_safe": Input("1", 1.0, 0.0, 1.0),
    "rear_bypass": Input("1", 0.0, 0.0, 1.0),
    "rear_fail_safe": Input("1", 1.0, 0.0, 1.0),
}
FRONT_BYPASS, FRONT_FAIL_SAFE, REAR_BYPASS, REAR_FAIL_SAFE = range(4)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    return advance_stage(p, now, later, out, work, command, twists, moment, CIRCUITS)


@kernel
def openings(inputs):
    """Commanded openings (bypass, fail-safe) of front and rear."""
    return (inputs[FRONT_BYPASS], inputs[FRONT_FAIL_SAFE]), (inputs[REAR_BYPASS], inputs[REAR_FAIL_SAFE])


fill, start = fill_system, start_system
