"""Electromechanical: a motor and a planetary gear between the halves of each bar, on a supply that both axles share.

Both axles and the supply are one set of equations: where the supply's power does not suffice, each gets the same share
of what it asks for.
"""

from typing import Literal

import numpy as np

from ars_mujoco.actuators.electromechanical.channels import EVENTS, PLOTS, Output, SupplyEnergy
from ars_mujoco.actuators.electromechanical.unit import (
    Energy,
    State,
    Unit,
    electrical_power,
    granted,
    unit_rates,
    wish,
)
from ars_mujoco.actuators.system import Beyond, Car, Command, Input, Twist, Twists
from ars_mujoco.control.control_unit import BarCommand
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.kernels.records import numbers, share
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.machines.electric_machine import DRIVEN, SHORTED, torque_constant
from ars_mujoco.machines.electric_supply import ElectricSupply, budget, store_energy, supply_rates, terminal_voltage
from ars_mujoco.machines.planetary_gear import gear_friction, mesh_energy, mesh_torque
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype
from ars_mujoco.schema.parameters import fill as fill_block

NAME = "electromechanical"
FOLLOWS = "torque"
INPUTS = {
    "front_phases": Input("1", DRIVEN, SHORTED, DRIVEN),  # 1 driven, 0 open, -1 shorted
    "rear_phases": Input("1", DRIVEN, SHORTED, DRIVEN),
}
FRONT, REAR = range(2)  # of the inputs
FAR = 1.6  # rad between the halves of a bar; nothing turns it by more than a quarter
BEYOND = Beyond("the halves of a bar turned by over a quarter", ("front.bar.angle", "rear.bar.angle"))


class File(Parameters):
    """What a user writes."""

    kind: Literal["electromechanical"]
    front: Unit
    rear: Unit
    supply: ElectricSupply


class SupplyState(Parameters):
    store: float = channel("V", "voltage of the store", scale=1e-3)
    converter: float = channel("W", "power of the converter", scale=1e-2)


class Equations(Parameters):
    """All states, in the order of `rates`."""

    front: State
    rear: State
    supply: SupplyState


class Energies(Parameters):
    """All energies, in the order of the powers of `rates`."""

    front: Energy
    rear: Energy
    supply: SupplyEnergy


AXLE = np.dtype([("unit", record_dtype(Unit)), ("stiffness", "f8")])
PARAMETERS = np.dtype(
    [("front", AXLE), ("rear", AXLE), ("supply", record_dtype(ElectricSupply)), ("has_rear", "f8"), ("substeps", "f8")]
)
STATE = np.dtype([("state", record_dtype(Equations)), ("energy", record_dtype(Energies))])


@inlined
def _balance(p, command, front_twist, rear_twist, front, rear, store):
    # voltage at the loads, the powers of both units, what each asks for, and the share that it gets
    inputs = command.inputs
    front_power = electrical_power(p.front, front, store, inputs[FRONT])
    rear_power = electrical_power(p.rear, rear, store, inputs[REAR])
    if p.has_rear == 0.0:
        rear_power = (0.0, 0.0, 0.0)
    load = front_power[0] + rear_power[0]
    voltage = terminal_voltage(p.supply, store, load)
    front_wish = wish(p.front, command.front, front_twist, front, voltage)
    rear_wish = wish(p.rear, command.rear, rear_twist, rear, voltage)
    wanted = max(front_wish.power, 0.0) * (inputs[FRONT] == DRIVEN)
    wanted += max(rear_wish.power, 0.0) * (inputs[REAR] == DRIVEN) * p.has_rear
    there = budget(p.supply, store)
    part = 1.0 if wanted <= there else there / wanted
    return voltage, load, front_power, rear_power, front_wish, rear_wish, part


@inlined
def rates(p, demand, t, state):
    """Derivatives, powers and bar torques (Nm) of both axles on their supply; `demand` is (Command, front twist, rear
    twist), the twists (rad) held.
    """
    command, front_twist, rear_twist = demand
    front, rear, (store, converter) = state[:5], state[5:10], state[10:]
    voltage, load, front_power, rear_power, front_wish, rear_wish, part = _balance(
        p, command, front_twist, rear_twist, front, rear, store
    )
    front_current = granted(p.front, front_wish, part, front, voltage)
    rear_current = granted(p.rear, rear_wish, part, rear, voltage)
    a, front_powers, front_torque = unit_rates(
        p.front, front_current, front_twist, front, front_power, command.inputs[FRONT]
    )
    b, rear_powers, rear_torque = unit_rates(p.rear, rear_current, rear_twist, rear, rear_power, command.inputs[REAR])
    store_rate, converter_rate, supply_powers = supply_rates(p.supply, store, converter, load)
    return a + b + (store_rate, converter_rate), front_powers + rear_powers + supply_powers, (front_torque, rear_torque)


