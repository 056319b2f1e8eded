"""Electric machine: a permanent-magnet synchronous machine in steady state of its rotor-fixed currents.

    u_d = R i_d - w_e L i_q            torque = 1.5 p psi i_q            w_e = p w
    u_q = R i_q + w_e (L i_d + psi)    copper = 1.5 R (i_d^2 + i_q^2)

Both limits are circles in the plane of the currents: |i| <= I about zero, and |u| <= V about the currents at which the
machine would idle shorted. The torque current lies within both; the field current i_d is the least that the voltage
asks for, so that it is zero up to the corner speed and weakens the field beyond. Currents and voltages are amplitudes
of a phase. Magnetic energy is not counted: at most 0.6 J in a machine of a roll stabilizer.
"""

import math
from typing import Any

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

DRIVEN, OPEN, SHORTED = 1.0, 0.0, -1.0  # states of the phases


class ElectricMachine(Parameters):
    """Machine with surface magnets, its rotor's losses included."""

    pole_pairs: float = number(gt=0)  # p
    flux: float = quantity("V*s", gt=0)  # psi, of the magnets through a phase
    resistance: float = quantity("ohm", gt=0)  # R, of a phase
    inductance: float = quantity("H", gt=0)  # L, of a phase
    current_limit: float = quantity("A", gt=0)  # I, of inverter or windings
    field_current_limit: float = quantity("A", ge=0)  # of -i_d, beyond which the magnets would suffer
    modulation: float = number(gt=0, le=1)  # share of the supply's U/sqrt(3) that a phase gets
    iron: float = quantity("Nms/rad", ge=0)  # eddy currents and windage: loss over speed squared
    hysteresis: float = quantity("Nm", ge=0)  # of the iron: loss over speed
    friction: float = quantity("Nm", ge=0)  # of the bearings
    sign_speed: float = quantity("rad/s", gt=0)  # over which the sign of friction and hysteresis is rounded

    @property
    def peak_torque(self) -> float:
        """Torque (Nm) at the current limit, below the corner speed."""
        return 1.5 * self.pole_pairs * self.flux * self.current_limit


@kernel
def torque_constant(machine: ElectricMachine) -> float:
    """Torque over torque current (Nm/A): 1.5 p psi."""
    return 1.5 * machine.pole_pairs * machine.flux


@kernel
def torque_currents(machine: ElectricMachine, speed: float, supply: float) -> Any:
    """(least, most) torque current (A) at a speed (rad/s) and the supply's voltage (V), within both circles."""
    d, q, radius = _voltage_circle(machine, speed, supply)
    limit = machine.current_limit
    return _end(machine, d, q, radius, -limit), _end(machine, d, q, radius, limit)


@kernel
def field_current(machine: ElectricMachine, torque_current: float, speed: float, supply: float) -> float:
    """The field current (A) of least size, zero or less, at which the voltage suffices for a torque current (A)."""
    d, q, radius = _voltage_circle(machine, speed, supply)
    off = torque_current - q
    return max(min(d + math.sqrt(max(radius * radius - off * off, 0.0)), 0.0), -machine.field_current_limit)


@kernel
def copper_loss(machine: ElectricMachine, torque_current: float, field: float) -> float:
    """Heat of the windings (W)."""
    return 1.5 * machine.resistance * (torque_current * torque_current + field * field)


@kernel
def drag(machine: ElectricMachine, speed: float) -> float:
    """Torque (Nm) of iron, windage and bearings against a speed (rad/s)."""
    dry = machine.hysteresis + machine.friction
    return machine.iron * speed + dry * math.tanh(speed / machine.sign_speed)


@kernel
def shorted_torque(machine: ElectricMachine, speed: float) -> float:
    """Torque (Nm) of a machine with its phases joined: it brakes, and all of the work heats its windings."""
    p, R = machine.pole_pairs, machine.resistance
    electrical = p * speed
    reactance = electrical * machine.inductance
    return -1.5 * p * machine.flux * machine.flux * electrical * R / (R * R + reactance * reactance)


@kernel
def _voltage_circle(machine: ElectricMachine, speed: float, supply: float) -> Any:
    # centre (d, q) and radius (A) of the currents that the voltage allows
    electrical, R = machine.pole_pairs * speed, machine.resistance
    reactance = electrical * machine.inductance
    square = R * R + reactance * reactance
    pull = electrical * machine.flux / square
    return -pull * reactance, -pull * R, machine.modulation * supply / math.sqrt(3.0 * square)


@kernel
def current_within(machine: ElectricMachine, speed: float, other: float, power: float) -> float:
    """The torque current (A, its size) at which a machine draws a power (W), besides what it takes in proportion to the
    current elsewhere, `other` (W/A); `speed` (rad/s) is along its torque.
    """
    work, heat = torque_constant(machine) * speed + other, 1.5 * machine.resistance
    return max(math.sqrt(work * work + 4.0 * heat * max(power, 0.0)) - work, 0.0) / (2.0 * heat)


@kernel
def _end(machine: ElectricMachine, d: float, q: float, radius: float, limit: float) -> float:
    # the torque current of the sign of `limit` that is farthest out: on the current's circle, on the voltage's, or
    # where both meet; there the field current may reach its own limit first
    if d * d + (limit - q) * (limit - q) <= radius * radius:
        return limit
    side, least = math.copysign(1.0, limit), -machine.field_current_limit
    top = q + side * radius
    if d >= least and d * d + top * top <= limit * limit:
        return side * max(side * top, 0.0)
    square = d * d + q * q
    along = 0.5 * (limit * limit - radius * radius + square) / square
    across = math.sqrt(max(limit * limit / square - along * along, 0.0))
    within = abs(limit) > radius + math.sqrt(square)  # the voltage's circle: they do not meet
    meeting = math.inf if within else along * side * q + across * abs(d)
    room = radius * radius - (least - d) * (least - d)
    if room < 0.0 and d < least:  # so fast that no field current suffices: the machine can only be let go
        return 0.0
    return side * max(min(meeting, side * q + math.sqrt(max(room, 0.0))), 0.0)
