"""Control unit: a computer that samples, and whose output comes late.

With a sample time of zero the unit is continuous: its outer loop lives inside the circuit's substeps, and the
delay acts on the commanded angle. With a sample time the whole outer loop is sampled, and the delay acts on the
stroke command.
"""

import numpy as np

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, quantity

SLOTS = 64  # physics steps the delay line holds

DELAY_LINE = np.dtype([("head", "f8"), ("front", "f8", SLOTS), ("rear", "f8", SLOTS)])


class ControlUnit(Parameters):
    """Timing of the control unit; both times are whole multiples of the physics step."""

    sample_time: float = quantity("s", ge=0)  # 0: continuous
    delay: float = quantity("s", ge=0)  # from reading the sensors to the actuator seeing the command


@kernel
def samples_now(unit, time: float, step: float) -> bool:
    """Whether the unit computes a new output in the physics step that begins at `time` (s)."""
    period = max(round(unit.sample_time / step), 1)
    return round(time / step) % period == 0


@kernel
def delayed(unit, line, front: float, rear: float, step: float):
    """Push this step's output into the delay line, and return what leaves it `unit.delay` later."""
    head = int(line.head)
    line.front[head], line.rear[head] = front, rear
    line.head = float((head + 1) % SLOTS)
    tail = (head - round(unit.delay / step)) % SLOTS
    return line.front[tail], line.rear[tail]


def check_timing(unit: ControlUnit, step: float) -> None:
    """Refuse times that are not multiples of the physics step (s), or a delay longer than the delay line."""
    for name in ("sample_time", "delay"):
        value = getattr(unit, name)
        if abs(value / step - round(value / step)) > 1e-6:
            raise InputError(f"unit.{name}: {value:g} s is not a whole multiple of the time step {step:g} s")
    if round(unit.delay / step) >= SLOTS:
        raise InputError(f"unit.delay: {unit.delay:g} s is too long; allowed: less than {SLOTS * step:g} s")
