"""Vane motor: torque from pressure, Stribeck friction, leakage and its mechanical stop (paper eqs. 25 to 28, 40)."""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class VaneMotor(Parameters):
    """Rotary vane motor between the two halves of the stabilizer bar."""

    displacement: float = quantity("m^3/rad", gt=0)  # D = V_M/2pi
    inertia: float = quantity("kg*m^2", gt=0)  # Theta, the bar's halves included
    leakage: float = quantity("m^3/s/Pa", ge=0)  # the motor's share of k_Li
    coulomb_friction: float = quantity("Nm", ge=0)  # r_C
    static_friction: float = quantity("Nm", ge=0)  # r_H, above r_C at standstill
    static_decay: float = quantity("s/rad", ge=0)  # tau_H
    viscous_friction: float = quantity("Nms/rad", ge=0)  # r_v
    friction_speed: float = quantity("rad/s", gt=0)  # w_s, over which the friction's sign is rounded
    stop_angle: float = quantity("rad", gt=0)  # phi_n, the vane's mechanical stop
    stop_stiffness: float = quantity("Nm/rad", ge=0)  # of that stop


@kernel
def friction_torque(motor: VaneMotor, rate: float) -> float:
    """Friction torque (Nm) at `rate` (rad/s): eq. 28 with sign() rounded to tanh() so that standstill is solvable."""
    dry = motor.coulomb_friction
    if motor.static_friction > 0.0:
        dry += motor.static_friction * math.exp(-motor.static_decay * abs(rate))
    return dry * rounded_sign(1.0 / motor.friction_speed * rate) + motor.viscous_friction * rate


@kernel
def stop_torque(motor: VaneMotor, angle: float) -> float:
    """Torque (Nm) of the mechanical stop against an angle beyond it; elastic, so it stores and gives back."""
    if angle > motor.stop_angle:
        return motor.stop_stiffness * (angle - motor.stop_angle)
    if angle < -motor.stop_angle:
        return motor.stop_stiffness * (angle + motor.stop_angle)
    return 0.0


@kernel
def rounded_sign(x: float) -> float:
    """tanh(x): the sign of dry friction, rounded over |x| < 1."""
    # by the exponential, which compilers know to have no side effects: constants stay out of the loop
    return math.copysign(1.0 - 2.0 / (math.exp(min(2.0 * abs(x), 700.0)) + 1.0), x)
