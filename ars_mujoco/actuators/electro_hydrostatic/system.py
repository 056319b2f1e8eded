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
    report_supply,
)
from ars_mujoco.actuators.electro_hydrostatic.equations import (
    PARAMETERS,
    POWERS,
    SUPPLY_POWERS,
    Demand,
    electric,
    rates,
)
from ars_mujoco.actuators.electro_hydrostatic.file import AXLES, fill_axle
from ars_mujoco.actuators.electro_hydrostatic.file import ElectroHydrostatic as File
from ars_mujoco.actuators.system import Beyond, Car, Input
from ars_mujoco.control.control_unit import BarCommand
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.machines.electric_machine import DRIVEN, SHORTED
from ars_mujoco.schema.parameters import fill as fill_block
from ars_mujoco.schema.parameters import record_dtype

NAME = "electro_hydrostatic"
FOLLOWS = "torque"
INPUTS = {
    f"{axle}_{name}": each
    for axle in ("front", "rear")
    for name, each in {
        "bypass": Input("1", 0.0, 0.0, 1.0),  # openings: 0 shut, 1 open
        "fail_safe": Input("1", 1.0, 0.0, 1.0),
        "phases": Input("1", DRIVEN, SHORTED, DRIVEN),  # 1 driven, 0 open, -1 shorted
    }.items()
}
BEYOND = Beyond("over 1000 bar, or far past its stop", ("front.motor.pressure", "rear.motor.pressure"))
FAR_PRESSURE = 1000e5  # Pa
FAR_ANGLE = 2.0  # of the motor's stop
FINER = 2  # times the substeps, so that the small loss over a fail-safe valve, whose mode is fast, is right as well
PRESSURES = ("pump_a", "pump_b", "motor_a", "motor_b", "accumulator")
IDLE = Demand(BarCommand((0.0, 0.0, 0.0), 0.0), 0.0, (0.0, 1.0), DRIVEN)

STATE = np.dtype([("state", record_dtype(State)), ("energy", record_dtype(Energy))])

step_through, evaluate = integrated(rates), derivatives(rates)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    inputs, front, rear = command.inputs, twists.front, twists.rear
    front_demand = Demand(command.front, front.angle, (inputs[0], inputs[1]), inputs[2])
    rear_demand = Demand(command.rear, rear.angle, (inputs[3], inputs[4]), inputs[5])
    _report(p, now, out, (front_demand, rear_demand))
    held = (
        Demand(command.front, front.held, front_demand.openings, front_demand.phases),
        Demand(command.rear, rear.held, rear_demand.openings, rear_demand.phases),
    )
    return step_through(p, now, later, held, moment.step, int(p.substeps))


@kernel
def _report(p, now, out, demand):
    # what a run records of the state now
    front, rear = demand
    state, energy, store = now.state, now.energy, now.state.supply.store
    _, powers, _ = rates(p, demand, 0.0, numbers(state))
    front_electric, rear_electric = (
        electric(p.front, front, store, numbers(state.front)),
        electric(p.rear, rear, store, numbers(state.rear)),
    )
    report(p.front, state.front, energy.front, out.front, front.command, front.twist, front_electric, powers[0:POWERS])
    report(
        p.rear, state.rear, energy.rear, out.rear, rear.command, rear.twist, rear_electric, powers[POWERS:SUPPLY_POWERS]
    )
    load = powers[0] + powers[POWERS]
    report_supply(p.supply, state.supply, energy.supply, out.supply, load)


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
    """Write the parameters; without a rear bar, as on the bench, the rear axle stands still and draws nothing."""
    fill_axle(record.front, file.front, file.control, car.front)
    fill_axle(record.rear, file.rear, file.control, car.rear or car.front)
    fill_block(record.supply, file.supply)
    record.has_rear = car.rear is not None
    has_fail_safe = any(getattr(file, axle).fail_safe_valve for axle in AXLES)
    record.substeps = (FINER if has_fail_safe else 1) * fewest_substeps(_slopes(record), step)


def start(record, state) -> None:
    """Write the state at rest: every pressure is the accumulator's, the store is full."""
    for name in AXLES:
        axle = state.state[name]
        for pressure in PRESSURES:
            axle[pressure] = record[name].circuit.accumulator.pressure
        axle.fail_safe = 1.0
    state.state.supply.store = record.supply.voltage


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
    return [slopes(evaluate, record, demand, look.state, scales(State)) for look in looks]
