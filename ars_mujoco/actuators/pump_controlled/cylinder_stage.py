"""Reduced circuits whose pump control has a control cylinder: its reduced or its full stage."""

import sys

from ars_mujoco.actuators.pump_controlled.axle import DetailedAxle, DetailedAxleState
from ars_mujoco.actuators.pump_controlled.channels import CylinderOutput as Output
from ars_mujoco.actuators.pump_controlled.file import File, fill_system, start_system
from ars_mujoco.actuators.pump_controlled.full_circuit import WORK, advance_apart, shaft_work
from ars_mujoco.actuators.pump_controlled.report import report_cylinder as report
from ars_mujoco.actuators.pump_controlled.strokes import advance_stage, is_beyond, parameters, sense, states
from ars_mujoco.actuators.pump_controlled.third_order_stage import (
    BEYOND,
    EVENTS,
    FOLLOWS,
    IN_UNIT,
    NAME,
    PLOTS,
    openings,
)
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import record_dtype

PARAMETERS, STATE = parameters(record_dtype(DetailedAxle)), states(record_dtype(DetailedAxleState))
CIRCUITS = sys.modules[__name__]
advance_circuits = advance_apart


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    return advance_stage(p, now, later, out, work, command, twists, moment, CIRCUITS)


fill, start = fill_system, start_system
