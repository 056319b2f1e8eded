"""The loops of one axle: what torque its machine is asked for, so that the bar's torque or angle follows its command.

    command ─> K D/D_p ─(+)─> limit ─> PI ─(+)─> drive
       ^                ^                   ^
    phi, psi      k dp/D_p, leakage   D_p dp, load            dp as its sensor shows it

Torque and angle are one loop: the bar's torque is c (phi - psi), so that a missing torque is a missing angle. Feeding
the load forward takes the bar, a spring, off the rotor; what is left for the speed loop is the rotor's inertia alone,
which that loop damps. Feeding the leakage forward makes the pump creep as a held pressure needs.

Against windup the integral gives back what the machine cannot do, in the time in which it builds up.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, choice, quantity

TORQUE, ANGLE = 0.0, 1.0


class Control(Parameters):
    """Loops of one axle."""

    follow: float = choice("torque", "angle", default=TORQUE)
    gain: float = quantity("1/s", gt=0)  # K, rate of the bar's angle over its error
    speed_limit: float = quantity("rad/s", gt=0)  # of the pump, with the supply at
    full_voltage: float = quantity("V", gt=0)  # and in proportion below it
    speed_bandwidth: float = quantity("rad/s", gt=0)  # of the speed loop
    integral_time: float = quantity("s", gt=0)  # of the same
    pressure_lag: float = quantity("s", gt=0)  # of the pressure sensor


@kernel
def missing_angle(control, bar_stiffness, angle_command, torque_command, angle, twist):
    """Angle (rad) by which the bar's motor is behind a commanded angle (rad) or torque (Nm), whichever is followed."""
    if control.follow == ANGLE:
        return angle_command - angle
    return torque_command / bar_stiffness - (angle - twist)


@kernel
def speed_command(control, circuit, missing, sensed, voltage):
    """Speed (rad/s) to ask of the pump: `missing` (rad) is by how much the bar's angle is behind its command, `sensed`
    (Pa) the pressure that leaks, `voltage` (V) the supply's.
    """
    pump, motor = circuit.pump, circuit.motor
    delivered = motor.displacement * control.gain * missing + (pump.leakage + motor.leakage) * sensed
    limit = control.speed_limit * min(1.0 / control.full_voltage * voltage, 1.0)
    return saturate(1.0 / pump.displacement * delivered, limit)


@kernel
def torque_command(control, circuit, behind, integral, sensed):
    """Torque (Nm) to ask of the machine where its speed is `behind` (rad/s) what was asked of it."""
    proportional = control.speed_bandwidth * circuit.rotor_inertia * behind
    return proportional + integral + circuit.pump.displacement * sensed


@kernel
def integral_rate(control, circuit, behind, excess):
    """Rate (Nm/s) of the speed loop's integral, `excess` (Nm) being what the machine was asked for and cannot give."""
    return (control.speed_bandwidth * circuit.rotor_inertia * behind - excess) / control.integral_time
