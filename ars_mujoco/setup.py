"""Set-up: from validated files to a model whose userdata holds the whole world, at rest at the start of the cycle."""

from dataclasses import dataclass, field, replace
from importlib import import_module
from pathlib import Path
from types import ModuleType

import mujoco
import numpy as np

from ars_mujoco.actuators.actuator import Actuator, PumpControlled, fill_axle
from ars_mujoco.callback import installed
from ars_mujoco.control.control_unit import check_timing
from ars_mujoco.control.controller import Controller
from ars_mujoco.control.law import Law, law
from ars_mujoco.cycle import BarCommand, Circle, Cycle, Follow, LateralForce, StepSteer, Straight
from ars_mujoco.driver import Driver
from ars_mujoco.errors import InputError
from ars_mujoco.parameters import fill
from ars_mujoco.signal import signal
from ars_mujoco.vehicle import rest, statics
from ars_mujoco.vehicle.bench import Bench
from ars_mujoco.vehicle.model import specify
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import GRAVITY, Sedan
from ars_mujoco.world import NUMERIC, new_world

CIRCLE_ENTRY = 3.0  # s, over which the driver bends into a circle
CORNERS = ("fl", "fr", "rl", "rr")
TURN_ENTRY, TURN_SETTLING = 1.5, 5.0  # s, bending into a steady turn, and its end
EASY_TURN = 6.0  # m/s^2


@dataclass(frozen=True)
class Simulation:
    """What `simulate` runs: a rig's module and a model that carries the initial world; keyframe 0 is the start."""

    rig: ModuleType
    model: mujoco.MjModel
    duration: float  # s
    title: str
    law: Law | None = None  # a user's controller in place of the shipped one
    inputs: dict = field(default_factory=dict)

    def start(self) -> mujoco.MjData:
        """New data at the start of the cycle; the world follows at the first call."""
        data = mujoco.MjData(self.model)
        mujoco.mj_resetDataKeyframe(self.model, data, 0)
        return data


def prepare(cycle: Cycle, actuator: Actuator, controller: Controller, vehicle: Bench | RollPlane | Sedan) -> Simulation:
    """The simulation of `cycle` with these parts.

    Raises InputError where they do not fit together, and ArsError where the car has no rest or no statics.
    """
    rig = import_module(f"ars_mujoco.rigs.{cycle.rig}")  # compiles its callback, so only the one that runs
    spec = specify(vehicle)
    step = spec.option.timestep
    check_timing(controller.unit, step)
    world = new_world(rig.WORLD, step)
    parameters = world[0].parameters
    fill(parameters.stabilizers.loop, controller.loop)
    fill(parameters.stabilizers.unit, controller.unit)
    own = law(Path(controller.law)) if controller.law else None
    match vehicle:
        case Bench():
            if own:
                raise InputError("controller.law: the bench's cycle commands the bar itself; allowed on sedan and roll_plane")
            _bench(parameters, cycle.manoeuvre, actuator, vehicle, step)
            return _simulation(rig, spec, world, cycle, own)
        case RollPlane():
            return _roll_plane(rig, spec, world, cycle, actuator, controller, vehicle, own)
        case Sedan():
            return _sedan(rig, spec, world, cycle, actuator, controller, vehicle, own)


def _simulation(rig, spec, world, cycle, own) -> Simulation:
    """Compile the spec with the world as userdata and as its last custom numeric."""
    numbers = world.view(np.float64).reshape(-1)
    spec.nuserdata = numbers.size
    spec.add_numeric(name=NUMERIC, size=numbers.size, data=numbers)
    return Simulation(rig, spec.compile(), cycle.duration, cycle.title, own)


def _store(simulation: Simulation, world) -> None:
    """Write a changed world back into the model."""
    simulation.model.numeric_data[-simulation.model.nuserdata :] = world.view(np.float64).reshape(-1)


