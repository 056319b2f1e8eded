"""The bench: the bar and its actuator alone, the bar's ends held or moved (the paper's own simulation)."""

import math

from ars_mujoco.actuators.bars import BenchOutput, account, stabilize
from ars_mujoco.actuators.system import Moment, Twist, Twists
from ars_mujoco.bridge.world import begin, check_finite
from ars_mujoco.control.control_unit import by_angle
from ars_mujoco.excitation.excitation import EXCITATION, value
from ars_mujoco.excitation.samples import SAMPLES
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.rigs.plots import BENCH
from ars_mujoco.rigs.rig import Frame
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters

NO_SPEED = 0.0  # m/s; the bench has no road


class Ends(Parameters):
    travel: float = channel("m", "travel of the bar's left end less that of its right")


class Output(Parameters):
    """What the bench records; its one bar is called front."""

    ends: Ends


PARAMETERS = [("command", EXCITATION), ("ends", EXCITATION), ("arm", "f8"), ("ends_height", "f8")]
TABLES = [("command", SAMPLES), ("ends", SAMPLES)]


@kernel
def step(world, mj, tables, system) -> None:
    """One call of the callback: the ends' twist and the command drive the actuator; mocap bodies show the ends.

    Over the step the twist is held at its mean (Simpson's rule).
    """
    begin(world, mj.time)
    p, now, later, h = world.parameters, world.now, world.later, world.header.step
    travel = value(p.ends, tables.ends, mj.time)
    world.out.rig.ends.travel = travel
    mj.mocap_pos[2], mj.mocap_pos[5] = p.ends_height + 0.5 * travel, p.ends_height - 0.5 * travel
    first, middle, last = (
        one_arm_twist(travel, p.arm),
        one_arm_twist(value(p.ends, tables.ends, mj.time + 0.5 * h), p.arm),
        one_arm_twist(value(p.ends, tables.ends, mj.time + h), p.arm),
    )
    held, stiffness, sensors = (first + 4.0 * middle + last) / 6.0, p.bars.front, world.scratch.sensors
    twists = Twists(Twist(first, 0.0, held), Twist(0.0, 0.0, 0.0))
    front = by_angle(stiffness, parabola(p.command, tables.command, mj.time, h), held)
    idle = by_angle(0.0, (0.0, 0.0, 0.0), 0.0)
    torque, _ = stabilize(world, front, idle, twists, Moment(mj.time, h, NO_SPEED, p.unit), system)
    # no rate was given, because the work of a known motion is counted here, even where it jumps
    account(now.bars.front, later.bars.front, world.out.bars.front, twists.front, torque, h)
    system.sense(p.system, now.system, sensors)
    later.bars.front.work += work(stiffness, sensors.front_angle, first, held)
    system.sense(p.system, later.system, sensors)
    later.bars.front.work += work(stiffness, sensors.front_angle, held, last)
    check_finite(world, torque, mj.time)


@kernel
def one_arm_twist(travel: float, arm: float) -> float:
    """Twist (rad) of a bar whose ends are `travel` (m) apart in height: the paper's one-arm form (eq. 26)."""
    return math.asin(travel / arm)


@kernel
def work(stiffness: float, angle: float, start: float, end: float) -> float:
    """Work (J) of the bar on its ends while they twist it from `start` to `end` (rad), its motor at `angle` (rad)."""
    return stiffness * (angle - 0.5 * (start + end)) * (end - start)


@kernel
def parabola(command, samples, time: float, step: float):
    """(c0, c1, c2) of an EXCITATION as c0 + c1 t + c2 t^2 over the step from `time` (s), through three samples.

    The outer two are taken a little inside the step, so that a jump at an end belongs to one step alone, although the
    times that MuJoCo adds up are not exactly those that a file states.
    """
    inside = 1e-6 * step
    first, middle, last = (
        value(command, samples, time + inside),
        value(command, samples, time + 0.5 * step),
        value(command, samples, time + step - inside),
    )
    return first, (4.0 * middle - 3.0 * first - last) / step, 2.0 * (first - 2.0 * middle + last) / (step * step)


FRAME = Frame("bench", PARAMETERS, [], Output, BenchOutput, step, plots=BENCH, tables=TABLES)
