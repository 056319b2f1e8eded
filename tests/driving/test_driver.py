"""The driver on a linear single-track model: how well he follows, and that his limits hold."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from records import blank, filled

from ars_mujoco.driving.driver import Driver, DriverOutput, DriverState, drive, preview, turn
from ars_mujoco.excitation.knots import signal, slope, value

SPEEDS = (10.0, 20.0, 33.3, 50.0)
H = 1e-3


@dataclass
class SingleTrack:
    """Linear single-track model with the sedan's masses, and its tires' stiffness (N/rad an axle) and relaxation."""

    mass, inertia, front, rear, relaxation = 1618.0, 3300.0, 1.372, 1.428, 0.45
    front_stiffness: float = 141e3
    rear_stiffness: float = 154e3

    @property
    def understeer(self):
        length = self.front + self.rear
        return self.mass / length * (self.rear / self.front_stiffness - self.front / self.rear_stiffness)

    def follow(self, p, curvature, speed, seconds):
        """Curvatures (n,) of the path driven after `curvature`, a signal, at constant `speed`, and steering angles."""
        now, later, out = blank(DriverState), blank(DriverState), blank(DriverOutput)
        vy = yaw_rate = yaw = front_force = rear_force = 0.0
        path, steering = [], []
        for t in np.arange(0.0, seconds, H):
            demands = value(curvature, t), value(curvature, t + preview(p, speed))
            course = yaw + math.atan2(vy, speed)
            steer, *_ = drive(p, now, later, out, H, *demands, speed, 0.0, speed, yaw_rate, course)
            now, later = later, now
            lag = H * speed / self.relaxation
            front_slip, rear_slip = (vy + self.front * yaw_rate) / speed - steer, (vy - self.rear * yaw_rate) / speed
            front_force -= lag * (front_force + self.front_stiffness * front_slip)
            rear_force -= lag * (rear_force + self.rear_stiffness * rear_slip)
            acceleration = (front_force + rear_force) / self.mass
            vy += H * (acceleration - speed * yaw_rate)
            yaw_rate += H * (self.front * front_force - self.rear * rear_force) / self.inertia
            yaw += H * yaw_rate
            path.append(acceleration / speed**2)
            steering.append(steer)
        return np.array(path), np.array(steering)


CARS = [SingleTrack(), SingleTrack(front_stiffness=85e3)]  # little understeer, and much
CAR = SingleTrack()
P = filled(Driver())


def driver_of(car, known=1.0, **changes):
    return filled(Driver().model_copy(update={"understeer": known * car.understeer, **changes}))


def turn_in(speed, lateral_acceleration=4.0):
    """Straight on for 1 s, then within 0.5 s into a turn."""
    return signal([1.0, 1.5], [0.0, lateral_acceleration / speed**2])


@pytest.mark.parametrize("car", CARS)
@pytest.mark.parametrize("speed", SPEEDS)
def test_a_turn_is_followed_without_oscillation(car, speed):
    demand = turn_in(speed)
    path = car.follow(driver_of(car), demand, speed, 6.0)[0] / demand.values[1]
    assert path.max() < 1.05
    assert np.abs(path[2500:] - 1.0).max() < 0.05  # from 1 s after the turn is reached
    assert path[-1] == pytest.approx(1.0, abs=0.005)
    error = path[1500:] - 1.0
    crossings = np.diff(np.sign(error[np.abs(error) > 0.01]))
    assert np.count_nonzero(crossings) <= 1


@pytest.mark.parametrize("speed", SPEEDS)
def test_a_driver_who_knows_the_understeer_badly_still_comes_to_the_curvature(speed):
    car = CARS[1]
    demand = turn_in(speed)
    path = car.follow(driver_of(car, known=0.7), demand, speed, 8.0)[0] / demand.values[1]
    assert path.max() < 1.1
    assert path[-1] == pytest.approx(1.0, abs=0.01)


def test_a_mirrored_path_is_steered_exactly_mirrored():
    left = CAR.follow(driver_of(CAR), turn_in(30.0, 4.0), 30.0, 3.0)[1]
    right = CAR.follow(driver_of(CAR), turn_in(30.0, -4.0), 30.0, 3.0)[1]
    assert np.all(left == -right) and left.max() > 0.01


def test_the_courses_of_many_rounds_are_followed():
    circle = signal([0.5, 1.5], [0.0, 0.05])
    path = CAR.follow(driver_of(CAR), circle, 10.0, 30.0)[0]
    assert path[-1] == pytest.approx(0.05, rel=1e-3)


@given(angle=st.floats(-100.0, 100.0))
def test_whole_turns_do_not_count(angle):
    assert -math.pi <= turn(angle) <= math.pi
    assert math.cos(turn(angle)) == pytest.approx(math.cos(angle), abs=1e-9)
    assert math.sin(turn(angle)) == pytest.approx(math.sin(angle), abs=1e-9)


def one_step(p, demand=0.0, speed_demand=30.0, speed=30.0, steer=0.0, trim=0.0, kernel=drive):
    now, later, out = blank(DriverState), blank(DriverState), blank(DriverOutput)
    now.steer, now.trim = steer, trim
    result = kernel(p, now, later, out, H, demand, demand, speed_demand, 0.0, speed, 0.1, 0.2)
    return result, (later.steer, later.course, later.trim)


def test_steering_keeps_its_rate_and_its_angle():
    assert one_step(P, demand=1.0)[0][0] == pytest.approx(P.steer_rate_limit * H)
    assert one_step(P, demand=1.0, steer=0.5999)[0][0] == P.steer_limit


def test_in_open_loop_the_demand_is_the_steering_angle():
    steer, *_ = one_step(filled(Driver(open_loop=1)), demand=0.04)[0]
    assert steer == 0.04


@given(demand=st.floats(-0.1, 0.1), speed=st.floats(0.0, 60.0))
def test_what_the_driver_does_is_a_function_of_the_state_now_and_the_car(demand, speed):
    assert one_step(P, demand, speed=speed) == one_step(P, demand, speed=speed)


@given(demand=st.floats(-0.1, 0.1), speed=st.floats(0.0, 60.0))
def test_interpreted_and_compiled_agree(demand, speed):
    interpreted = one_step(P, demand, speed=speed, kernel=getattr(drive, "py_func", drive))
    for one, other in zip(interpreted, one_step(P, demand, speed=speed), strict=True):
        assert one == pytest.approx(other, rel=1e-12, abs=1e-12)


def test_the_driven_axle_drives_and_all_wheels_brake():
    _, front, rear = one_step(P, speed_demand=31.0)[0]
    assert front > 0.0 and rear == 0.0
    _, front, rear = one_step(P, speed_demand=29.0)[0]
    assert front < 0.0 and rear < 0.0 and front / (front + rear) == pytest.approx(P.front_brake)
    _, front, rear = one_step(filled(Driver(front_drive=0)), speed_demand=31.0)[0]
    assert front == 0.0 and rear > 0.0


def hold(p, demand, seconds, resistance=0.0, speed=20.0):
    """Speeds (n,) of a mass that holds `demand`, a signal, against a constant deceleration."""
    now, later, out = blank(DriverState), blank(DriverState), blank(DriverOutput)
    speeds = []
    for t in np.arange(0.0, seconds, H):
        _, front, rear = drive(p, now, later, out, H, 0.0, 0.0, value(demand, t), slope(demand, t), speed, 0.0, 0.0)
        now, later = later, now
        speed += H * ((front + rear) / (p.mass * p.wheel_radius) - resistance)
        speeds.append(speed)
    return np.array(speeds)


def test_the_speed_is_held_against_resistance():
    speeds = hold(P, signal([0.0], [20.0]), 8.0, resistance=0.4)
    assert speeds.min() > 19.8
    assert speeds[-1] == pytest.approx(20.0, abs=2e-3)
    assert speeds.max() < 20.0 + 2e-3


def test_a_change_of_speed_within_the_limits_is_followed_at_once():
    demand = signal([1.0, 4.0], [20.0, 24.0])
    speeds = hold(P, demand, 6.0)
    assert np.abs(speeds - [value(demand, t) for t in np.arange(0.0, 6.0, H)]).max() < 0.01


def test_a_jump_of_speed_is_taken_at_the_limit_without_winding_up():
    speeds = hold(P, signal([0.0], [30.0]), 8.0)
    assert np.diff(speeds).max() / H == pytest.approx(P.drive_limit)
    assert speeds.max() < 30.3
    assert speeds[-1] == pytest.approx(30.0, abs=0.01)
