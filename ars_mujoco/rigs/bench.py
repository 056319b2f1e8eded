"""The bench: the bar and its actuator alone, the bar's ends held or moved (the paper's own simulation)."""

import math

import numpy as np

from ars_mujoco.actuators.pump_controlled import stabilizers
from ars_mujoco.actuators.pump_controlled.axle import AxleOutput
from ars_mujoco.actuators.pump_controlled.drive_speed import DriveOutput
from ars_mujoco.actuators.pump_controlled.full_circuit import WORK
from ars_mujoco.actuators.pump_controlled.stabilizers import check_circuits, stabilize_both
from ars_mujoco.bridge.callback import SIGNATURE, fields, record_at, world_address
from ars_mujoco.bridge.world import begin, check_finite, layout_version, world_dtype
from ars_mujoco.excitation.excitation import EXCITATION, value
from ars_mujoco.kernels.kernel import NativeCallback, kernel
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

NAME = "bench"
NO_SPEED = 0.0  # m/s; the bench has no road


class Ends(Parameters):
    travel: float = channel("m", "travel of the bar's left end less that of its right")


class Output(Parameters):
    """What the bench records; its one axle is called front."""

    ends: Ends
    front: AxleOutput
    drive: DriveOutput


PARAMETERS = np.dtype(
    [
        ("stabilizers", stabilizers.PARAMETERS),
        ("command", EXCITATION),
        ("ends", EXCITATION),
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
    """One call of the callback: the ends' twist and the command drive the actuator; mocap bodies show the ends.

    Over the step the twist is held at its mean (Simpson's rule).
    """
    begin(world, mj.time)
    p, h = world.parameters, world.header.step
    travel = value(p.ends, mj.time)
    world.out.ends.travel = travel
    mj.mocap_pos[2], mj.mocap_pos[5] = p.ends_height + 0.5 * travel, p.ends_height - 0.5 * travel
    first, middle, last = (
        one_arm_twist(travel, p.arm),
        one_arm_twist(value(p.ends, mj.time + 0.5 * h), p.arm),
        one_arm_twist(value(p.ends, mj.time + h), p.arm),
    )
    held, now, later = (first + 4.0 * middle + last) / 6.0, world.now.stabilizers, world.later.stabilizers
    front, _ = stabilize_both(
        p.stabilizers, now, later, world.out.drive, world.out.front, world.scratch.rear, mj.time, h, NO_SPEED,
        parabola(p.command, mj.time, h), (0.0, 0.0, 0.0), (first, 0.0, held), (0.0, 0.0, 0.0), world.scratch.work,
    )  # fmt: skip
    # no rate was given, because the work of a known motion is counted here, even where it jumps
    later.front.work += work(p.stabilizers.front.stiffness, now.front.circuit.angle, first, held)
    later.front.work += work(p.stabilizers.front.stiffness, later.front.circuit.angle, held, last)
    check_circuits(world, p.stabilizers, world.later.stabilizers, mj.time)
    check_finite(world, front, mj.time)


@kernel
def one_arm_twist(travel: float, arm: float) -> float:
    """Twist (rad) of a bar whose ends are `travel` (m) apart in height: the paper's one-arm form (eq. 26)."""
    return math.asin(travel / arm)


@kernel
def work(stiffness: float, angle: float, start: float, end: float) -> float:
    """Work (J) of the bar on its ends while they twist it from `start` to `end` (rad), its motor at `angle` (rad)."""
    return stiffness * (angle - 0.5 * (start + end)) * (end - start)


@kernel
def parabola(command, time: float, step: float):
    """(c0, c1, c2) of an EXCITATION as c0 + c1 t + c2 t^2 over the step from `time` (s), through three samples.

    The outer two are taken a little inside the step, so that a jump at an end belongs to one step alone, although the
    times that MuJoCo adds up are not exactly those that a file states.
    """
    inside = 1e-6 * step
    first, middle, last = (
        value(command, time + inside),
        value(command, time + 0.5 * step),
        value(command, time + step - inside),
    )
    return first, (4.0 * middle - 3.0 * first - last) / step, 2.0 * (first - 2.0 * middle + last) / (step * step)


SIZE, VERSION = WORLD.itemsize // 8, layout_version(WORLD)
world_at = record_at(WORLD)


def _control(model, data):
    address = world_address(model, data, SIZE, VERSION)
    if address != 0:
        step(world_at(address), fields(data))


CALLBACK = NativeCallback(SIGNATURE, _control)
