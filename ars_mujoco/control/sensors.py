"""Sensors: what a controller is given at each of its samples."""

from ars_mujoco.channels import Signal
from ars_mujoco.parameters import Parameters, record_dtype

MEMORY = 32  # numbers a controller may keep from sample to sample


class Sensors(Parameters):
    """What the car's sensors read; the input of a controller, a user's own included."""

    time: Signal("s", "time of the sample")
    step: Signal("s", "time since the sample before")
    lateral_acceleration: Signal("m/s^2", "the accelerometer's filtered reading, positive in a left turn")
    roll: Signal("rad", "roll of the body, positive right side down")
    roll_rate: Signal("rad/s", "its rate")
    yaw_rate: Signal("rad/s", "yaw rate, positive to the left")
    speed: Signal("m/s", "forward speed")
    steer: Signal("rad", "steering angle of the road wheels, positive to the left")
    front_angle: Signal("rad", "angle of the front motor")
    rear_angle: Signal("rad", "angle of the rear motor")
    front_pressure: Signal("Pa", "pressure difference across the front motor")
    rear_pressure: Signal("Pa", "pressure difference across the rear motor")


SENSORS = record_dtype(Sensors)
