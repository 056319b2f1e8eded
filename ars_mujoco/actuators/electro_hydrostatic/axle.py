"""One axle: its loops, its electric drive and its circuit, as one set of equations of thirteen states."""

from ars_mujoco.actuators.electro_hydrostatic.circuit import Circuit, circuit_rates
from ars_mujoco.actuators.electro_hydrostatic.control import (
    Control,
    integral_rate,
    missing_angle,
    speed_command,
    torque_command,
)
from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.machines.electric_drive import ElectricDrive, current_rate
from ars_mujoco.machines.electric_machine import drag, torque_constant
from ars_mujoco.schema.channels import channel, counted, drawn, lost
from ars_mujoco.schema.parameters import Parameters, quantity


class Axle(Parameters):
    """Parameters of one axle."""

    stiffness: float = quantity("Nm/rad", ge=0)  # c, torsion of both halves of the bar in series
    circuit: Circuit
    drive: ElectricDrive
    control: Control


class AxleState(Parameters):
    """State of one axle; pressures are absolute."""

    pump_a: float = channel("Pa", "pressure in line A, which drives to positive angle", scale=1e2)
    pump_b: float = channel("Pa", "pressure in line B", scale=1e2)
    motor_a: float = channel("Pa", "pressure in chamber A", scale=1e2)
    motor_b: float = channel("Pa", "pressure in chamber B", scale=1e2)
    accumulator: float = channel("Pa", "pressure in the accumulator", scale=1e2)
    bypass: float = channel("1", "opening of the bypass valve", scale=1e-4)
    fail_safe: float = channel("1", "opening of the fail-safe valve", scale=1e-4)
    speed: float = channel("rad/s", "speed of machine and pump", scale=1e-4)
    angle: float = channel("rad", "angle of the motor between the bar's halves", scale=1e-6)
    rate: float = channel("rad/s", "its rate", scale=1e-6)
    sensed: float = channel("Pa", "pressure difference as its sensor shows it", scale=1e2)
    integral: float = channel("Nm", "integral of the speed loop", scale=1e-4)
    current: float = channel("A", "torque current of the machine, an amplitude", scale=1e-3)


class AxleEnergy(Parameters):
    """Energies of one axle since the start, in the order of the powers of `axle_rates`."""

    electrical: float = drawn("drawn from the supply, less what was given back")
    copper: float = lost("lost in the windings")
    inverter: float = lost("lost in the inverter")
    drag: float = lost("lost in the machine's iron, to windage and in its bearings")
    pump_torque_loss: float = lost("lost to the pump's torque loss")
    pump_leakage: float = lost("lost to leakage in the pump")
    motor_leakage: float = lost("lost to leakage in the motor")
    relief: float = lost("lost over the relief valves")
    check: float = lost("lost over the check valves")
    valve: float = lost("lost over bypass and fail-safe valve")
    friction: float = lost("lost to friction in the motor")
    motor: float = counted("work of the motor on the bar")


STATES, POWERS = len(AxleState.model_fields), len(AxleEnergy.model_fields)
PLACES = list(AxleState.model_fields)
SPEED, ANGLE, SENSED, INTEGRAL, CURRENT = map(PLACES.index, ("speed", "angle", "sensed", "integral", "current"))
# before SENSED stand the states of the circuit


@inlined
def asked_of(p, demand, voltage, t, state):
    """(torque Nm, lag rad/s): what the loops ask of the drive at `t` s in the step, and by how much the pump's speed is
    behind what they ask of it.

    Against a shut fail-safe valve, or round through an open bypass valve, nothing is pumped. `demand` is a Demand,
    `voltage` (V) the supply's.
    """
    circuit, control, sensed = p.circuit, p.control, state[SENSED]
    command, (bypass, fail_safe) = demand.command, demand.openings
    c0, c1, c2 = command.angle
    missing = missing_angle(control, p.stiffness, c0 + t * (c1 + t * c2), command.torque, state[ANGLE], demand.twist)
    pumps = fail_safe * (1.0 - bypass)
    behind = pumps * speed_command(control, circuit, missing, sensed, voltage) - state[SPEED]
    return torque_command(control, circuit, behind, state[INTEGRAL], sensed), behind


@inlined
def axle_rates(p, side, demand, state):
    """Derivatives of AxleState, powers (W) as AxleEnergy lists them, and the bar's torque (Nm).

    `side` has what `asked_of` gives as `asked`, the `current` (A) granted for it, and the Running of the drive as
    `electric`; `demand` is a Demand.
    """
    (torque, behind), electric, drive, speed = side.asked, side.electric, p.drive, state[SPEED]
    braking = drag(drive.machine, speed)
    plant, powers, bar_torque = circuit_rates(
        p.circuit, p.stiffness, demand.twist, electric.torque - braking, demand.openings, state[0:SENSED]
    )
    excess = torque - torque_constant(drive.machine) * side.current
    derivatives = (
        *plant,
        1.0 / p.control.pressure_lag * (state[0] - state[1] - state[SENSED]),
        integral_rate(p.control, p.circuit, behind, excess),
        current_rate(drive, state[CURRENT], side.current),
    )
    return derivatives, (electric.drawn, electric.copper, electric.inverter, braking * speed, *powers), bar_torque
