"""The roll plane: a body that only rolls, pushed by a lateral force (the paper's Fig. 1), both axles active."""

import mujoco
import numpy as np

from ars_mujoco.actuators import bars
from ars_mujoco.actuators.bars import account, apply, stabilize, twists_now
from ars_mujoco.actuators.system import Moment
from ars_mujoco.bridge.world import begin, check_finite
from ars_mujoco.control import reference
from ars_mujoco.control.reference import SensorOutput, commanded, own_reference, read_accelerometer
from ars_mujoco.excitation.knots import SIGNAL, value
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.rigs.plots import ROLL_PLANE
from ars_mujoco.rigs.rig import Frame
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters

NO_SPEED = 100.0  # m/s; the rig has none, and a controller that fades in with speed must act


class BodyOutput(Parameters):
    roll: float = channel("rad", "roll of the body, positive right side down")
    roll_rate: float = channel("rad/s", "its rate")
    lateral_acceleration: float = channel("m/s^2", "the lateral force over the mass, positive as in a left turn")


class Output(Parameters):
    """What the roll plane records."""

    body: BodyOutput
    sensor: SensorOutput


ADDRESSES = np.dtype(
    [
        ("body", "f8"),
        ("accelerometer", "f8"),
        ("roll_position", "f8"),
        ("roll_velocity", "f8"),
        ("roll_joint", "f8"),
        ("bars", bars.ADDRESSES),
    ]
)
PARAMETERS = [
    ("at", ADDRESSES),
    ("reference", reference.PARAMETERS),
    ("acceleration", SIGNAL),  # lateral force over mass, m/s^2
    ("mass", "f8"),
]
STATE = [("reference", reference.STATE)]


def addresses(model: mujoco.MjModel) -> dict:
    """The numbers of ADDRESSES, by the model's names."""
    roll = model.joint("roll")
    return {
        "body": model.body("body").id,
        "accelerometer": model.site("accelerometer").id,
        "roll_position": roll.qposadr[0],
        "roll_velocity": roll.dofadr[0],
        "roll_joint": roll.id,
        "bars": bars.addresses(model),
    }


@kernel
def step(world, mj, tables, system) -> None:
    """One call of the callback with the shipped controller."""
    sense(world, mj, tables, system)
    p = world.parameters
    own_reference(p.reference, p.unit, p.bars, world.later.reference, world.scratch.sensors, world.header.step)
    act(world, mj, tables, system)


@kernel
def sense(world, mj, tables, system) -> None:
    """Bring the world to MuJoCo's time and read the sensors."""
    begin(world, mj.time)
    p, now, later, out, h = world.parameters, world.now, world.later, world.out.rig, world.header.step
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
    sensors.time, sensors.step = mj.time, max(p.unit.sample_time, h)
    sensors.roll, sensors.roll_rate = out.body.roll, rate
    sensors.speed = NO_SPEED
    system.sense(p.system, now.system, sensors)


@kernel
def act(world, mj, tables, system) -> None:
    """Lateral force and stabilizers: write the forces of this step into MuJoCo."""
    p, now, later, out, h = world.parameters, world.now, world.later, world.out, world.header.step
    at, body = p.at, out.rig.body
    mj.xfrc_applied[6 * int(at.body) + 1] = -p.mass * body.lateral_acceleration
    twists = twists_now(at.bars, mj)
    front_asked, rear_asked = commanded(p.reference, later.reference, p.bars, twists)
    front, rear = stabilize(world, front_asked, rear_asked, twists, Moment(mj.time, h, NO_SPEED, p.unit), system)
    account(now.bars.front, later.bars.front, out.bars.front, twists.front, front, h)
    account(now.bars.rear, later.bars.rear, out.bars.rear, twists.rear, rear, h)
    apply(at.bars, mj, front, rear)
    check_finite(world, front + rear + body.roll + body.roll_rate, mj.time)


FRAME = Frame("roll_plane", PARAMETERS, STATE, Output, bars.Output, step, sense, act, addresses, ROLL_PLANE)
