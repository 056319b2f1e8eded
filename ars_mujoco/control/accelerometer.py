"""Accelerometer: what a lateral sensor on the body reads, and the low-pass filter behind it.

The sensor sits ahead of the centre of gravity, so that it leads by the yaw acceleration (Darling and Hickson, in the
paper's section 5), and it feels a part of gravity as the body rolls: it reads about a_y + g sin(roll).
"""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, quantity


class Accelerometer(Parameters):
    """Lateral accelerometer with a first-order filter."""

    cutoff: float = quantity("Hz", gt=0)  # corner frequency of the filter


class AccelerometerState(Parameters):
    """What the sensor keeps from one step to the next."""

    velocity_x: float = channel(
        "m/s", "velocity of the sensor one step ago, world axes; its change is the acceleration"
    )
    velocity_y: float = channel("m/s", "the same, y")
    velocity_z: float = channel("m/s", "the same, z")
    running: float = channel("1", "1 once a velocity has been seen")
    filtered: float = channel("m/s^2", "the filter's output")


@kernel
def specific_force(now, later, velocity, axis, gravity: float, step: float) -> float:
    """Specific force (m/s^2) along the sensor's `axis` (world unit vector) from the change of its world `velocity`.

    The mean over the last step; at the first call, where there is no last step, the sensor reads gravity alone.
    """
    vx, vy, vz = velocity
    rate = now.running / step
    later.velocity_x, later.velocity_y, later.velocity_z, later.running = vx, vy, vz, 1.0
    return (
        axis[0] * (vx - now.velocity_x) * rate
        + axis[1] * (vy - now.velocity_y) * rate
        + axis[2] * ((vz - now.velocity_z) * rate + gravity)
    )


@kernel
def low_pass(sensor, now, later, reading: float, step: float) -> None:
    """First-order filter of `reading`, exact for an input held over the step (s)."""
    later.filtered = reading + (now.filtered - reading) * math.exp(-2.0 * math.pi * sensor.cutoff * step)
