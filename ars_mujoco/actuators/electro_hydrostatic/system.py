"""Electro-hydrostatic: a pump of fixed displacement on an electric machine of its own and a vane motor between the
halves of each bar, both machines on one 48 V supply of limited power (an EHA).

    command ─> loops ─> machine ─ pump ═ lines ═ vane motor ─ bar        one axle, see `axle`
                           |
                  supply: both machines draw from one store

Nothing runs while nothing is asked for; what is held costs the leakage that the pump makes up for, and the current that
bears the load.
"""

import numpy as np

from ars_mujoco.actuators.electro_hydrostatic.channels import (
    EVENTS,
    PLOTS,
    Energy,
    Output,
    State,
    report,
)
from ars_mujoco.actuators.electro_hydrostatic.equations import (
    PARAMETERS,
    POWERS,
    SUPPLY_POWERS,
    Demand,
    balance,
    balanced_rates,
    rates,
)
from ars_mujoco.actuators.electro_hydrostatic.file import AXLES, check_valves, fill_axle, released
from ars_mujoco.actuators.electro_hydrostatic.file import ElectroHydrostatic as File
from ars_mujoco.actuators.electro_hydrostatic.sizing import SIZING
from ars_mujoco.actuators.system import Beyond, Car, Input
from ars_mujoco.control.control_unit import NOTHING_ASKED
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.machines.electric_machine import DRIVEN, SHORTED
from ars_mujoco.machines.supply_channels import report_supply, rest_supply
from ars_mujoco.schema.parameters import fill as fill_block
from ars_mujoco.schema.parameters import record_dtype

NAME = "electro_hydrostatic"
FOLLOWS = "torque"
INPUTS = {
    "front_bypass": Input("1", 0.0, 0.0, 1.0),  # openings: 0 shut, 1 open
    "front_fail_safe": Input("1", 1.0, 0.0, 1.0),
    "front_phases": Input("1", DRIVEN, SHORTED, DRIVEN),  # 1 driven, 0 open, -1 shorted
    "rear_bypass": Input("1", 0.0, 0.0, 1.0),
    "rear_fail_safe": Input("1", 1.0, 0.0, 1.0),
    "rear_phases": Input("1", DRIVEN, SHORTED, DRIVEN),
}
FRONT_BYPASS, FRONT_FAIL_SAFE, FRONT_PHASES, REAR_BYPASS, REAR_FAIL_SAFE, REAR_PHASES = range(6)
BEYOND = Beyond("over 1000 bar, or far past its stop", ("front.motor.pressure", "rear.motor.pressure"))
FAR_PRESSURE = 1000e5  # Pa
FAR_ANGLE = 2.0  # of the motor's stop
FINER = 2  # times the substeps, so that the small loss over a fail-safe valve, whose mode is fast, is right as well
PRESSURES = ("pump_a", "pump_b", "motor_a", "motor_b", "accumulator")
IDLE = Demand(NOTHING_ASKED, 0.0, (0.0, 1.0), DRIVEN)

STATE = np.dtype([("state", record_dtype(State)), ("energy", record_dtype(Energy))])

step_through = integrated(rates)
_derivatives = derivatives(rates)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    _report(p, now, out, _demand(command, twists.front.angle, twists.rear.angle))
    held = _demand(command, twists.front.held, twists.rear.held)
    return step_through(p, now, later, held, moment.step, int(p.substeps))


@kernel
def _demand(command, front_twist, rear_twist):
    # the Demands of both axles, their bars twisted by so much (rad)
    inputs = command.inputs
    front_openings = (inputs[FRONT_BYPASS], inputs[FRONT_FAIL_SAFE])
    rear_openings = (inputs[REAR_BYPASS], inputs[REAR_FAIL_SAFE])
    return (
        Demand(command.front, front_twist, front_openings, inputs[FRONT_PHASES]),
        Demand(command.rear, rear_twist, rear_openings, inputs[REAR_PHASES]),
    )


@kernel
def _report(p, now, out, demand):
    # what a run records of the state now
    state, energy, numbered = now.state, now.energy, numbers(now.state)
    sides = balance(p, demand, 0.0, numbered)
    _, powers, _ = balanced_rates(p, sides, demand, numbered)
    report(p.front, state.front, energy.front, out.front, demand[0], sides.front.electric, powers[0:POWERS])
    report(p.rear, state.rear, energy.rear, out.rear, demand[1], sides.rear.electric, powers[POWERS:SUPPLY_POWERS])
    report_supply(p.supply, state.supply, energy.supply, out.supply, sides.load, sides.share)


@kernel
def sense(p, now, sensors) -> None:
    """The motors' angles, and the bars' torques as the pressures at the pumps tell them."""
    front, rear = now.state.front, now.state.rear
    sensors.front_angle, sensors.rear_angle = front.angle, rear.angle
    sensors.front_torque = p.front.circuit.motor.displacement * front.sensed
    sensors.rear_torque = p.rear.circuit.motor.displacement * rear.sensed


@kernel
def is_beyond(p, state) -> bool:
    """Whether a pressure or an angle has left all that is physical."""
    return _is_beyond(p.front, state.state.front) or _is_beyond(p.rear, state.state.rear)


@kernel
def _is_beyond(p, state):
    pressure = max(abs(state.motor_a), abs(state.motor_b), abs(state.pump_a), abs(state.pump_b))
    return pressure > FAR_PRESSURE or abs(state.angle) > FAR_ANGLE * p.circuit.motor.stop_angle


def fill(record, file: File, car: Car, step: float) -> None:
    """Write the parameters; without a rear bar, as on the bench, the rear axle stands still and draws nothing.

    Raises InputError where a cycle commands a valve that the file has not.
    """
    check_valves(file, car.inputs)
    fill_axle(record.front, file.front, file.control, car.front)
    fill_axle(record.rear, file.rear, file.control, car.rear or car.front)
    fill_block(record.supply, file.supply)
    record.has_rear = car.rear is not None
    has_fail_safe = any(getattr(file, axle).fail_safe_valve for axle in AXLES)
    record.substeps = (FINER if has_fail_safe else 1) * fewest_substeps(_slopes(record), step)


def start(record, state) -> None:
    """Write the state at rest: every pressure is the accumulator's, the converter feeds what is on."""
    for name in AXLES:
        axle = state.state[name]
        for pressure in PRESSURES:
            axle[pressure] = record[name].circuit.accumulator.pressure
        axle.fail_safe = 1.0
    front, rear = record.front.drive.inverter, record.rear.drive.inverter
    rest_supply(record.supply, state.state.supply, front.standby_power + record.has_rear * rear.standby_power)


def _slopes(record) -> list[np.ndarray]:
    """Slopes of the equations (1/s) where they are stiffest, for the substeps.

    At rest, where friction is rounded and the valves flow laminar; in motion; over a relief valve's pressure; with open
    check valves; past the motor's stop; with an open bypass valve.
    """
    demand = (IDLE, IDLE)
    looks = np.zeros(6, STATE).view(np.recarray)
    for look in looks:
        start(record, look)
    for name in AXLES:
        circuit = record[name].circuit
        resting, moving, relieved, drawn, stopped, bypassed = (look.state[name] for look in looks)
        moving.speed, moving.rate = record[name].control.speed_limit, 1.0
        relieved.pump_a += 1.1 * circuit.relief_valve.pressure
        drawn.motor_a = drawn.motor_b = 0.0
        stopped.angle = 1.01 * circuit.motor.stop_angle
        bypassed.bypass = 1.0
    return [slopes(_derivatives, record, demand, look.state, scales(State)) for look in looks]