def _bench(parameters, manoeuvre: BarCommand, actuator, vehicle: Bench, step: float) -> None:
    if not isinstance(actuator, PumpControlled):
        raise InputError(f"actuator '{actuator.kind}' has nothing to command on the bench; allowed: pump_controlled")
    loop = parameters.stabilizers.loop
    fill_axle(parameters.stabilizers.front, actuator, "front", vehicle.stiffness, 0.0, loop, step)
    parameters.command, parameters.ends = manoeuvre.command.signal(), manoeuvre.ends.signal()
    parameters.arm, parameters.height = vehicle.arm, vehicle.height
    if np.abs(parameters.ends.values).max() >= vehicle.arm:
        raise InputError(f"manoeuvre.ends: the ends move by the arm's length or more; allowed: less than {vehicle.arm:g} m")


def _roll_plane(rig, spec, world, cycle, actuator, controller, vehicle: RollPlane, own) -> Simulation:
    simulation = _simulation(rig, spec, world, cycle, own)
    parameters, manoeuvre = world[0].parameters, cycle.manoeuvre
    assert isinstance(manoeuvre, LateralForce)
    _fill(parameters.at, rig.addresses(simulation.model))
    _stabilizers(parameters, actuator, vehicle.front, vehicle.rear, spec.option.timestep)
    parameters.acceleration, parameters.mass = manoeuvre.acceleration.signal(), vehicle.mass
    _reference(parameters.reference, simulation.model, actuator, controller, vehicle)
    _store(simulation, world)
    return simulation


def _sedan(rig, spec, world, cycle, actuator, controller, vehicle: Sedan, own) -> Simulation:
    simulation = _simulation(rig, spec, world, cycle, own)
    parameters, model = world[0].parameters, simulation.model
    _fill(parameters.at, rig.addresses(model))
    _stabilizers(parameters, actuator, vehicle.front.bar, vehicle.rear.bar, spec.option.timestep)
    fill(parameters.front_tire, vehicle.front.tire)
    fill(parameters.rear_tire, vehicle.rear.tire)
    fill(parameters.driver, _driver(vehicle))
    parameters.cg_height = vehicle.sprung.cg_height
    parameters.speed, parameters.demand = signal([0.0], [0.0]), signal([0.0], [0.0])  # at rest first
    if cycle.road.bump:
        fill(parameters.bump, cycle.road.bump)
    _reference(parameters.reference, model, actuator, controller, vehicle)
    _store(simulation, world)
    data = simulation.start()
    with installed(rig, model, data):
        rest.solve(model, data)
    parameters.speed = cycle.speed_signal()
    _roll_out(model, parameters, vehicle)
    _let_drive(simulation, world, cycle)
    return simulation


def _let_drive(simulation: Simulation, world, cycle: Cycle) -> None:
    """Give the driver the path or the steering angle; both first ask the car how it answers to steering."""
    parameters = world[0].parameters
    parameters.driver.understeer = _understeer(simulation, world)
    if isinstance(cycle.manoeuvre, StepSteer):
        steer = cycle.manoeuvre
        angle = _steering_angle(simulation, world, steer.lateral_acceleration)
        parameters.driver.open_loop = 1.0
        parameters.demand = signal([steer.start, steer.start + steer.ramp], [0.0, angle], "linear")
    else:
        parameters.demand = _curvature(cycle)
    _store(simulation, world)


def _driver(vehicle: Sedan) -> Driver:
    """A driver who knows this car's mass, wheelbase and wheels."""
    mass = vehicle.sprung.mass + 2 * (vehicle.front.unsprung_mass + vehicle.rear.unsprung_mass)
    known = {"wheelbase": vehicle.wheelbase, "mass": mass, "wheel_radius": vehicle.front.tire.radius}
    return Driver().model_copy(update=known)


