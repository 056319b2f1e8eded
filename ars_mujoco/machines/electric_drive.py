"""Electric drive: a machine and its inverter, whose current follows what it is asked for with a lag.

    torque ─> current within its limits ─> share that the supply grants ─> lag ─> torque

With open phases a machine turns freely; shorted it brakes, and no power leaves it.
"""

from collections import namedtuple

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.machines.electric_machine import (
    DRIVEN,
    SHORTED,
    ElectricMachine,
    copper_loss,
    current_within,
    field_current,
    shorted_torque,
    torque_constant,
    torque_currents,
)
from ars_mujoco.machines.inverter import Inverter, inverter_loss
from ars_mujoco.schema.parameters import Parameters, quantity


class ElectricDrive(Parameters):
    """A machine, its inverter and their current loop."""

    machine: ElectricMachine
    inverter: Inverter
    current_bandwidth: float = quantity("rad/s", gt=0)


# the torque current (A) that a drive would take, and the power (W) that it would draw then
Wish = namedtuple("Wish", "current power")

# `torque` (Nm) of a machine without its drag, and the powers (W): `drawn`, and what of it windings and inverter lose
Running = namedtuple("Running", "torque drawn copper inverter")


@kernel
def wish(drive: ElectricDrive, torque: float, speed: float, voltage: float, phases: float) -> Wish:
    """The Wish for a torque (Nm), within what current and voltage (V) allow at a speed (rad/s); none where the phases
    are not driven.
    """
    if phases != DRIVEN:
        return Wish(0.0, 0.0)
    constant = torque_constant(drive.machine)
    least, most = torque_currents(drive.machine, speed, voltage)
    current = min(max(torque / constant, least), most)
    heat = copper_loss(drive.machine, current, 0.0) + inverter_loss(drive.inverter, voltage, abs(current))
    return Wish(current, constant * current * speed + heat)


@kernel
def power_share(budget: float, front: float, rear: float) -> float:
    """The share of the powers (W) they wish for that two drives get, so that both stay within a budget (W); one that
    gives power back adds to it.
    """
    taken = max(front, 0.0) + max(rear, 0.0)
    given = max(-front, 0.0) + max(-rear, 0.0)
    return 1.0 if taken <= budget + given else (budget + given) / taken


@kernel
def granted(drive: ElectricDrive, wished: Wish, share: float, speed: float, voltage: float) -> float:
    """The torque current (A) of a drive that gets but a share of the power it wishes for."""
    if share == 1.0 or wished.power <= 0.0:
        return wished.current
    side = 1.0 if wished.current > 0.0 else -1.0
    standby = inverter_loss(drive.inverter, voltage, 0.0)
    by_current = inverter_loss(drive.inverter, voltage, 1.0) - standby  # W/A
    most = current_within(drive.machine, side * speed, by_current, share * wished.power - standby)
    return side * min(most, abs(wished.current))


@kernel
def running(drive: ElectricDrive, current: float, speed: float, voltage: float, phases: float) -> Running:
    """The Running of a drive at a torque current (A); `phases` is one of DRIVEN, OPEN, SHORTED."""
    machine = drive.machine
    if phases == DRIVEN:
        field = field_current(machine, current, speed, voltage)
        torque, copper = torque_constant(machine) * current, copper_loss(machine, current, field)
        loss = inverter_loss(drive.inverter, voltage, (current * current + field * field) ** 0.5)
        return Running(torque, torque * speed + copper + loss, copper, loss)
    if phases == SHORTED:
        torque = shorted_torque(machine, speed)
        return Running(torque, 0.0, -torque * speed, 0.0)
    return Running(0.0, 0.0, 0.0, 0.0)


@kernel
def current_rate(drive: ElectricDrive, current: float, wanted: float) -> float:
    """Rate (A/s) of the torque current towards the one wanted."""
    return drive.current_bandwidth * (wanted - current)
