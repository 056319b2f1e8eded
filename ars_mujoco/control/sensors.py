"""Sensors: what a controller is given at each of its samples."""

from collections import namedtuple

from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

MEMORY = 32  # numbers a controller may keep from sample to sample


class Sensors(Parameters):
    """What the car's sensors read; the input of a controller, a user's own included."""

    time: float = channel("s", "time of the sample")
    step: float = channel("s", "time since the sample before")
    lateral_acceleration: float = channel("m/s^2", "the accelerometer's filtered reading, positive in a left turn")
    roll: float = channel("rad", "roll of the body, positive right side down")
    roll_rate: float = channel("rad/s", "its rate")
    yaw_rate: float = channel("rad/s", "yaw rate, positive to the left")
    speed: float = channel("m/s", "forward speed")
    steer: float = channel("rad", "steering angle of the road wheels, positive to the left")
    front_angle: float = channel("rad", "angle between the front bar's halves")
    rear_angle: float = channel("rad", "angle between the rear bar's halves")
    front_torque: float = channel("Nm", "torque of the front actuator, as its own sensors tell it")
    rear_torque: float = channel("Nm", "torque of the rear actuator, as its own sensors tell it")


SENSORS = record_dtype(Sensors)
# the same of one sample, as Python code gets it: plain numbers that stay what they are
Readings = namedtuple("Readings", SENSORS.names)
