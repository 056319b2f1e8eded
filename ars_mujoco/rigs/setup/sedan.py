"""Set-up of the sedan: parked at rest, learnt by its driver, rolling at the cycle's first speed, told where to go."""

import numpy as np

from ars_mujoco.bridge.callback import installed, tables_of
from ars_mujoco.control.controller import Controller
from ars_mujoco.driving.driver import Driver
from ars_mujoco.excitation.knots import signal
from ars_mujoco.manoeuvres.cycle import Circle, Cycle, Follow, StepSteer, Straight
from ars_mujoco.rigs.setup.car import fill_addresses, fill_reference, law_of, torsion
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.rigs.setup.steady_turn import LEARNT, steering_angle, understeer
from ars_mujoco.schema.errors import ArsError, InputError
from ars_mujoco.schema.parameters import Parameters, fill
from ars_mujoco.simulation.simulation import Simulation
from ars_mujoco.tires.contact import rolling_radius
from ars_mujoco.vehicle import rest
from ars_mujoco.vehicle.model import specify
from ars_mujoco.vehicle.sedan import Sedan

CIRCLE_ENTRY = 3.0  # s, over which the driver bends into a circle
AXLES = ("front", "front", "rear", "rear")  # of the corners fl, fr, rl, rr


def set_up(cycle: Cycle, actuator: Parameters, controller: Controller, vehicle: Sedan) -> Simulation:
    """The sedan's simulation."""
    start = Start(specify(vehicle), cycle, actuator, controller.unit, law_of(controller))
    parameters, model = start.parameters, start.simulation.model
    fill_addresses(parameters.at, start.rig.addresses(model))
    start.fill_system(torsion(vehicle.front.bar), torsion(vehicle.rear.bar), has_road=True)
    fill_reference(start, controller, vehicle)
    fill(parameters.front_tire, vehicle.front.tire)
    fill(parameters.rear_tire, vehicle.rear.tire)
    fill(parameters.driver, _driver(vehicle))
    parameters.cg_height = vehicle.sprung.cg_height
    if cycle.road.bump:
        fill(parameters.bump, cycle.road.bump)
    try:
        _park(start)
    except ArsError as error:
        on_bump = "road.bump: a wheel that starts on it finds no stand: " if cycle.road.bump else ""
        raise InputError(f"{on_bump}{error}") from None
    parameters.speed = cycle.speed_signal()
    _learn(start, vehicle)
    _roll_out(start, vehicle, parameters.speed.values[0])
    _let_drive(start, cycle)
    return start.stored()


def _driver(vehicle: Sedan) -> Driver:
    """A driver who knows this car's mass, wheelbase and wheels."""
    known = {"wheelbase": vehicle.wheelbase, "mass": vehicle.mass, "wheel_radius": vehicle.front.tire.radius}
    return Driver().model_copy(update=known)


def _park(start: Start) -> None:
    """Make the keyframe the car's true rest, with the driver asked for nothing."""
    start.parameters.speed = start.parameters.demand = signal([0.0], [0.0])
    simulation = start.stored()
    data = simulation.start()
    with installed(start.rig, simulation.model, data):
        rest.solve(simulation.model, data)


def _learn(start: Start, vehicle: Sedan) -> None:
    """The driver asks the car how it answers to steering, at the cycle's first speed where that can tell."""
    speed = max(start.parameters.speed.values[0], LEARNT)
    _roll_out(start, vehicle, speed)
    start.parameters.driver.understeer = understeer(start, speed)


def _roll_out(start: Start, vehicle: Sedan, speed: float) -> None:
    """Start the keyframe at `speed` (m/s), the wheels rolling without slip."""
    model, parameters = start.simulation.model, start.parameters
    velocity = model.key_qvel[0].copy()
    velocity[0] = speed
    for axle, dof in zip(AXLES, parameters.at.spin_velocity, strict=True):
        tire = vehicle.axles[axle].tire
        velocity[int(dof)] = speed / rolling_radius(tire.radius, vehicle.wheel_load[axle] / tire.stiffness)
    model.key_qvel[0] = velocity


def _let_drive(start: Start, cycle: Cycle) -> None:
    """Give the driver the path, or the steering angle, which the car is asked for."""
    parameters, manoeuvre = start.parameters, cycle.manoeuvre
    if isinstance(manoeuvre, StepSteer):
        angle = steering_angle(start, manoeuvre.lateral_acceleration)
        parameters.demand = signal([manoeuvre.start, manoeuvre.start + manoeuvre.ramp], [0.0, angle], "linear")
        parameters.driver.open_loop = 1.0
    else:
        if isinstance(manoeuvre, Follow) and manoeuvre.lateral_acceleration.is_sampled:
            tables_of(start.rig, start.simulation.model).demand = manoeuvre.lateral_acceleration.samples()
        else:
            parameters.demand = _path(manoeuvre)
        parameters.demand_over_speed = isinstance(manoeuvre, Follow)


def _path(manoeuvre: Follow | Circle | Straight) -> np.record:
    """The path over time: its curvature (1/m), or the lateral acceleration (m/s^2) it is followed at."""
    match manoeuvre:
        case Follow(lateral_acceleration=wanted):
            return wanted.signal()
        case Circle(radius=radius):
            return signal([0.0, CIRCLE_ENTRY], [0.0, 1.0 / radius])
        case Straight():
            return signal([0.0], [0.0])
