"""The reference: from the sensors to the commanded bar angles, once a sample of the control unit."""

import numpy as np

from ars_mujoco.control.accelerometer import Accelerometer, AccelerometerState, low_pass, specific_force
from ars_mujoco.control.control_unit import samples_now
from ars_mujoco.control.reference_map import REFERENCE_MAP, bar_angles
from ars_mujoco.control.roll_trim import RollTrim, roll_damping, trim
from ars_mujoco.control.sensors import MEMORY
from ars_mujoco.control.speed_fade import SpeedFade, fade
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

PARAMETERS = np.dtype(
    [
        ("accelerometer", record_dtype(Accelerometer)),
        ("map", REFERENCE_MAP),
        ("fade", record_dtype(SpeedFade)),
        ("trim", record_dtype(RollTrim)),
        ("gravity", "f8"),  # m/s^2
    ]
)
STATE = np.dtype(
    [
        ("accelerometer", record_dtype(AccelerometerState)),
        ("memory", "f8", MEMORY),
        ("front", "f8"),  # commands last computed, rad
        ("rear", "f8"),
    ]
)


class SensorOutput(Parameters):
    """What the accelerometer records."""

    lateral_acceleration: float = channel("m/s^2", "unfiltered reading of the accelerometer")
    filtered: float = channel("m/s^2", "what the controller gets")


@kernel
def read_accelerometer(p, now, later, sensors, velocity, axis, frame_acceleration: float, step: float) -> float:
    """Read the accelerometer, filter it into `sensors`, return the unfiltered reading (m/s^2).

    `velocity` and `axis` as in `specific_force`; `frame_acceleration` (m/s^2) is that of the frame in which the
    velocity is measured, along the axis.
    """
    reading = frame_acceleration + specific_force(
        now.accelerometer, later.accelerometer, velocity, axis, p.gravity, step
    )
    low_pass(p.accelerometer, now.accelerometer, later.accelerometer, reading, step)
    sensors.lateral_acceleration = later.accelerometer.filtered
    later.memory = now.memory
    later.front, later.rear = now.front, now.rear
    return reading


@kernel
def own_reference(p, unit, later, sensors, step: float) -> None:
    """The shipped controller: target map of this very car and trim, faded in with speed, and roll damping."""
    if samples_now(unit, sensors.time, step):
        front, rear, roll = bar_angles(p.map, sensors.lateral_acceleration)
        correction = trim(p.trim, later.memory[0], sensors.roll - roll, sensors.step)
        later.memory[0] = correction
        share = fade(p.fade, sensors.speed)
        damping = roll_damping(p.trim, sensors.roll_rate)
        later.front = share * (front + correction) + damping
        later.rear = share * (rear + correction) + damping