def _roll_out(model: mujoco.MjModel, parameters, vehicle: Sedan) -> None:
    """Start the keyframe at the cycle's first speed, the wheels rolling without slip."""
    speed = parameters.speed.values[0]
    velocity = model.key_qvel[0]
    velocity[0] = speed
    for corner, dof in zip(CORNERS, parameters.at.spin_velocity, strict=True):
        axle = "front" if corner[0] == "f" else "rear"
        tire, load = getattr(vehicle, axle).tire, vehicle.wheel_load[axle]
        velocity[int(dof)] = speed / (tire.radius - load / tire.stiffness / 3.0)
    model.key_qvel[0] = velocity


def _curvature(cycle: Cycle) -> np.record:
    """The path's curvature (1/m) over time."""
    match cycle.manoeuvre:
        case Follow(lateral_acceleration=wanted):
            speeds = cycle.speed_signal()
            times, accelerations = zip(*wanted.knots, strict=True)
            speed = np.interp(times, speeds.times[: int(speeds.count)], speeds.values[: int(speeds.count)])
            return signal(times, np.divide(accelerations, speed**2), wanted.join)
        case Circle(radius=radius):
            return signal([0.0, CIRCLE_ENTRY], [0.0, 1.0 / radius])
        case Straight():
            return signal([0.0], [0.0])


def _understeer(simulation: Simulation, world) -> float:
    """Understeer gradient (rad of the road wheels over m/s^2) of this very car in an easy turn, for its driver."""
    driver = world[0].parameters.driver
    steer, acceleration, speed = _steady_turn(simulation, world, EASY_TURN)
    return (steer - driver.wheelbase * acceleration / speed**2) / acceleration


def _steering_angle(simulation: Simulation, world, acceleration: float) -> float:
    """Steering angle (rad) at which this very car reaches a lateral acceleration (m/s^2) at its starting speed."""
    steer, reached, _ = _steady_turn(simulation, world, acceleration)
    return steer * acceleration / reached


def _steady_turn(simulation: Simulation, world, acceleration: float) -> tuple[float, float, float]:
    """(steering angle rad, lateral acceleration m/s^2, speed m/s) once the driver has settled in a turn at the first speed."""
    from ars_mujoco.simulation import simulate  # which itself starts from this module's Simulation

    parameters = world[0].parameters
    speed = parameters.speed.values[0]
    driven = replace(simulation, duration=TURN_SETTLING)
    before = parameters.speed.copy(), parameters.bump.side
    parameters.speed, parameters.bump.side = signal([0.0], [speed]), 0.0
    parameters.demand = signal([0.0, TURN_ENTRY], [0.0, acceleration / speed**2])
    _store(driven, world)
    recording = simulate(driven)
    parameters.speed, parameters.bump.side = before
    last = recording.time > TURN_SETTLING - 0.5
    return tuple(recording[name][last].mean() for name in ("driver.steer", "body.lateral_acceleration", "body.speed"))


def _stabilizers(parameters, actuator, front_bar, rear_bar, step: float) -> None:
    for axle, bar in (("front", front_bar), ("rear", rear_bar)):
        record = parameters.stabilizers[axle]
        fill_axle(record, actuator, axle, bar.stiffness, bar.passive_stiffness, parameters.stabilizers.loop, step)


def _reference(record, model, actuator, controller: Controller, vehicle) -> None:
    """The accelerometer and, where bars are active, the target turned into bar angles by the statics of this model."""
    if controller.reference is None:
        raise InputError("controller.reference: is missing; only the bench does without")
    reference = controller.reference
    fill(record.accelerometer, reference.accelerometer)
    fill(record.fade, reference.fade)
    fill(record.trim, reference.trim)
    record.gravity = GRAVITY
    if isinstance(actuator, PumpControlled):
        table = statics.reference_map(model, vehicle, tuple(reference.target), reference.front_share)
        record.map.count = len(table.reading)
        for name, column in (
            ("sensor", table.reading), ("roll", table.roll), ("front", table.front_angle), ("rear", table.rear_angle)
        ):  # fmt: skip
            record.map[name][: len(column)] = column


def _fill(record, values: dict) -> None:
    for name, value in values.items():
        if isinstance(value, dict):
            _fill(record[name], value)
        else:
            record[name] = value
