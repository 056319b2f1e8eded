"""Driver: steers along a curvature and holds a speed.

Steering is what the curvature needs in the steady state, (L + K v^2) kappa with wheelbase L and understeer gradient K,
plus two corrections that scale with the same inverse yaw gain (L + K v^2) / v, so that they act alike at every speed:
on the yaw rate, which damps, and on the course (direction of travel of the centre of gravity), whose reference is the
integral of kappa v and which corrects what the steady-state term does not know. The speed is held by a PI controller
that is critically damped for a car of the given mass.
"""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, number, quantity

LEAST_SPEED = 3.0  # m/s under which the inverse yaw gain is no longer raised


class Driver(Parameters):
    """The car as its driver knows it, his reactions and his limits; gains and limits are judgement."""

    open_loop: float = number(
        ge=0, le=1, default=0.0
    )  # 1: the demand is the steering angle itself, as open-loop tests ask
    wheelbase: float = quantity("m", gt=0, default=2.80)
    understeer: float = quantity(
        "rad*s^2/m", default=2.7e-3
    )  # gradient K of the road wheels' angle over lateral acceleration
    mass: float = quantity("kg", gt=0, default=1618.0)
    wheel_radius: float = quantity("m", gt=0, default=0.3135)
    cornering_stiffness: float = quantity("N/rad", gt=0, default=290e3)  # of all four tires
    steering_lag: float = quantity("s", ge=0, default=0.03)  # of steering and carcasses
    yaw_gain: float = number(ge=0, default=0.2)  # share of the yaw-rate error that is steered against
    course_time: float = quantity("s", gt=0, default=1.0)  # time to correct the course
    steer_limit: float = quantity("rad", gt=0, default=0.6)
    steer_rate_limit: float = quantity("rad/s", gt=0, default=1.0)
    speed_time: float = quantity("s", gt=0, default=0.5)  # time to correct the speed
    drive_limit: float = quantity("m/s^2", gt=0, default=4.0)  # of the acceleration asked of the drive
    brake_limit: float = quantity("m/s^2", gt=0, default=8.0)
    front_drive: float = number(ge=0, le=1, default=1.0)  # front axle's share of the driving torque
    front_brake: float = number(ge=0, le=1, default=0.6)  # front axle's share of the braking torque


class DriverState(Parameters):
    """What the driver carries from step to step."""

    steer: float = quantity("rad", default=0.0)  # angle of the road wheels
    course: float = quantity("rad", default=0.0)  # reference: starts at the car's course
    trim: float = quantity("m/s^2", default=0.0)  # acceleration found necessary to hold the speed


class DriverOutput(Parameters):
    """What the driver does."""

    steer: float = channel("rad", "steering angle asked of the front wheels, positive to the left")
    course_error: float = channel("rad", "course to the left of the car's that the path asks")
    front_torque: float = channel("Nm", "drive torque of the front axle, negative when braking")
    rear_torque: float = channel("Nm", "drive torque of the rear axle, negative when braking")


@kernel
def drive(p, now, next, out, h, demand, demand_ahead, speed_demand, speed_rate, speed, yaw_rate, course):
    """(steering angle rad, front and rear axle torque Nm) for a step h (s).

    p, now, next, out: records of Driver, DriverState (twice) and DriverOutput. demand: the path's curvature (1/m, left
    positive) now, demand_ahead: that a `preview` later; in open loop both are the steering angle (rad). speed_demand
    (m/s) and its rate (m/s^2). speed (m/s), yaw_rate (rad/s) and course (rad, direction of travel) are the car's.

    A pure function of all but `next` and `out`, which it writes.
    """
    error = turn(now.course - course)
    if p.open_loop > 0.0:
        steer, next.course = demand, course
    else:
        asked = steering(p, demand, demand_ahead, error, speed, yaw_rate)
        steer = limited(asked, now.steer, p.steer_rate_limit * h, p.steer_limit)
        next.course = now.course + h * demand * speed
    next.steer = steer

    acceleration, next.trim = hold_speed(p, now.trim, h, speed_demand, speed_rate, speed)
    front, rear = axle_torques(p, acceleration)
    out.steer, out.course_error, out.front_torque, out.rear_torque = steer, error, front, rear
    return steer, front, rear


@kernel
def preview(p, speed):
    """How far ahead (s) the driver looks: the lag of a car's course behind its steering, m v / C + steering lag."""
    return p.mass * speed / p.cornering_stiffness + p.steering_lag


@kernel
def turn(angle):
    """`angle` (rad) less whole turns, in -pi to pi."""
    return angle - 2.0 * math.pi * math.floor(angle / (2.0 * math.pi) + 0.5)


@kernel
def steering(p, curvature, curvature_ahead, course_error, speed, yaw_rate):
    """Steering angle (rad): (L + K v^2) (kappa_ahead + (g (kappa v - r) + course_error / T) / v)."""
    correction = p.yaw_gain * (curvature * speed - yaw_rate) + course_error / p.course_time
    steady = p.wheelbase + p.understeer * speed * speed
    return steady * (curvature_ahead + correction / max(speed, LEAST_SPEED))


@kernel
def limited(asked, last, change, most):
    """`asked`, within `change` of `last` and within +-`most`."""
    return max(-most, min(most, max(last - change, min(last + change, asked))))


@kernel
def hold_speed(p, trim, h, demand, rate, speed):
    """(acceleration m/s^2, next trim): rate + e/T + integral of e/(4 T^2), both poles at -1/(2 T).

    Beyond the limits the trim follows what was not granted, so that it does not wind up.
    """
    error = demand - speed
    asked = rate + error / p.speed_time + trim
    granted = max(-p.brake_limit, min(p.drive_limit, asked))
    return granted, trim + h * (0.25 * error / p.speed_time + granted - asked) / p.speed_time


@kernel
def axle_torques(p, acceleration):
    """(front, rear) torque (Nm) for an acceleration (m/s^2): driven axles drive, all brake."""
    torque = p.mass * p.wheel_radius * acceleration
    front = p.front_drive if torque > 0.0 else p.front_brake
    return front * torque, torque - front * torque
