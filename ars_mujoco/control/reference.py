"""The reference: from the sensors to what the bars are asked for, once a sample of the control unit."""

import numpy as np

from ars_mujoco.control.accelerometer import Accelerometer, AccelerometerState, low_pass, specific_force
from ars_mujoco.control.control_unit import BarCommand, by_angle, by_torque, samples_now
from ars_mujoco.control.reference_map import REFERENCE_MAP, bar_commands
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
        ("gives", "f8"),  # one of GIVES
    ]
)
# what a reference gives: the target map both angles and torques, a law one of them
BOTH, ANGLE, TORQUE = range(3)
STATE = np.dtype(
    [
        ("accelerometer", record_dtype(AccelerometerState)),
        ("memory", "f8", MEMORY),
        ("front", "f8"),  # angles last computed, rad
        ("rear", "f8"),
        ("front_torque", "f8"),  # torques last computed, Nm
        ("rear_torque", "f8"),
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
    later.front_torque, later.rear_torque = now.front_torque, now.rear_torque
    return reading


@kernel
def own_reference(p, unit, stiffness, later, sensors, step: float) -> None:
    """The shipped controller: target map of this very car and trim, faded in with speed, and roll damping.

    What trim and damping add to the angles, the torsions (Nm/rad) of the bars turn into torques.
    """
    if samples_now(unit, sensors.time, step):
        front, rear, roll, front_torque, rear_torque = bar_commands(p.map, sensors.lateral_acceleration)
        correction = trim(p.trim, later.memory[0], sensors.roll - roll, sensors.step)
        later.memory[0] = correction
        share = fade(p.fade, sensors.speed)
        damping = roll_damping(p.trim, sensors.roll_rate)
        later.front = share * (front + correction) + damping
        later.rear = share * (rear + correction) + damping
        later.front_torque = share * (front_torque + stiffness.front * correction) + stiffness.front * damping
        later.rear_torque = share * (rear_torque + stiffness.rear * correction) + stiffness.rear * damping


@kernel
def put(later, gives: float, front: float, rear: float) -> None:
    """Keep what a law gave, as angles (rad) or torques (Nm)."""
    if gives == ANGLE:
        later.front, later.rear = front, rear
    else:
        later.front_torque, later.rear_torque = front, rear


@kernel
def commanded(p, later, stiffness, twists):
    """BarCommands (front, rear) of what was last computed; what a law does not give follows from the bars' torsions."""
    if p.gives == ANGLE:
        return (
            by_angle(stiffness.front, (later.front, 0.0, 0.0), twists.front.angle),
            by_angle(stiffness.rear, (later.rear, 0.0, 0.0), twists.rear.angle),
        )
    if p.gives == TORQUE:
        return (
            by_torque(stiffness.front, later.front_torque, twists.front.angle),
            by_torque(stiffness.rear, later.rear_torque, twists.rear.angle),
        )
    return (
        BarCommand((later.front, 0.0, 0.0), later.front_torque),
        BarCommand((later.rear, 0.0, 0.0), later.rear_torque),
    )
