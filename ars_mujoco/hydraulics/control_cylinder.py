"""Control cylinder: the piston that turns the swash plate, and the forces on it (paper eqs. 1 to 8).

Positive travel is that of positive pump stroke. With eq. 1 chamber A grows with it, so that eqs. 5 and 6 hold with
their signs exchanged; and the series capacitance of eq. 8 falls with x^2, where the paper prints a plus.
"""

import math
from typing import Any

from ars_mujoco.hydraulics.oil import compressibility, compressibility_slope
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class ControlCylinder(Parameters):
    """Control cylinder with all that moves with it, reduced to its piston."""

    area: float = quantity("m^2", gt=0)  # A_AC
    travel: float = quantity("m", gt=0)  # x_max = x_H, from the middle to either end
    dead_volume: float = quantity("m^3", gt=0)  # V_dead of one chamber, lines to the valve included
    mass: float = quantity("kg", gt=0)  # m_equ
    centring_stiffness: float = quantity("N/m", ge=0)  # F_SP over x
    swash_force: float = quantity("N", ge=0)  # F_SL at `swash_pressure`: a delivering pump pushes its plate back
    swash_pressure: float = quantity("Pa", gt=0)
    coulomb_friction: float = quantity("N", ge=0)  # f_C
    static_friction: float = quantity("N", ge=0)  # f_s
    static_decay: float = quantity("s/m", ge=0)  # tau_s
    viscous_friction: float = quantity("Ns/m", ge=0)  # f_v
    friction_speed: float = quantity("m/s", gt=0)  # over which the friction's sign is rounded
    internal_leakage: float = quantity("m^3/s/Pa", ge=0)  # k_Li
    external_leakage: float = quantity("m^3/s/Pa", ge=0)  # k_LA = k_LB, to the return line
    stop_stiffness: float = quantity("N/m", gt=0)  # of the mechanical stops at either end
    stop_damping: float = quantity("Ns/m", ge=0)


@kernel
def cylinder_friction(cylinder: ControlCylinder, rate: float) -> Any:
    """Friction force (N) at a piston speed (m/s) and its slope (Ns/m): eq. 2 with sign() rounded to tanh()."""
    decay = cylinder.static_friction * math.exp(-cylinder.static_decay * abs(rate))
    dry = cylinder.coulomb_friction + decay
    sign = math.tanh(rate / cylinder.friction_speed)
    slope = dry * (1.0 - sign * sign) / cylinder.friction_speed - cylinder.static_decay * decay * abs(sign)
    return dry * sign + cylinder.viscous_friction * rate, slope + cylinder.viscous_friction


@kernel
def stop_force(cylinder: ControlCylinder, travel: float, rate: float) -> Any:
    """Force (N) of the mechanical stops, which push but do not pull, and its slopes by travel and by speed."""
    beyond, outward = abs(travel) - cylinder.travel, math.copysign(1.0, travel)
    force = cylinder.stop_stiffness * beyond + cylinder.stop_damping * outward * rate
    if beyond <= 0.0 or force <= 0.0:
        return 0.0, 0.0, 0.0
    return outward * force, cylinder.stop_stiffness, cylinder.stop_damping


@kernel
def piston_acceleration(
    cylinder: ControlCylinder, force: float, travel: float, rate: float, pump_pressure: float
) -> Any:
    """Acceleration (m/s^2) under a pressure `force` (N), and its slopes by travel and by speed (eq. 1)."""
    friction, friction_slope = cylinder_friction(cylinder, rate)
    stop, stop_by_travel, stop_by_rate = stop_force(cylinder, travel, rate)
    swash = cylinder.swash_force / cylinder.swash_pressure * pump_pressure
    inverse = 1.0 / cylinder.mass
    return (
        inverse * (force - friction - swash - cylinder.centring_stiffness * travel - stop),
        -inverse * (cylinder.centring_stiffness + stop_by_travel),
        -inverse * (friction_slope + stop_by_rate),
    )


@kernel
def chamber_volumes(cylinder: ControlCylinder, travel: float) -> Any:
    """Volumes (m^3) of chambers A and B: eqs. 5 and 6 with the signs that eq. 1 needs."""
    middle, shift = cylinder.dead_volume + cylinder.area * cylinder.travel, cylinder.area * travel
    return middle + shift, middle - shift


@kernel
def chamber_capacitance(fluid: Any, volume: float, pressure: float) -> Any:
    """Capacitance (m^3/Pa) of a chamber at a pressure (Pa), and its slope by pressure (eq. 7)."""
    return volume * compressibility(fluid, pressure), volume * compressibility_slope(fluid, pressure)


@kernel
def common_capacitance(cylinder: ControlCylinder, fluid: Any, travel: float, pressure: float) -> float:
    """Capacitance (m^3/Pa) of both chambers in series: eq. 8 with the minus sign that its algebra gives."""
    a, b = chamber_volumes(cylinder, travel)
    return a * b / (a + b) * compressibility(fluid, pressure)
