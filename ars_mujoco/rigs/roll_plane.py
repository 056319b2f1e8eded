"""The roll plane: a body that only rolls, pushed by a lateral force (the paper's Fig. 1), both axles active."""

import mujoco
import numpy as np

from ars_mujoco.actuators.pump_controlled import stabilizers
from ars_mujoco.actuators.pump_controlled.axle import AxleOutput
from ars_mujoco.actuators.pump_controlled.drive_speed import DriveOutput
from ars_mujoco.actuators.pump_controlled.full_circuit import WORK
from ars_mujoco.actuators.pump_controlled.stabilizers import (
    BAR_ADDRESSES,
    apply_bar_torques,
    bar_addresses,
    check_circuits,
    sense_circuits,
    stabilize_both,
    twist,
)
from ars_mujoco.bridge.callback import SIGNATURE, fields, record_at, world_address
from ars_mujoco.bridge.world import begin, check_finite, layout_version, world_dtype
from ars_mujoco.control import reference
from ars_mujoco.control.reference import SensorOutput, own_reference, read_accelerometer
from ars_mujoco.control.sensors import SENSORS
from ars_mujoco.excitation.knots import SIGNAL, value
from ars_mujoco.kernels.kernel import NativeCallback, entry, kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

NAME = "roll_plane"
NO_SPEED = 100.0  # m/s; the rig has none, and a controller that fades in with speed must act


class BodyOutput(Parameters):
    roll: float = channel("rad", "roll of the body, positive right side down")
    roll_rate: float = channel("rad/s", "its rate")
    lateral_acceleration: float = channel("m/s^2", "the lateral force over the mass, positive as in a left turn")


class Output(Parameters):
    """What the roll plane records."""

    body: BodyOutput
    sensor: SensorOutput
    front: AxleOutput
    rear: AxleOutput
    drive: DriveOutput


ADDRESSES = np.dtype(
    [
        ("body", "f8"),
        ("accelerometer", "f8"),
        ("roll_position", "f8"),
        ("roll_velocity", "f8"),
        ("roll_joint", "f8"),
        ("bars", BAR_ADDRESSES),
    ]
)
PARAMETERS = np.dtype(
    [
        ("at", ADDRESSES),
        ("stabilizers", stabilizers.PARAMETERS),
        ("reference", reference.PARAMETERS),
        ("acceleration", SIGNAL),  # lateral force over mass, m/s^2
        ("mass", "f8"),
    ]
)
STATE = np.dtype([("stabilizers", stabilizers.STATE), ("reference", reference.STATE)])
WORLD = world_dtype(PARAMETERS, STATE, record_dtype(Output), np.dtype([("sensors", SENSORS), ("work", WORK)]))


def addresses(model: mujoco.MjModel) -> dict:
    """The numbers of ADDRESSES, by the model's names."""
    roll = model.joint("roll")
    return {
        "body": model.body("body").id,
        "accelerometer": model.site("accelerometer").id,
        "roll_position": roll.qposadr[0],
        "roll_velocity": roll.dofadr[0],
        "roll_joint": roll.id,
        "bars": bar_addresses(model),
    }


@kernel
def step(world, mj) -> None:
    """One call of the callback with the shipped controller."""
    sense(world, mj)
    p = world.parameters
    own_reference(p.reference, p.stabilizers.unit, world.later.reference, world.scratch.sensors, world.header.step)
    act(world, mj)


@kernel
def sense(world, mj) -> None:
    """Bring the world to MuJoCo's time and read the sensors."""
    begin(world, mj.time)
    p, now, later, out, h = world.parameters, world.now, world.later, world.out, world.header.step
    at, sensors = p.at, world.scratch.sensors
    acceleration = value(p.acceleration, mj.time)
    out.body.roll, out.body.roll_rate = mj.qpos[int(at.roll_position)], mj.qvel[int(at.roll_velocity)]
    out.body.lateral_acceleration = acceleration
    # the road turns under the car: the body's frame accelerates to the left, which the force to the right stands for
    m, site, joint = 9 * int(at.body), 3 * int(at.accelerometer), 3 * int(at.roll_joint)
    ry, rz = mj.site_xpos[site + 1] - mj.xanchor[joint + 1], mj.site_xpos[site + 2] - mj.xanchor[joint + 2]
    rate = out.body.roll_rate
    velocity = (0.0, -rate * rz, rate * ry)
    left = (mj.xmat[m + 1], mj.xmat[m + 4], mj.xmat[m + 7])
    reading = read_accelerometer(
        p.reference, now.reference, later.reference, sensors, velocity, left, left[1] * acceleration, h
    )
    out.sensor.lateral_acceleration, out.sensor.filtered = reading, sensors.lateral_acceleration
    sensors.time, sensors.step = mj.time, max(p.stabilizers.unit.sample_time, h)
    sensors.roll, sensors.roll_rate = out.body.roll, rate
    sensors.speed = NO_SPEED
    sense_circuits(sensors, now.stabilizers)


@kernel
def act(world, mj) -> None:
    """Lateral force and stabilizers: write the forces of this step into MuJoCo."""
    p, now, later, out, h = world.parameters, world.now, world.later, world.out, world.header.step
    at = p.at
    mj.xfrc_applied[6 * int(at.body) + 1] = -p.mass * out.body.lateral_acceleration
    command = later.reference
    front, rear = stabilize_both(
        p.stabilizers, now.stabilizers, later.stabilizers, out.drive, out.front, out.rear, mj.time, h, NO_SPEED,
        (command.front, 0.0, 0.0), (command.rear, 0.0, 0.0), twist(at.bars, mj, 0), twist(at.bars, mj, 2),
        world.scratch.work,
    )  # fmt: skip
    apply_bar_torques(at.bars, mj, front, rear)
    check_circuits(world, p.stabilizers, later.stabilizers, mj.time)
    check_finite(world, front + rear + out.body.roll + out.body.roll_rate, mj.time)


SIZE, VERSION = WORLD.itemsize // 8, layout_version(WORLD)
world_at = record_at(WORLD)


def _control(model, data):
    address = world_address(model, data, SIZE, VERSION)
    if address != 0:
        step(world_at(address), fields(data))


@entry
def native_sense(model: int, data: int) -> None:
    """`sense` for mjModel and mjData at these addresses."""
    address = world_address(model, data, SIZE, VERSION)
    if address != 0:
        sense(world_at(address), fields(data))


@entry
def native_act(model: int, data: int) -> None:
    """`act` for mjModel and mjData at these addresses."""
    address = world_address(model, data, SIZE, VERSION)
    if address != 0:
        act(world_at(address), fields(data))


CALLBACK = NativeCallback(SIGNATURE, _control)
