"""Steady turn: how the very car that runs answers to steering, measured by driving it."""

from dataclasses import replace

from ars_mujoco.excitation.knots import signal
from ars_mujoco.metrics.metric import G
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import simulate

ENTRY, SETTLED, END = 1.5, 4.5, 5.0  # s: bent into the turn, from where it is read, its end
TOLERANCE = 0.1  # of the lateral acceleration, within which the steering angle is scaled to what is wanted
BRISK = 6.0, 3.0, 1.5, 0.75  # m/s^2, of the turns from which the driver learns the car: the first that it can drive
LEARNT = 15.0  # m/s; more slowly a brisk turn is tighter than the wheels can be steered


def understeer(start: Start, speed: float) -> float:
    """Understeer gradient (rad of the road wheels over m/s^2) of the car, which rolls at `speed` (m/s), for its driver.

    Raises InputError for a car that drives none of the turns.
    """
    for wanted in BRISK:
        steer, reached, kept = steady_turn(start, wanted, speed)
        if _is_near(reached, wanted):
            return (steer - start.parameters.driver.wheelbase * reached / kept**2) / reached
    raise InputError(f"vehicle: it drives no steady turn of {wanted:g} m/s^2 at {3.6 * speed:.0f} km/h")


def steering_angle(start: Start, acceleration: float) -> float:
    """Steering angle (rad) at which the car reaches a lateral acceleration (m/s^2) at the cycle's first speed."""
    steer, reached, speed = steady_turn(start, acceleration, start.parameters.speed.values[0])
    if not _is_near(reached, acceleration):
        raise InputError(
            f"manoeuvre.lateral_acceleration: this car reaches {reached / G:.2f} g at {3.6 * speed:.0f} km/h, "
            f"not {acceleration / G:.2f} g"
        )
    return steer * acceleration / reached


def steady_turn(start: Start, acceleration: float, at: float) -> tuple[float, float, float]:
    """(steering angle rad, lateral acceleration m/s^2, speed m/s) of the car settled in a turn; it starts `at` m/s."""
    parameters = start.parameters
    speed, bump = parameters.speed.copy(), parameters.bump.side
    parameters.speed, parameters.bump.side = signal([0.0], [at]), 0.0
    parameters.demand = signal([0.0, ENTRY], [0.0, acceleration / at**2])
    recording = simulate(replace(start.stored(), duration=END))
    parameters.speed, parameters.bump.side = speed, bump
    last = recording.time > SETTLED
    return tuple(recording[name][last].mean() for name in ("driver.steer", "body.lateral_acceleration", "body.speed"))


def _is_near(reached: float, wanted: float) -> bool:
    return abs(reached - wanted) <= TOLERANCE * abs(wanted)
