"""Planetary gear: between a fast machine and a slow bar, with friction in all four quadrants, backlash and stiffness.

Its friction grows with what its teeth carry. Driving, the output gets the share eta of the machine's torque; driven
back, the machine gets 2 - 1/eta of the output's. One form serves all quadrants:

    M_f = (1 - eta)/(1 + eta) |i T + M| + M_0

against the motion, and rounded at standstill, where the gear so holds anything between both. It gives eta back where
the exact form gives 2 - 1/eta: 0.880 for 0.864.
"""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class PlanetaryGear(Parameters):
    """Stages in series, as seen at the output."""

    ratio: float = number(gt=0)  # i, machine over output
    efficiency: float = number(gt=0, le=1)  # eta, driving
    friction: float = quantity("Nm", ge=0)  # M_0, that is there without load
    damping: float = quantity("Nms/rad", ge=0)
    sign_speed: float = quantity("rad/s", gt=0)  # of the output, over which the sign of the friction is rounded
    backlash: float = quantity("rad", ge=0)  # of the output, from flank to flank
    stiffness: float = quantity("Nm/rad", gt=0)  # c_g, of teeth, shafts and housing


@kernel
def gear_friction(gear: PlanetaryGear, driving: float, load: float, speed: float) -> float:
    """Torque (Nm) against the output's speed (rad/s): `driving` is i T of the machine, `load` the output's torque."""
    size = (1.0 - gear.efficiency) / (1.0 + gear.efficiency) * abs(driving + load) + gear.friction
    return size * math.tanh(speed / gear.sign_speed) + gear.damping * speed


@kernel
def mesh_torque(gear: PlanetaryGear, twist: float) -> float:
    """Torque (Nm) of the meshing teeth for a twist (rad) of the input against the output, both at the output."""
    return gear.stiffness * _beyond_backlash(gear, twist)


@kernel
def mesh_energy(gear: PlanetaryGear, twist: float) -> float:
    """Energy (J) stored in the meshing teeth."""
    return 0.5 * gear.stiffness * _beyond_backlash(gear, twist) ** 2


@kernel
def _beyond_backlash(gear: PlanetaryGear, twist: float) -> float:
    # a dead zone of half the backlash to either side
    return math.copysign(max(abs(twist) - 0.5 * gear.backlash, 0.0), twist)