_integrate = integrated(rates)
_derivatives = derivatives(rates)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    _report(p, now, out, command, twists)
    front, rear = _integrate(
        p, now, later, (command, twists.front.held, twists.rear.held), moment.step, int(p.substeps)
    )
    return front, rear * p.has_rear


@kernel
def _report(p, now, out, command, twists):
    states = now.state
    front, rear = numbers(states.front), numbers(states.rear)
    voltage, load, front_power, rear_power, _, _, part = _balance(
        p, command, twists.front.angle, twists.rear.angle, front, rear, states.supply.store
    )
    out.supply.voltage, out.supply.power, out.supply.load = voltage, states.supply.converter, load
    out.supply.share = part
    share(out.supply.energy, now.energy.supply)
    out.supply.energy.store = store_energy(p.supply, states.supply.store)
    _report_unit(p.front, states.front, now.energy.front, out.front, command.front, twists.front.angle, front_power)
    _report_unit(p.rear, states.rear, now.energy.rear, out.rear, command.rear, twists.rear.angle, rear_power)


@kernel
def _report_unit(axle, state, energy, out, command, twist, power):
    unit = axle.unit
    gear, machine, ratio, turned = unit.gear, unit.machine, unit.gear.ratio, state.angle - twist
    between = state.rotor_angle - state.angle
    out.bar.angle, out.bar.command = state.angle, command.angle[0]
    out.machine.speed, out.machine.current = ratio * state.rotor_rate, state.current
    out.machine.torque = torque_constant(machine) * state.current
    out.machine.power, out.machine.loss_power = power[0], power[1] + power[2]
    out.gear.torque = mesh_torque(gear, between)
    friction = gear_friction(gear, ratio * out.machine.torque, out.gear.torque, state.rotor_rate)
    out.gear.loss_power = friction * state.rotor_rate
    share(out.energy, energy)
    out.energy.bar, out.energy.mesh = 0.5 * axle.stiffness * turned * turned, mesh_energy(gear, between)
    out.energy.inertia = 0.5 * unit.rotor_inertia * out.machine.speed**2
    out.energy.bar_inertia = 0.5 * unit.bar_inertia * state.rate**2


@kernel
def sense(p, now, sensors) -> None:
    """Angle of each bar, and the torque that its machine gives through the gear (Nm)."""
    front, rear = now.state.front, now.state.rear
    sensors.front_angle, sensors.rear_angle = front.angle, rear.angle
    sensors.front_torque = p.front.unit.gear.ratio * torque_constant(p.front.unit.machine) * front.current
    sensors.rear_torque = p.rear.unit.gear.ratio * torque_constant(p.rear.unit.machine) * rear.current


@kernel
def is_beyond(p, state) -> bool:
    """Whether a bar's halves turned further than a bar bears."""
    return abs(state.state.front.angle) > FAR or abs(state.state.rear.angle) > FAR


def fill(record, file: File, car: Car, step: float) -> None:
    """Write the parameters; the substeps are those of the stiffest equations, at rest and moving."""
    fill_block(record.supply, file.supply)
    record.has_rear = car.rear is not None
    for name, torsion in (("front", car.front), ("rear", car.rear or car.front)):
        fill_block(record[name].unit, getattr(file, name))
        record[name].stiffness = torsion.stiffness
    nudges, looks = scales(Equations), []
    idle = BarCommand((0.0, 0.0, 0.0), 0.0)
    demand = (Command(idle, idle, np.full(len(INPUTS), DRIVEN)), 0.0, 0.0)
    for rate in (0.0, 1.0):  # rad/s of the bars
        state = np.zeros(1, record_dtype(Equations)).view(np.recarray)[0]
        _rest(record, state)
        state.front.rotor_rate = state.front.rate = state.rear.rotor_rate = state.rear.rate = rate
        looks.append(slopes(_derivatives, record, demand, state, nudges))
    record.substeps = fewest_substeps(looks, step)


def start(record, state) -> None:
    """Write the state at rest: nothing turns, and the converter feeds what is always on."""
    _rest(record, state.state)


def _rest(record, state) -> None:
    supply, units = record.supply, (record.front.unit, record.rear.unit)
    standby = units[0].inverter.standby_power + record.has_rear * units[1].inverter.standby_power
    state.supply.store = supply.voltage
    voltage = terminal_voltage(supply, supply.voltage, standby)
    state.supply.converter = supply.controller_power + standby + supply.line_resistance * (standby / voltage) ** 2
