"""Control unit: a computer that samples, and whose output comes late.

The delay acts on what leaves the unit: the commands of the bars, or what a loop makes of them that runs in the unit
itself. With a sample time of zero the unit is continuous.
"""

from collections import namedtuple

import numpy as np

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, quantity

# what a bar is asked for over the step: `angle` (c0, c1, c2), c0 + c1 t + c2 t^2 in rad since its start; `torque` in Nm
BarCommand = namedtuple("BarCommand", "angle torque")
NOTHING_ASKED = BarCommand((0.0, 0.0, 0.0), 0.0)

SLOTS = 64  # physics steps the delay line holds

DELAY_LINE = np.dtype([("head", "f8"), ("front", "f8", SLOTS), ("rear", "f8", SLOTS)])
COMMAND_LINE = np.dtype([("head", "f8"), ("values", "f8", (4, SLOTS))])  # angles and torques, front and rear


class ControlUnit(Parameters):
    """Timing of the control unit; both times are whole multiples of the physics step."""

    sample_time: float = quantity("s", ge=0)  # 0: continuous
    delay: float = quantity("s", ge=0)  # from reading the sensors to the actuator seeing the command


@kernel
def by_angle(stiffness: float, angle, twist: float):
    """The BarCommand of a commanded angle (c0, c1, c2); the torque is that of the bar's torsion (Nm/rad) at a twist."""
    return BarCommand(angle, stiffness * (angle[0] - twist))


@kernel
def by_torque(stiffness: float, torque: float, twist: float):
    """The BarCommand of a commanded torque (Nm); the angle is the one at which the bar's torsion gives it."""
    return BarCommand((twist + torque / stiffness, 0.0, 0.0), torque)


@kernel
def samples_now(unit, time: float, step: float) -> bool:
    """Whether the unit computes a new output in the physics step that begins at `time` (s)."""
    period = max(round(unit.sample_time / step), 1)
    return round(time / step) % period == 0


@kernel
def delayed(unit, line, front: float, rear: float, step: float):
    """Push this step's output into the delay line, and return what leaves it `unit.delay` later."""
    head, tail = _move_on(unit, line, step)
    line.front[head], line.rear[head] = front, rear
    return line.front[tail], line.rear[tail]


@kernel
def arrive_now(unit, now, later, front, rear, step: float):
    """The BarCommands as they are: of a system that needs none, or whose own loop runs in the unit."""
    return front, rear


@kernel
def arrive_late(unit, now, later, front, rear, step: float):
    """The BarCommands of `unit.delay` before; `now` and `later` are COMMAND_LINE records."""
    if unit.delay == 0.0:
        return front, rear
    later.values[:], later.head = now.values, now.head
    (head, tail), line = _move_on(unit, later, step), later.values
    line[0, head], line[1, head] = front.angle[0], rear.angle[0]
    line[2, head], line[3, head] = front.torque, rear.torque
    return (
        BarCommand((line[0, tail], 0.0, 0.0), line[2, tail]),
        BarCommand((line[1, tail], 0.0, 0.0), line[3, tail]),
    )


@kernel
def _move_on(unit, line, step: float):
    # a delay line by one step: (slot of what enters it, slot of what leaves it)
    head = int(line.head)
    line.head = float((head + 1) % SLOTS)
    return head, (head - round(unit.delay / step)) % SLOTS


def check_timing(unit: ControlUnit, step: float) -> None:
    """Refuse times that are not multiples of the physics step (s), or a delay longer than the delay line."""
    for name in ("sample_time", "delay"):
        value = getattr(unit, name)
        if abs(value / step - round(value / step)) > 1e-6:
            raise InputError(f"unit.{name}: {value:g} s is not a whole multiple of the time step {step:g} s")
    if round(unit.delay / step) >= SLOTS:
        raise InputError(f"unit.delay: {unit.delay:g} s is too long; allowed: less than {SLOTS * step:g} s")
