"""Pump-controlled: a swash-plate pump and a vane motor between the halves of each bar, both pumps on one drive.

Its stages have layouts of their own, so that the simplest carries nothing of the most detailed.
"""

from types import ModuleType

from ars_mujoco.actuators.pump_controlled import cylinder_stage, full_stage, third_order_stage
from ars_mujoco.actuators.pump_controlled.file import File, PumpControlled, is_full, is_third_order, released
from ars_mujoco.actuators.pump_controlled.sizing import SIZING
from ars_mujoco.actuators.pump_controlled.third_order_stage import FOLLOWS, NAME


def held_at(file: PumpControlled) -> dict[str, float]:
    """The angle (rad) of each bar that a command beyond it is held at."""
    return dict.fromkeys(("front", "rear"), file.control.loop.max_angle)


def variant(file: PumpControlled) -> ModuleType:
    """The stage that runs `file`."""
    if is_third_order(file):
        return third_order_stage
    return full_stage if is_full(file) else cylinder_stage
