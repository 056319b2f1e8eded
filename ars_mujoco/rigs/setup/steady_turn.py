"""Steady turn: how the very car that runs answers to steering, measured by driving it."""

from dataclasses import replace

from ars_mujoco.excitation.knots import signal
from ars_mujoco.metrics.metric import G
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import simulate

ENTRY, SETTLED, END = 1.5, 4.5, 5.0  # s: bent into the turn, from where it is read, its end
TOLERANCE = 0.1  # of the lateral acceleration, within which the steering angle is scaled to what is wanted
BRISK = 6.0  # m/s^2, of the turn from which the driver learns the car


def understeer(start: Start) -> float:
    """Understeer gradient (rad of the road wheels over m/s^2) of the car in a brisk turn, for its driver."""
    steer, acceleration, speed = steady_turn(start, BRISK)
    return (steer - start.parameters.driver.wheelbase * acceleration / speed**2) / acceleration


def steering_angle(start: Start, acceleration: float) -> float:
    """Steering angle (rad) at which the car reaches a lateral acceleration (m/s^2) at the cycle's first speed."""
    steer, reached, speed = steady_turn(start, acceleration)
    if abs(reached - acceleration) > TOLERANCE * abs(acceleration):
        raise InputError(
            f"manoeuvre.lateral_acceleration: this car reaches {reached / G:.2f} g at {3.6 * speed:.0f} km/h, "
            f"not {acceleration / G:.2f} g"
        )
    return steer * acceleration / reached


def steady_turn(start: Start, acceleration: float) -> tuple[float, float, float]:
    """(steering angle rad, lateral acceleration m/s^2, speed m/s) of the car settled in a turn at the first speed."""
    parameters = start.parameters
    speed, bump = parameters.speed.copy(), parameters.bump.side
    parameters.speed, parameters.bump.side = signal([0.0], [speed.values[0]]), 0.0
    parameters.demand = signal([0.0, ENTRY], [0.0, acceleration / speed.values[0] ** 2])
    recording = simulate(replace(start.stored(), duration=END))
    parameters.speed, parameters.bump.side = speed, bump
    last = recording.time > SETTLED
    return tuple(recording[name][last].mean() for name in ("driver.steer", "body.lateral_acceleration", "body.speed"))
