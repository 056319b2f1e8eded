"""One axle: its loops, its electric machine and its circuit, as one set of equations of thirteen states."""

from ars_mujoco.actuators.electro_hydrostatic.circuit import Circuit, circuit_rates
from ars_mujoco.actuators.electro_hydrostatic.control import (
    Control,
    integral_rate,
    missing_angle,
    speed_command,
    torque_command,
)
from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.machines.standin import DRIVEN, Machine, current_rate, limit, losses
from ars_mujoco.schema.channels import channel, counted, drawn, lost
from ars_mujoco.schema.parameters import Parameters, quantity


class Axle(Parameters):
    """Parameters of one axle."""

    stiffness: float = quantity("Nm/rad", ge=0)  # c, torsion of both halves of the bar in series
    circuit: Circuit
    machine: Machine
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
    current: float = channel("A", "current of the machine that makes torque, an amplitude", scale=1e-3)


class AxleEnergy(Parameters):
    """Energies of one axle since the start, in the order of the powers of `axle_rates`."""

    electrical: float = drawn("drawn from the supply, less what was given back")
    copper: float = lost("lost in the windings")
    iron: float = lost("lost in the machine's iron and to windage")
    inverter: float = lost("lost in the inverter")
    bearing: float = lost("lost to friction in the machine")
    pump_torque_loss: float = lost("lost to the pump's torque loss")
    pump_leakage: float = lost("lost to leakage in the pump")
    motor_leakage: float = lost("lost to leakage in the motor")
    relief: float = lost("lost over the relief valves")
    check: float = lost("lost over the check valves")
    valve: float = lost("lost over bypass and fail-safe valve")
    friction: float = lost("lost to friction in the motor")
    motor: float = counted("work of the motor on the bar")
    recovered: float = counted("given back to the supply, as a positive number")
    throughput: float = counted("integral of |electrical| + |motor| power")


STATES, POWERS = len(AxleState.model_fields), len(AxleEnergy.model_fields)


@inlined
def axle_rates(p, command, twist, openings, phases, bus, t, state):
    """Derivatives of AxleState, powers (W) as AxleEnergy lists them, and the bar's torque (Nm), at `t` s in the step.

    `command` is a BarCommand, `twist` (rad) that of the bar, `openings` those asked of the valves (bypass, fail-safe),
    `phases` one of DRIVEN, OPEN, SHORTED; `bus` is (voltage V, share of its torque that the supply lets the machine have).
    """
    sensed, integral, current = state[10:13]
    speed, angle, over_pump = state[7], state[8], state[0] - state[1]
    circuit, machine, control = p.circuit, p.machine, p.control
    voltage, share = bus

    c0, c1, c2 = command.angle
    missing = missing_angle(control, p.stiffness, c0 + t * (c1 + t * c2), command.torque, angle, twist)
    drives = openings[1] * (1.0 - openings[0])  # against a shut valve, or round through an open one, nothing is pumped
    asked_speed = drives * speed_command(control, circuit, missing, sensed, voltage / machine.nominal_voltage)
    behind = asked_speed - speed
    asked = torque_command(control, circuit, behind, integral, sensed)
    able = share * limit(machine, speed, voltage) if phases == DRIVEN else 0.0
    given = saturate(asked, able)

    torque = machine.torque_constant * current
    copper, iron, inverter, bearing = losses(machine, current, speed, phases)
    drag = iron / speed if speed != 0.0 else 0.0
    oil_and_motion, powers, bar_torque = circuit_rates(
        circuit, p.stiffness, twist, torque - bearing - drag, openings, state[0:10]
    )
    electrical, motor = torque * speed + copper + inverter, powers[7]
    derivatives = (
        *oil_and_motion,
        1.0 / control.pressure_lag * (over_pump - sensed),
        integral_rate(control, circuit, behind, asked - given),
        current_rate(machine, given, current, speed, phases),
    )
    lost = (electrical, copper, iron, inverter, bearing * speed)
    counted = (max(-electrical, 0.0), abs(electrical) + abs(motor))
    return derivatives, (*lost, *powers, *counted), bar_torque
