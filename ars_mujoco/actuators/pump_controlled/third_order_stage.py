"""The verification set: both reduced circuits with third-order pump control, in lockstep."""

import sys

from ars_mujoco.actuators.pump_controlled.axle import Axle, AxleState
from ars_mujoco.actuators.pump_controlled.channels import Output
from ars_mujoco.actuators.pump_controlled.file import File, PumpControlled, fill_axle, fill_system
from ars_mujoco.actuators.pump_controlled.plots import EVENTS, PLOTS
from ars_mujoco.actuators.pump_controlled.report import report_third_order as report
from ars_mujoco.actuators.pump_controlled.strokes import advance_stage, is_beyond, parameters, sense, states
from ars_mujoco.actuators.pump_controlled.third_order_circuit import advance_both
from ars_mujoco.actuators.system import Beyond, Car
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import record_dtype

NAME = "pump_controlled"
FOLLOWS = "angle"
IN_UNIT = True
PARAMETERS, STATE = parameters(record_dtype(Axle)), states(record_dtype(AxleState))
BEYOND = Beyond("over 1000 bar, or far past its stop", ("front.motor.pressure", "rear.motor.pressure"))
CIRCUITS = sys.modules[__name__]
NO_VALVES = (0.0, 1.0)  # openings: bypass shut, fail-safe open


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    return advance_stage(p, now, later, out, work, command, twists, moment, CIRCUITS)


@kernel
def advance_circuits(p, now, later, front_demand, rear_demand, valves, step, work):
    """Bar torques (front, rear) in Nm; a demand is (command, gain, stroke_bias, twist)."""
    count = int(max(p.front.substeps, p.rear.substeps))
    return advance_both(p, now, later, (front_demand, rear_demand), step, count)


@kernel
def openings(inputs):
    """Commanded openings (bypass, fail-safe) of front and rear: there are no valves."""
    return NO_VALVES, NO_VALVES


@kernel
def shaft_work(axle) -> float:
    """Work (J) of the shaft on an axle's pump."""
    return axle.energy.shaft


def fill(record, file: PumpControlled, car: Car, step: float) -> None:
    """Write the parameters; without a rear bar, as on the bench, a rear circuit that does nothing is kept in lockstep
    with the front's.
    """
    fill_system(record, file, car, step)
    if car.rear is None:
        fill_axle(record.rear, file, "rear", car.front.stiffness, step)
        circuit = record.rear.circuit
        circuit.pump.displacement = circuit.pump.torque_loss.norm = circuit.charge_power = record.rear.substeps = 0.0


def start(record, state) -> None:
    """All states are zero at rest."""
