"""Electromechanical: a motor and a planetary gear between the halves of each bar, on a supply that both axles share.

Both axles and the supply are one set of equations: where the supply's power does not suffice, each gets the same share
of what it asks for.
"""

from collections import namedtuple
from typing import Literal

import numpy as np

from ars_mujoco.actuators.electromechanical.channels import EVENTS, PLOTS, Output, report
from ars_mujoco.actuators.electromechanical.sizing import SIZING
from ars_mujoco.actuators.electromechanical.unit import ANGLE, Energy, State, Unit, unit_rates, unit_wish
from ars_mujoco.actuators.pair import FAR
from ars_mujoco.actuators.system import Beyond, Car, Command, Input
from ars_mujoco.control.control_unit import NOTHING_ASKED
from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.kernels.records import numbers
from ars_mujoco.kernels.substeps import derivatives, fewest_substeps, scales, slopes
from ars_mujoco.machines.electric_drive import granted, power_share, running
from ars_mujoco.machines.electric_machine import DRIVEN, SHORTED, torque_constant
from ars_mujoco.machines.electric_supply import ElectricSupply, budget, terminal_voltage
from ars_mujoco.machines.shared_supply import joined_rates
from ars_mujoco.machines.supply_channels import SupplyEnergy, SupplyState, report_supply, rest_supply
from ars_mujoco.schema.parameters import Parameters, record_dtype
from ars_mujoco.schema.parameters import fill as fill_block

NAME = "electromechanical"
FOLLOWS = "torque"
INPUTS = {
    "front_phases": Input("1", DRIVEN, SHORTED, DRIVEN),  # 1 driven, 0 open, -1 shorted
    "rear_phases": Input("1", DRIVEN, SHORTED, DRIVEN),
}
FRONT, REAR = range(2)  # of the inputs
UNIT, SUPPLY = len(State.model_fields), 2 * len(State.model_fields)  # where the rear's states begin, and the supply's
BEYOND = Beyond("the halves of a bar turned by over a quarter", ("front.bar.angle", "rear.bar.angle"))


class File(Parameters):
    """What a user writes."""

    kind: Literal["electromechanical"]
    front: Unit
    rear: Unit
    supply: ElectricSupply


def held_at(file: File) -> dict[str, float]:
    """The angle (rad) of each bar that a command beyond it is held at, where it follows angles."""
    loops = {"front": file.front.loops, "rear": file.rear.loops}
    return {axle: each.max_angle for axle, each in loops.items() if each.follow == ANGLE}


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


# what both axles draw and ask for at an instant: the Running of each drive, the current (A) granted to it, the `load`
# (W) that both put on the supply, and the share that they get of the power they wish for
Balance = namedtuple("Balance", "front rear front_current rear_current load share")


@inlined
def balance(p, demand, state) -> Balance:
    """What both axles ask of the supply, and what it grants."""
    command, front_twist, rear_twist = demand
    front, rear, store = state[0:UNIT], state[UNIT:SUPPLY], state[SUPPLY]
    front_phases, rear_phases = command.inputs[FRONT], command.inputs[REAR]
    front_speed, rear_speed = p.front.unit.gear.ratio * front[2], p.rear.unit.gear.ratio * rear[2]
    front_electric = running(p.front.unit.drive, front[0], front_speed, store, front_phases)
    rear_electric = running(p.rear.unit.drive, rear[0], rear_speed, store, rear_phases)
    load = front_electric.drawn + p.has_rear * rear_electric.drawn
    voltage = terminal_voltage(p.supply, store, load)
    front_wish = unit_wish(p.front, command.front, front_twist, front, voltage, front_phases)
    rear_wish = unit_wish(p.rear, command.rear, rear_twist, rear, voltage, rear_phases)
    part = power_share(budget(p.supply, store), front_wish.power, p.has_rear * rear_wish.power)
    return Balance(
        front_electric,
        rear_electric,
        granted(p.front.unit.drive, front_wish, part, front_speed, voltage),
        granted(p.rear.unit.drive, rear_wish, part, rear_speed, voltage),
        load,
        part,
    )


