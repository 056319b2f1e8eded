"""Controllers: what a user can choose or write, read from a file."""

from typing import ClassVar

from ars_mujoco.control.accelerometer import Accelerometer
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.control.roll_trim import RollTrim
from ars_mujoco.control.speed_fade import SpeedFade
from ars_mujoco.control.target import Target
from ars_mujoco.schema.parameters import Parameters, number


class Reference(Parameters):
    """From the accelerometer to the bar angles, by a target for the roll."""

    accelerometer: Accelerometer
    target: Target  # roll over lateral acceleration
    fade: SpeedFade
    front_share: float = number(gt=0, lt=1)  # of the bars' torque
    trim: RollTrim


class Controller(Parameters):
    """Reference (not on the bench, whose cycle commands the bar) and control unit: all that is above the actuator.

    `law` names a Python file whose function `command(sensors, memory)` takes the place of the target map.
    """

    MOVED: ClassVar[dict[str, str]] = {
        name: f"an actuator has its own loops; in its file, control.{name}, or --set actuator.control.{name}"
        for name in ("loop", "pressure_feedback", "compensator")
    }

    reference: Reference | None = None
    unit: ControlUnit
    law: str | None = None
