"""The sedan: a full car on its tires, with a driver, sensors, the controller and both axles' stabilizers.

motion ─> sensors ─> reference ─> stabilizers ─> bar torques
   └────> driver  ─> steering, drive torques
   └────> tires   ─> forces at the contact patches
"""

import math

import mujoco
import numpy as np

from ars_mujoco.actuators import bars
from ars_mujoco.actuators.bars import account, apply, stabilize, twists_now
from ars_mujoco.actuators.system import Moment
from ars_mujoco.bridge.world import begin, check_finite
from ars_mujoco.control import reference
from ars_mujoco.control.reference import SensorOutput, commanded, own_reference, read_accelerometer
from ars_mujoco.driving.driver import Driver, DriverOutput, DriverState, drive, preview
from ars_mujoco.excitation.knots import SIGNAL, slope, value
from ars_mujoco.excitation.samples import SAMPLES, sampled
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.rigs.plots import SEDAN, SEDAN_EVENTS
from ars_mujoco.rigs.rig import Frame
from ars_mujoco.roads.bump import Bump, height_and_slope
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype
from ars_mujoco.tires.tire import Tire, TireOutput, TireState, tire

CORNERS = ("fl", "fr", "rl", "rr")
WALKING = 1.0  # m/s; below it a lateral acceleration asks for no tighter path


class BodyOutput(Parameters):
    roll: float = channel("rad", "roll of the body against the road plane, positive right side down")
    roll_rate: float = channel("rad/s", "its rate")
    pitch: float = channel("rad", "pitch, positive nose down")
    heave: float = channel("m", "height of the body's frame, which lies on the road at rest")
    lateral_acceleration: float = channel("m/s^2", "of the sprung centre of gravity, across the heading, left positive")
    yaw_rate: float = channel("rad/s", "yaw rate, positive to the left")
    speed: float = channel("m/s", "forward speed")
    sideslip: float = channel("rad", "direction of travel less heading")
    x: float = channel("m", "position")
    y: float = channel("m", "position")
    yaw: float = channel("rad", "heading")


class SuspensionOutput(Parameters):
    travel: float = channel("rad", "angle of the swing arm, positive in jounce")
    rate: float = channel("rad/s", "its rate")


class CornerOutput(Parameters):
    tire: TireOutput
    suspension: SuspensionOutput


class Output(Parameters):
    """What the sedan records."""

    body: BodyOutput
    sensor: SensorOutput
    driver: DriverOutput
    fl: CornerOutput
    fr: CornerOutput
    rl: CornerOutput
    rr: CornerOutput


# where things are in the model: numbers of bodies, degrees of freedom, joints, sites and controls
ADDRESSES = np.dtype(
    [
        ("body", "f8"),
        ("accelerometer", "f8"),
        ("wheel", "f8", 4),
        ("travel", "f8", 4),  # joint
        ("travel_position", "f8", 4),
        ("travel_velocity", "f8", 4),
        ("steer", "f8", 2),  # joint
        ("steer_velocity", "f8", 2),
        ("steer_control", "f8", 2),
        ("spin_velocity", "f8", 4),
        ("bars", bars.ADDRESSES),
    ]
)
PARAMETERS = [
    ("at", ADDRESSES),
    ("reference", reference.PARAMETERS),
    ("driver", record_dtype(Driver)),
    ("demand", SIGNAL),  # curvature of the path (1/m), lateral acceleration, or in open loop the steering angle
    ("demand_over_speed", "f8"),  # 1: the demand is a lateral acceleration (m/s^2), the path's at the wanted speed
    ("speed", SIGNAL),  # m/s
    ("front_tire", record_dtype(Tire)),
    ("rear_tire", record_dtype(Tire)),
    ("bump", record_dtype(Bump)),
    ("cg_height", "f8"),  # m, of the sprung centre of gravity in the body's frame
]
STATE = [
    ("reference", reference.STATE),
    ("driver", record_dtype(DriverState)),
    ("tires", record_dtype(TireState), 4),
    ("velocity", "f8", 2),  # of the sprung centre of gravity in the road plane one step ago, m/s
    ("running", "f8"),  # 1 once there is such a velocity
]
TABLES = [("demand", SAMPLES)]


