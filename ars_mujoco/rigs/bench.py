"""The bench: the bar and its actuator alone, the bar's ends held or moved (the paper's own simulation)."""

import math

import numpy as np

from ars_mujoco.actuators.axle import AxleOutput
from ars_mujoco.callback import SIGNATURE, fields, record_at, world_address
from ars_mujoco.channels import Signal
from ars_mujoco.hydraulics.detailed_circuit import WORK
from ars_mujoco.kernel import NativeCallback, kernel
from ars_mujoco.parameters import Parameters, record_dtype
from ars_mujoco.rigs import stabilizers
from ars_mujoco.rigs.stabilizers import check_circuits, stabilize_both
from ars_mujoco.signal import SIGNAL, slope, value
from ars_mujoco.world import begin, check_finite, layout_version, world_dtype

NAME = "bench"


class Ends(Parameters):
    travel: Signal("m", "travel of the bar's left end less that of its right")


class Output(Parameters):
    """What the bench records; its one axle is called front."""

    ends: Ends
    front: AxleOutput


PARAMETERS = np.dtype(
    [
        ("stabilizers", stabilizers.PARAMETERS),
        ("command", SIGNAL),
        ("ends", SIGNAL),
        ("arm", "f8"),
        ("ends_height", "f8"),
    ]
)
WORLD = world_dtype(
    PARAMETERS,
    np.dtype([("stabilizers", stabilizers.STATE)]),
    record_dtype(Output),
    np.dtype([("rear", record_dtype(AxleOutput)), ("work", WORK)]),
)


@kernel
def step(world, mj) -> None:
    """One call of the callback: the ends' twist and the command drive the actuator; mocap bodies show the ends."""
    begin(world, mj.time)
    p, h = world.parameters, world.header.step
    travel, rate = value(p.ends, mj.time), slope(p.ends, mj.time)
    world.out.ends.travel = travel
    mj.mocap_pos[2], mj.mocap_pos[5] = p.ends_height + 0.5 * travel, p.ends_height - 0.5 * travel
    # the ends' motion is given, so the twist to hold is that of the middle of the step
    twist_rate = rate / (p.arm * math.sqrt(1.0 - (travel / p.arm) ** 2))
    twist = (one_arm_twist(travel, p.arm), twist_rate, one_arm_twist(value(p.ends, mj.time + 0.5 * h), p.arm))
    front, _ = stabilize_both(
        p.stabilizers, world.now.stabilizers, world.later.stabilizers, world.out.front, world.scratch.rear,
        mj.time, h, parabola(p.command, mj.time, h), (0.0, 0.0, 0.0), twist, (0.0, 0.0, 0.0),
        world.scratch.work,
    )  # fmt: skip
    check_circuits(world, p.stabilizers, world.later.stabilizers, mj.time)
    check_finite(world, front, mj.time)


@kernel
def one_arm_twist(travel: float, arm: float) -> float:
    """Twist (rad) of a bar whose ends are `travel` (m) apart in height: the paper's one-arm form (eq. 26)."""
    return math.asin(travel / arm)


@kernel
def parabola(signal, time: float, step: float):
    """(c0, c1, c2) of `signal` as c0 + c1 t + c2 t^2 over the step from `time` (s), through three samples.

    The outer two are taken a little inside the step, so that a jump at an end belongs to one step alone, although the
    times that MuJoCo adds up are not exactly those that a file states.
    """
    inside = 1e-6 * step
    first, middle, last = (
        value(signal, time + inside),
        value(signal, time + 0.5 * step),
        value(signal, time + step - inside),
    )
    return first, (4.0 * middle - 3.0 * first - last) / step, 2.0 * (first - 2.0 * middle + last) / (step * step)


SIZE, VERSION = WORLD.itemsize // 8, layout_version(WORLD)
world_at = record_at(WORLD)


def _control(model, data):
    address = world_address(model, data, SIZE, VERSION)
    if address != 0:
        step(world_at(address), fields(data))


CALLBACK = NativeCallback(SIGNATURE, _control)
