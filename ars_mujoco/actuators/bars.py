"""Bars: both stabilizer bars of a car, whatever system stands between their halves.

Signs: twist = left arm's angle less the right's (each positive in jounce); positive bar angle and torque push the body
to negative roll, so the torque acts +M on the left half and -M on the right half.

A system is integrated over the coming step with the twist held, and its mean torque acts on the car over that same
step. The work of a step on the car is torque times the mean of the twist rates at its two ends, so it is known only at
the next call.
"""

import mujoco
import numpy as np

from ars_mujoco.actuators.system import Command, Twist, Twists
from ars_mujoco.bridge.world import BURST, stop
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import channel, done
from ars_mujoco.schema.parameters import Parameters

JOINTS = ("front_bar_left", "front_bar_right", "rear_bar_left", "rear_bar_right")
ADDRESSES = np.dtype([("position", "f8", 4), ("velocity", "f8", 4)])

STIFFNESS = np.dtype([("front", "f8"), ("rear", "f8")])  # Nm/rad, torsion of the split bars
BAR = np.dtype([("torque", "f8"), ("twist_rate", "f8"), ("work", "f8")])  # of the last step; work up to its start
STATE = np.dtype([("front", BAR), ("rear", BAR)])


class BarOutput(Parameters):
    twist: float = channel(
        "rad", "angle of the left arm less that of the right, positive with the left wheel in jounce"
    )
    torque: float = channel(
        "Nm", "torque of the bar, positive pushes the body to negative roll; mean over the coming step"
    )


class WorkOutput(Parameters):
    work: float = done("work of the bar on the car")


class AxleOutput(Parameters):
    bar: BarOutput
    energy: WorkOutput


class Output(Parameters):
    """What the bars of a car record."""

    front: AxleOutput
    rear: AxleOutput


class BenchOutput(Parameters):
    """What the bench records; its one bar is called front."""

    front: AxleOutput


@kernel
def stabilize(world, front, rear, twists, moment, system):
    """Advance the system by a step; return the bars' torques (front, rear), Nm.

    `front` and `rear` are the BarCommands that the control unit gives now, `twists` are Twists, `moment` is a Moment.
    """
    p, now, later, scratch = world.parameters, world.now, world.later, world.scratch
    front, rear = system.arrive(moment.unit, now.delay, later.delay, front, rear, moment.step)
    system.read_inputs(p.inputs, scratch.inputs, moment.time)
    torques = system.advance(
        p.system, now.system, later.system, world.out.system, scratch.work,
        Command(front, rear, scratch.inputs), twists, moment,
    )  # fmt: skip
    if system.is_beyond(p.system, later.system):
        stop(world, BURST, moment.time)
    return torques


@kernel
def account(now, later, out, twist, torque: float, step: float) -> None:
    """Record a bar's twist and torque, and the work of the step before, which is known now."""
    work = now.work + now.torque * step * 0.5 * (now.twist_rate + twist.rate)
    out.energy.work, out.bar.twist, out.bar.torque = work, twist.angle, torque
    later.work, later.torque, later.twist_rate = work, torque, twist.rate


def addresses(model: mujoco.MjModel) -> dict:
    """The numbers of ADDRESSES, by the model's names."""
    joints = [model.joint(name) for name in JOINTS]
    return {"position": [j.qposadr[0] for j in joints], "velocity": [j.dofadr[0] for j in joints]}


@kernel
def twists_now(at, mj):
    """Twists of both bars; a car's is held as it is now: MuJoCo's semi-implicit step, too, takes its springs at the
    start of the step.
    """
    return Twists(_twist(at, mj, 0), _twist(at, mj, 2))


@kernel
def _twist(at, mj, left):
    # of the bar whose left half is number `left` of JOINTS
    angle = mj.qpos[int(at.position[left])] - mj.qpos[int(at.position[left + 1])]
    rate = mj.qvel[int(at.velocity[left])] - mj.qvel[int(at.velocity[left + 1])]
    return Twist(angle, rate, angle)


@kernel
def apply(at, mj, front: float, rear: float) -> None:
    """Put the bars' torques (Nm) on their halves' hinges: +M left, -M right."""
    mj.qfrc_applied[int(at.velocity[0])], mj.qfrc_applied[int(at.velocity[1])] = front, -front
    mj.qfrc_applied[int(at.velocity[2])], mj.qfrc_applied[int(at.velocity[3])] = rear, -rear