@inlined
def rates(p, demand, t, state):
    """Derivatives, powers and bar torques (Nm) of both axles on their supply; `demand` is (Command, front twist, rear
    twist), the twists (rad) held. Without a rear bar, as on the bench, the rear stands still and draws nothing.
    """
    sides = balance(p, demand, state)
    front = unit_rates(p.front, sides.front_current, demand[1], state[0:UNIT], sides.front)
    rear = unit_rates(p.rear, sides.rear_current, demand[2], state[UNIT:SUPPLY], sides.rear)
    return joined_rates(p, front, rear, (state[SUPPLY], state[SUPPLY + 1]), sides.load)


_integrate = integrated(rates)
_derivatives = derivatives(rates)


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Both axles over the coming step, see `actuators.system`."""
    demand, states, energy = (command, twists.front.angle, twists.rear.angle), now.state, now.energy
    sides = balance(p, demand, numbers(states))
    report(p.front, states.front, energy.front, out.front, command.front, twists.front.angle, sides.front)
    report(p.rear, states.rear, energy.rear, out.rear, command.rear, twists.rear.angle, sides.rear)
    report_supply(p.supply, states.supply, energy.supply, out.supply, sides.load, sides.share)
    held = (command, twists.front.held, twists.rear.held)
    return _integrate(p, now, later, held, moment.step, int(p.substeps))


@kernel
def sense(p, now, sensors) -> None:
    """Angle of each bar, and the torque that its machine gives through the gear (Nm)."""
    front, rear = now.state.front, now.state.rear
    sensors.front_angle, sensors.rear_angle = front.angle, rear.angle
    sensors.front_torque = p.front.unit.gear.ratio * torque_constant(p.front.unit.drive.machine) * front.current
    sensors.rear_torque = p.rear.unit.gear.ratio * torque_constant(p.rear.unit.drive.machine) * rear.current


@kernel
def is_beyond(p, state) -> bool:
    """Whether a bar's halves turned further than a bar bears."""
    return abs(state.state.front.angle) > FAR or abs(state.state.rear.angle) > FAR


def fill(record, file: File, car: Car, step: float) -> None:
    """Write the parameters; the substeps are those of the stiffest equations: at rest, moving, loaded."""
    fill_block(record.supply, file.supply)
    record.has_rear = car.rear is not None
    for name, torsion in (("front", car.front), ("rear", car.rear or car.front)):
        fill_block(record[name].unit, getattr(file, name))
        record[name].stiffness = torsion.stiffness
    nudges, looks = scales(Equations), []
    demand = (Command(NOTHING_ASKED, NOTHING_ASKED, np.full(len(INPUTS), DRIVEN)), 0.0, 0.0)
    for rate, load in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)):  # rad/s of the bars; share of the greatest torque
        state = np.zeros(1, record_dtype(Equations)).view(np.recarray)[0]
        _rest(record, state)
        state.front.rotor_rate = state.front.rate = state.rear.rotor_rate = state.rear.rate = rate
        for name in ("front", "rear"):
            _press(record[name].unit, state[name], load)
        looks.append(slopes(_derivatives, record, demand, state, nudges))
    record.substeps = fewest_substeps(looks, step)


def _press(unit, state, load: float) -> None:
    """Let the machine press the teeth together with a share of the greatest torque: within the backlash the gear's
    stiffness does not show, and without load its friction is at its smallest.
    """
    torque, gear = load * unit.loops.max_torque, unit.gear
    state.current = torque / (gear.ratio * torque_constant(unit.drive.machine))
    state.rotor_angle = state.angle + load * (0.5 * gear.backlash + unit.loops.max_torque / gear.stiffness)


def start(record, state) -> None:
    """Write the state at rest: nothing turns, and the converter feeds what is always on."""
    _rest(record, state.state)


def _rest(record, state) -> None:
    front, rear = record.front.unit.drive.inverter, record.rear.unit.drive.inverter
    rest_supply(record.supply, state.supply, front.standby_power + record.has_rear * rear.standby_power)
