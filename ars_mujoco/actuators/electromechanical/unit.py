"""Unit: one axle's motor, gear and loops, as the equations of five states.

    angle, speed loop ─> current ─> rotor ═ gear ═ halves of the bar
                                   (i^2 J)  (c_g)  (Theta)     c

Angles, speeds and torques are those at the bar, but for the machine's own. The loops are those of a servo: the angle's
error asks for a speed, the speed's error for a torque beside the one that the bar is known to need, the current follows
with a lag. A torque is followed as the angle at which the bar's torsion gives it, by the twist that is measured.
"""

from ars_mujoco.kernels.kernel import inlined
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.machines.electric_drive import ElectricDrive, current_rate, wish
from ars_mujoco.machines.electric_machine import drag
from ars_mujoco.machines.planetary_gear import PlanetaryGear, gear_friction, mesh_torque
from ars_mujoco.schema.channels import channel, drawn, lost
from ars_mujoco.schema.parameters import Parameters, choice, quantity

ANGLE, TORQUE = 0.0, 1.0  # what a unit follows


class Loops(Parameters):
    """The unit's own loops."""

    follow: float = choice("angle", "torque", default=TORQUE)  # of the command
    angle_gain: float = quantity("1/s", gt=0)  # speed over the angle's error
    speed_bandwidth: float = quantity("rad/s", gt=0)  # of the speed loop
    max_rate: float = quantity("rad/s", gt=0)  # of the bar's angle
    max_torque: float = quantity("Nm", gt=0)  # of the bar
    max_angle: float = quantity("rad", gt=0)  # of the bar


class Unit(Parameters):
    """One axle's unit."""

    drive: ElectricDrive
    rotor_inertia: float = quantity("kg*m^2", gt=0)  # J, the gear's first stage included
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


@inlined
def unit_wish(p, command, twist, state, voltage, phases):
    """The Wish of a unit's loops for a BarCommand, at a twist (rad) of its bar and a voltage (V) of its supply."""
    _, _, rotor_rate, angle, _ = state
    unit = p.unit
    loops, ratio = unit.loops, unit.gear.ratio
    measured = p.stiffness * (angle - twist)
    wanted = twist + saturate(command.torque, loops.max_torque) / p.stiffness
    if loops.follow == ANGLE:
        wanted = saturate(command.angle[0], loops.max_angle)
    rate, speed = saturate(loops.angle_gain * (wanted - angle), loops.max_rate), ratio * rotor_rate
    torque = unit.rotor_inertia * loops.speed_bandwidth * (ratio * rate - speed) + measured / ratio
    return wish(unit.drive, torque, speed, voltage, phases)


@inlined
def unit_rates(p, current_wanted, twist, state, electric):
    """Derivatives of the five states, the powers (W) as Energy lists them, and the bar torque (Nm).

    `electric` is the Running of the unit's drive.
    """
    current, rotor_angle, rotor_rate, angle, rate = state
    unit, ratio = p.unit, p.unit.gear.ratio
    speed = ratio * rotor_rate
    braking = drag(unit.drive.machine, speed)
    driving, load = ratio * (electric.torque - braking), mesh_torque(unit.gear, rotor_angle - angle)
    friction = gear_friction(unit.gear, driving, load, rotor_rate)
    bar, bushes = p.stiffness * (angle - twist), unit.bar_damping * rate
    derivatives = (
        current_rate(unit.drive, current, current_wanted),
        rotor_rate,
        (driving - load - friction) / (ratio * ratio * unit.rotor_inertia),
        rate,
        (load - bar - bushes) / unit.bar_inertia,
    )
    dissipated = braking * speed, friction * rotor_rate, bushes * rate
    return derivatives, (electric.drawn, electric.copper, electric.inverter, *dissipated), bar
