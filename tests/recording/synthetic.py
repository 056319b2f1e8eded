"""A made-up run of the sedan through an S-curve: nothing is simulated, every signal is a formula of time.

A left curve from 2 s, a reversal at half time, straight again 2 s before the end; the roll is `gradient` times a_y.
"""

from importlib.resources import files
from pathlib import Path

import mujoco
import numpy as np

import ars_mujoco
from ars_mujoco.recording.recording import Event, Recording, scene_of
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.plots import Plot, Tab, axles

SEDAN = Path(str(files(ars_mujoco))).parent / "mjcf" / "sedan" / "sedan.xml"
SPEED = 120 / 3.6
STEP, FRAME = 0.001, 0.010
RADIUS = 0.32
CORNERS, AXLES = ("fl", "fr", "rl", "rr"), ("front", "rear")
TABS = (
    Tab("body", (Plot("roll", ("body.roll",)), Plot("yaw rate", ("body.yaw_rate",)))),
    Tab("front axle", (Plot("bar angle", ("front.bar.command", "front.bar.angle", "front.bar.twist")),)),
    Tab("energy", (Plot("power", axles("pump.shaft_power", "motor.output_power")),)),
    Tab("tires", (Plot("tire vertical force", tuple(f"{corner}.tire.vertical_force" for corner in CORNERS)),)),
)
ROLES = {"shaft": "drawn", "recovered": "counted", "friction": "lost"}  # of some energies


def s_curve(gradient: float = 0.10, duration: float = 24.0, title: str = "synthetic S-curve") -> Recording:
    """A run of `duration` s with `gradient` rad of roll a g; about 110 channels at 1 kHz, poses at 100 Hz."""
    time = np.arange(round(duration / STEP) + 1) * STEP
    ramp = np.clip(time - 2, 0, 1) - 2 * np.clip(time - duration / 2, 0, 1) + np.clip(time - duration + 3, 0, 1)
    signals = _signals(time, 0.6 * ramp, gradient)
    model = mujoco.MjModel.from_xml_path(str(SEDAN))
    frames = slice(None, None, round(FRAME / STEP))
    return Recording(
        title=title,
        channels={name: _channel(name, unit) for name, (unit, _) in signals.items()},
        tabs=TABS,
        time=time,
        values=np.column_stack([values for _, values in signals.values()]),
        bodies=[model.body(i).name for i in range(1, model.nbody)],
        scene=scene_of(model),
        pose_time=time[frames],
        poses=_poses(model, {name: values[frames] for name, (_, values) in signals.items()}),
        events=[
            Event(2.0, "INFO", "left curve"),
            Event(duration / 2, "WARN", "reversal"),
            Event(duration - 3, "INFO", "straight"),
        ],
        inputs={"cycle": "s_curve", "actuators": {"front": "made up", "rear": "made up"}},
        metrics={"peak_roll": {"value": float(np.degrees(0.6 * gradient)), "unit": "deg"}},
    )


def _channel(name: str, unit: str) -> Channel:
    return Channel(name, unit, f"made-up {name}", ROLES.get(name.rpartition(".energy.")[2]))


def _signals(time: np.ndarray, g: np.ndarray, gradient: float) -> dict[str, tuple[str, np.ndarray]]:
    acceleration = 9.81 * g
    yaw_rate = acceleration / SPEED
    yaw = np.cumsum(yaw_rate) * STEP
    roll = gradient * g
    zero = 0 * time
    signals = {
        "body.roll": ("rad", roll),
        "body.roll_rate": ("rad/s", np.gradient(roll, STEP)),
        "body.pitch": ("rad", zero),
        "body.heave": ("m", 0.002 * np.sin(8 * time)),
        "body.lateral_acceleration": ("m/s^2", acceleration),
        "body.yaw_rate": ("rad/s", yaw_rate),
        "body.speed": ("m/s", zero + SPEED),
        "body.x": ("m", np.cumsum(np.cos(yaw)) * SPEED * STEP),
        "body.y": ("m", np.cumsum(np.sin(yaw)) * SPEED * STEP),
        "body.yaw": ("rad", yaw),
        "body.sideslip": ("rad", -0.01 * g),
        "driver.steer": ("rad", 0.05 * g),
        "driver.curvature_command": ("1/m", yaw_rate / SPEED),
        "sensor.lateral_acceleration": ("m/s^2", acceleration + 9.81 * roll),
    }
    for axle in AXLES:
        signals |= {f"{axle}.{name}": entry for name, entry in _axle(time, g, axle).items()}
    for corner in CORNERS:
        signals |= {f"{corner}.{name}": entry for name, entry in _corner(time, g, roll, corner).items()}
    return signals


