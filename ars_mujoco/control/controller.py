"""Controllers: what a user can choose or write, read from a file."""

from ars_mujoco.control.accelerometer import Accelerometer
from ars_mujoco.control.bar_angle_loop import BarAngleLoop
from ars_mujoco.control.control_unit import ControlUnit
from ars_mujoco.control.roll_trim import RollTrim
from ars_mujoco.control.speed_fade import SpeedFade
from ars_mujoco.control.target import Target
from ars_mujoco.parameters import Number, Parameters


class Reference(Parameters):
    """From the accelerometer to the bar angles, by a target for the roll."""

    accelerometer: Accelerometer
    target: Target  # roll over lateral acceleration
    fade: SpeedFade
    front_share: Number(gt=0, lt=1)  # of the bars' torque
    trim: RollTrim


class Controller(Parameters):
    """The cascade: reference (not on the bench, whose cycle commands the bar's angle), unit and outer loop.

    `law` names a Python file whose function `command(sensors, memory)` takes the place of the target map.
    """

    reference: Reference | None = None
    unit: ControlUnit
    loop: BarAngleLoop
    law: str | None = None