def addresses(model: mujoco.MjModel) -> dict:
    """The numbers of ADDRESSES, by the model's names."""
    joints = [model.joint(f"{corner}_travel") for corner in CORNERS]
    steers = [model.joint(f"{corner}_steer") for corner in CORNERS[:2]]
    return {
        "body": model.body("body").id,
        "accelerometer": model.site("accelerometer").id,
        "wheel": [model.body(f"{corner}_wheel").id for corner in CORNERS],
        "travel": [joint.id for joint in joints],
        "travel_position": [joint.qposadr[0] for joint in joints],
        "travel_velocity": [joint.dofadr[0] for joint in joints],
        "steer": [joint.id for joint in steers],
        "steer_velocity": [joint.dofadr[0] for joint in steers],
        "steer_control": [model.actuator(f"{corner}_steer").id for corner in CORNERS[:2]],
        "spin_velocity": [model.joint(f"{corner}_spin").dofadr[0] for corner in CORNERS],
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
    sensors = world.scratch.sensors
    body = int(p.at.body)
    rates = _angular_velocity(mj, body)
    _observe_body(now, later, out.body, mj, body, rates, p.cg_height, h)
    site, place = 3 * int(p.at.accelerometer), 3 * body
    velocity = _velocity_at(
        mj, rates,
        mj.site_xpos[site] - mj.xpos[place],
        mj.site_xpos[site + 1] - mj.xpos[place + 1],
        mj.site_xpos[site + 2] - mj.xpos[place + 2],
    )  # fmt: skip
    left = (mj.xmat[9 * body + 1], mj.xmat[9 * body + 4], mj.xmat[9 * body + 7])
    out.sensor.lateral_acceleration = read_accelerometer(
        p.reference, now.reference, later.reference, sensors, velocity, left, 0.0, h
    )
    out.sensor.filtered = sensors.lateral_acceleration
    sensors.time, sensors.step = mj.time, max(p.unit.sample_time, h)
    sensors.roll, sensors.roll_rate = out.body.roll, out.body.roll_rate
    sensors.yaw_rate, sensors.speed, sensors.steer = out.body.yaw_rate, out.body.speed, now.driver.steer
    system.sense(p.system, now.system, sensors)


@kernel
def act(world, mj, tables, system) -> None:
    """Driver, tires and stabilizers: write the forces of this step into MuJoCo."""
    p, now, later, out, h = world.parameters, world.now, world.later, world.out.rig, world.header.step
    at, body = p.at, out.body
    speed = value(p.speed, mj.time)
    steer, front_torque, rear_torque = drive(
        p.driver, now.driver, later.driver, out.driver, h,
        _demand(p, tables, mj.time), _demand(p, tables, mj.time + preview(p.driver, body.speed)),
        speed, slope(p.speed, mj.time), body.speed, body.yaw_rate, body.yaw + body.sideslip,
    )  # fmt: skip
    rates = _angular_velocity(mj, int(at.body))
    for i in range(2):
        mj.ctrl[int(at.steer_control[i])] = steer
        mj.qfrc_applied[int(at.spin_velocity[i])] = 0.5 * front_torque
        mj.qfrc_applied[int(at.spin_velocity[2 + i])] = 0.5 * rear_torque
    total = _corner(p, p.front_tire, now, later, out.fl, mj, rates, 0, h)
    total += _corner(p, p.front_tire, now, later, out.fr, mj, rates, 1, h)
    total += _corner(p, p.rear_tire, now, later, out.rl, mj, rates, 2, h)
    total += _corner(p, p.rear_tire, now, later, out.rr, mj, rates, 3, h)

    twists = twists_now(at.bars, mj)
    front_asked, rear_asked = commanded(p.reference, later.reference, p.bars, twists)
    front, rear = stabilize(world, front_asked, rear_asked, twists, Moment(mj.time, h, body.speed, p.unit), system)
    account(now.bars.front, later.bars.front, world.out.bars.front, twists.front, front, h)
    account(now.bars.rear, later.bars.rear, world.out.bars.rear, twists.rear, rear, h)
    apply(at.bars, mj, front, rear)
    driver = steer + front_torque + rear_torque + out.driver.course_error + later.driver.trim
    check_finite(world, total + front + rear + driver, mj.time)


@kernel
def _demand(p, tables, time):
    # what the driver is asked for: curvature (1/m), or in open loop the steering angle (rad); samples come first
    demand = sampled(tables.demand, time) if tables.demand.count > 0.0 else value(p.demand, time)
    return demand / max(value(p.speed, time), WALKING) ** 2 if p.demand_over_speed == 1.0 else demand


@kernel
def _observe_body(now, later, body, mj, index, rates, cg_height, h):
    # heading, roll and pitch of the frame (x forward, y left, z up) from its rotation matrix
    m, x = 9 * index, 3 * index
    body.yaw = math.atan2(mj.xmat[m + 3], mj.xmat[m])
    body.roll = math.atan2(mj.xmat[m + 7], mj.xmat[m + 8])
    body.pitch = -math.asin(min(max(mj.xmat[m + 6], -1.0), 1.0))
    body.x, body.y, body.heave = mj.xpos[x], mj.xpos[x + 1], mj.xpos[x + 2]
    body.roll_rate, body.yaw_rate = mj.qvel[3], rates[2]
    cos, sin = math.cos(body.yaw), math.sin(body.yaw)
    forward, left = cos * mj.qvel[0] + sin * mj.qvel[1], cos * mj.qvel[1] - sin * mj.qvel[0]
    body.speed, body.sideslip = forward, math.atan2(left, max(abs(forward), 1.0))
    rx, ry, rz = cg_height * mj.xmat[m + 2], cg_height * mj.xmat[m + 5], cg_height * mj.xmat[m + 8]
    vx, vy, _ = _velocity_at(mj, rates, rx, ry, rz)
    body.lateral_acceleration = now.running / h * (cos * (vy - now.velocity[1]) - sin * (vx - now.velocity[0]))
    later.velocity[0], later.velocity[1], later.running = vx, vy, 1.0


@kernel
def _angular_velocity(mj, body):
    # of the body in world axes; a free joint's is in the body's own
    m = 9 * body
    wx, wy, wz = mj.qvel[3], mj.qvel[4], mj.qvel[5]
    return (
        mj.xmat[m] * wx + mj.xmat[m + 1] * wy + mj.xmat[m + 2] * wz,
        mj.xmat[m + 3] * wx + mj.xmat[m + 4] * wy + mj.xmat[m + 5] * wz,
        mj.xmat[m + 6] * wx + mj.xmat[m + 7] * wy + mj.xmat[m + 8] * wz,
    )


@kernel
def _velocity_at(mj, rates, rx, ry, rz):
    # of a point of the body at r from its frame
    wx, wy, wz = rates
    return (
        mj.qvel[0] + wy * rz - wz * ry,
        mj.qvel[1] + wz * rx - wx * rz,
        mj.qvel[2] + wx * ry - wy * rx,
    )


@kernel
def _corner(p, settings, now, later, out, mj, rates, i, h):
    # motion of the wheel's centre from body, swing arm and steering; the tire's force back onto the wheel
    at = p.at
    wheel, joint = int(at.wheel[i]), int(at.travel[i])
    w, j, b = 3 * wheel, 3 * joint, 3 * int(at.body)
    px, py, pz = mj.xpos[w], mj.xpos[w + 1], mj.xpos[w + 2]
    vx, vy, vz = _velocity_at(mj, rates, px - mj.xpos[b], py - mj.xpos[b + 1], pz - mj.xpos[b + 2])
    swing = mj.qvel[int(at.travel_velocity[i])]
    ax, ay, az = swing * mj.xaxis[j], swing * mj.xaxis[j + 1], swing * mj.xaxis[j + 2]
    rx, ry, rz = px - mj.xanchor[j], py - mj.xanchor[j + 1], pz - mj.xanchor[j + 2]
    vx, vy, vz = vx + ay * rz - az * ry, vy + az * rx - ax * rz, vz + ax * ry - ay * rx
    wx, wy, wz = rates[0] + ax, rates[1] + ay, rates[2] + az
    if i < 2:  # the steer axis goes through the wheel's centre
        s, turning = 3 * int(at.steer[i]), mj.qvel[int(at.steer_velocity[i])]
        wx, wy, wz = wx + turning * mj.xaxis[s], wy + turning * mj.xaxis[s + 1], wz + turning * mj.xaxis[s + 2]
    height, slope_x, slope_y = height_and_slope(p.bump, px, py)
    fx, fy, fz, tx, ty, tz = tire(
        settings, now.tires[i], later.tires[i], out.tire, h, px, py, pz,
        mj.xmat[9 * wheel + 1], mj.xmat[9 * wheel + 4], mj.xmat[9 * wheel + 7],
        vx, vy, vz, wx, wy, wz, mj.qvel[int(at.spin_velocity[i])], height, slope_x, slope_y,
    )  # fmt: skip
    f = 6 * wheel
    mj.xfrc_applied[f], mj.xfrc_applied[f + 1], mj.xfrc_applied[f + 2] = fx, fy, fz
    mj.xfrc_applied[f + 3], mj.xfrc_applied[f + 4], mj.xfrc_applied[f + 5] = tx, ty, tz
    out.suspension.travel, out.suspension.rate = mj.qpos[int(at.travel_position[i])], swing
    return fx + fy + fz


FRAME = Frame("sedan", PARAMETERS, STATE, Output, bars.Output, step, sense, act, addresses, SEDAN, SEDAN_EVENTS, TABLES)