def _axle(time: np.ndarray, g: np.ndarray, axle: str) -> dict[str, tuple[str, np.ndarray]]:
    share = 0.6 if axle == "front" else 0.4
    angle, torque = 0.35 * share * g, 1500 * share * g
    rate = np.gradient(angle, STEP)
    zero, power = 0 * time, torque * rate
    powers = ["motor.leakage_power", "motor.friction_power", "pump.loss_power", "pump.leakage_power", "relief.power"]
    energies = "recovered pump_torque_loss pump_leakage motor_leakage relief friction charge motor throughput"
    return {
        "bar.angle": ("rad", angle),
        "bar.command": ("rad", 1.02 * angle),
        "bar.twist": ("rad", 0.3 * angle),
        "bar.torque": ("Nm", torque),
        "motor.pressure": ("Pa", 1e5 * torque / 8),
        "motor.rate": ("rad/s", rate),
        "motor.output_power": ("W", power),
        "pump.stroke": ("1", rate),
        "pump.stroke_command": ("1", rate),
        "pump.flow": ("m^3/s", 1e-4 * rate),
        "pump.shaft_power": ("W", 1.2 * np.abs(power) + 40),
        **{name: ("W", 20 + 0.05 * np.abs(power)) for name in powers},
        "energy.shaft": ("J", np.cumsum(1.2 * np.abs(power) + 40) * STEP),
        **{f"energy.{name}": ("J", zero + time) for name in energies.split()},
    }


def _corner(time: np.ndarray, g: np.ndarray, roll: np.ndarray, corner: str) -> dict[str, tuple[str, np.ndarray]]:
    left, front = corner[1] == "l", corner[0] == "f"
    load = (4039 if front else 3897) + 2000 * g * (-1 if left else 1)
    travel = roll * 0.78 * (-1 if left else 1)
    return {
        "tire.vertical_force": ("N", load),
        "tire.lateral_force": ("N", load * g),
        "tire.longitudinal_force": ("N", 0 * time + (0 if front else 150)),
        "tire.slip_angle": ("rad", 0.05 * g),
        "tire.slip_ratio": ("1", 0 * time),
        "tire.camber": ("rad", 0.3 * roll),
        "suspension.travel": ("m", travel),
        "suspension.rate": ("m/s", np.gradient(travel, STEP)),
    }


def _poses(model: mujoco.MjModel, at: dict[str, np.ndarray]) -> np.ndarray:
    data = mujoco.MjData(model)
    poses = np.empty((len(at["body.x"]), model.nbody - 1, 7))
    for frame, pose in enumerate(poses):
        now = {name: values[frame] for name, values in at.items()}
        _place(model, data, now, spin=SPEED * frame * FRAME / RADIUS)
        mujoco.mj_kinematics(model, data)
        pose[:, :3], pose[:, 3:] = data.xpos[1:], data.xquat[1:]
    return poses


def _place(model: mujoco.MjModel, data: mujoco.MjData, now: dict[str, float], spin: float) -> None:
    yaw, roll = now["body.yaw"], now["body.roll"]
    turn = np.empty(4)
    mujoco.mju_mulQuat(
        turn, np.array((np.cos(yaw / 2), 0, 0, np.sin(yaw / 2))), np.array((np.cos(roll / 2), np.sin(roll / 2), 0, 0))
    )
    data.qpos[:7] = now["body.x"], now["body.y"], now["body.heave"], *turn
    angles = {f"{corner}_spin": spin for corner in CORNERS}
    angles |= {f"{corner}_travel": now[f"{corner}.suspension.travel"] / 1.11 for corner in CORNERS}
    angles |= {"fl_steer": now["driver.steer"], "fr_steer": now["driver.steer"]}
    for axle in AXLES:
        for side, sign in (("left", 1), ("right", -1)):
            angles[f"{axle}_bar_{side}"] = sign * now[f"{axle}.bar.angle"] / 2
    for joint, angle in angles.items():
        data.qpos[model.joint(joint).qposadr[0]] = angle
