"""Unit: one axle's motor, gear and loops, as the equations of five states.

    angle, speed loop ─> current ─> rotor ═ gear ═ halves of the bar
                                   (i^2 J)  (c_g)  (Theta)     c

Angles, speeds and torques are those at the bar, but for the machine's own. The loops are those of a servo: the angle's
error asks for a speed, the speed's error for a torque beside the one that the bar is known to need, the current follows
with a lag. A torque is followed as the angle at which the bar's torsion gives it, by the twist that is measured.
"""

from collections import namedtuple

from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.machines.electric_machine import (
    DRIVEN,
    SHORTED,
    ElectricMachine,
    copper_loss,
    current_within,
    drag,
    field_current,
    shorted_torque,
    torque_constant,
    torque_currents,
)
from ars_mujoco.machines.inverter import Inverter, inverter_loss
from ars_mujoco.machines.planetary_gear import PlanetaryGear, gear_friction, mesh_torque
from ars_mujoco.schema.channels import channel, drawn, lost
from ars_mujoco.schema.parameters import Parameters, choice, quantity

ANGLE, TORQUE = 0.0, 1.0  # what a unit follows


class Loops(Parameters):
    """The unit's own loops."""

    follow: float = choice("angle", "torque", default=TORQUE)  # of the command
    angle_gain: float = quantity("1/s", gt=0)  # speed over the angle's error
    speed_bandwidth: float = quantity("rad/s", gt=0)  # of the speed loop
    current_bandwidth: float = quantity("rad/s", gt=0)  # of the current loop
    max_rate: float = quantity("rad/s", gt=0)  # of the bar's angle
    max_torque: float = quantity("Nm", gt=0)  # of the bar
    max_angle: float = quantity("rad", gt=0)  # of the bar


class Unit(Parameters):
    """One axle's unit."""

    machine: ElectricMachine
    rotor_inertia: float = quantity("kg*m^2", gt=0)  # J, the gear's first stage included
    inverter: Inverter
    gear: PlanetaryGear
    bar_inertia: float = quantity("kg*m^2", gt=0)  # Theta, of the output and the halves of the bar
    bar_damping: float = quantity("Nms/rad", ge=0)  # of their bushes
    loops: Loops


class State(Parameters):
    current: float = channel("A", "torque current of the machine", scale=1e-2)
    rotor_angle: float = channel("rad", "angle of the machine through the gear", scale=1e-6)
    rotor_rate: float = channel("rad/s", "its rate", scale=1e-5)
    angle: float = channel("rad", "angle between the bar's halves", scale=1e-6)
    rate: float = channel("rad/s", "its rate", scale=1e-4)


class Energy(Parameters):
    electrical: float = drawn("from the supply, less what was given back")
    copper: float = lost("in the windings")
    inverter: float = lost("in the inverter")
    drag: float = lost("to iron, windage and bearings of the machine")
    gear: float = lost("to friction in the gear")
    bushes: float = lost("to friction in the bar's bushes")


# what a unit makes of a command at an instant: torque current A asked for, and the power W that it would draw
Wish = namedtuple("Wish", "current power")


@inlined
def electrical_power(p, state, voltage, phases):
    """(drawn, copper, inverter) in W of a unit at a voltage (V) of its supply."""
    current, _, rotor_rate, _, _ = state
    unit, speed = p.unit, p.unit.gear.ratio * rotor_rate
    machine = unit.machine
    if phases == DRIVEN:
        field = field_current(machine, current, speed, voltage)
        copper = copper_loss(machine, current, field)
        amplitude = (current * current + field * field) ** 0.5
        loss = inverter_loss(unit.inverter, voltage, amplitude)
        return torque_constant(machine) * current * speed + copper + loss, copper, loss
    if phases == SHORTED:
        return 0.0, -shorted_torque(machine, speed) * speed, 0.0
    return 0.0, 0.0, 0.0


@inlined
def wish(p, command, twist, state, voltage) -> Wish:
    """What the loops ask of the machine, within what current and voltage (V) allow."""
    _, _, rotor_rate, angle, _ = state
    unit = p.unit
    loops, machine, ratio = unit.loops, unit.machine, unit.gear.ratio
    measured = p.stiffness * (angle - twist)
    wanted = twist + saturate(command.torque, loops.max_torque) / p.stiffness
    if loops.follow == ANGLE:
        wanted = saturate(command.angle[0], loops.max_angle)
    rate = saturate(loops.angle_gain * (wanted - angle), loops.max_rate)
    speed = ratio * rotor_rate
    torque = unit.rotor_inertia * loops.speed_bandwidth * (ratio * rate - speed) + measured / ratio
    least, most = torque_currents(machine, speed, voltage)
    constant = torque_constant(machine)
    current = min(max(torque / constant, least), most)
    heat = copper_loss(machine, current, 0.0) + inverter_loss(unit.inverter, voltage, abs(current))
    return Wish(current, constant * current * speed + heat)


@inlined
def granted(p, asked, share, state, voltage) -> float:
    """The torque current (A) that a unit may have where it gets but a `share` of the power it asks for."""
    if share == 1.0 or asked.power <= 0.0:
        return asked.current
    side = 1.0 if asked.current > 0.0 else -1.0
    speed = side * p.unit.gear.ratio * state[2]
    standby = inverter_loss(p.unit.inverter, voltage, 0.0)
    by_current = inverter_loss(p.unit.inverter, voltage, 1.0) - standby
    power = share * asked.power - standby
    return side * min(current_within(p.unit.machine, speed, by_current, power), abs(asked.current))


@inlined
def unit_rates(p, current_wanted, twist, state, power, phases):
    """Derivatives of the five states, the powers (W) as Energy lists them, and the bar torque (Nm).

    `power` is what `electrical_power` gives.
    """
    current, rotor_angle, rotor_rate, angle, rate = state
    unit, ratio = p.unit, p.unit.gear.ratio
    machine, speed = unit.machine, ratio * rotor_rate
    electrical, copper, inverter = power
    if phases == DRIVEN:
        torque, current_rate = torque_constant(machine) * current, current_wanted - current
    else:
        torque, current_rate = 0.0, -current
        if phases == SHORTED:
            torque = shorted_torque(machine, speed)
    braking = drag(machine, speed)
    driving, load = ratio * (torque - braking), mesh_torque(unit.gear, rotor_angle - angle)
    friction = gear_friction(unit.gear, driving, load, rotor_rate)
    bar, bushes = p.stiffness * (angle - twist), unit.bar_damping * rate
    derivatives = (
        unit.loops.current_bandwidth * current_rate,
        rotor_rate,
        (driving - load - friction) / (ratio * ratio * unit.rotor_inertia),
        rate,
        (load - bar - bushes) / unit.bar_inertia,
    )
    powers = electrical, copper, inverter, braking * speed, friction * rotor_rate, bushes * rate
    return derivatives, powers, bar
