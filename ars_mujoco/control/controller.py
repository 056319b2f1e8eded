"""Controllers: what a user can choose or write, read from a file."""

import math

from pydantic import ValidationInfo, field_validator

from ars_mujoco.actuators.pump_controlled.bar_angle_loop import BarAngleLoop
from ars_mujoco.actuators.pump_controlled.pole_compensator import PoleCompensator
from ars_mujoco.actuators.pump_controlled.pressure_feedback import PressureFeedback
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
    """The cascade: reference (not on the bench, whose cycle commands the bar's angle), unit, outer loop, compensators.

    The compensators are digital filters, so they need a unit that samples, and fast enough for their frequency.
    `law` names a Python file whose function `command(sensors, memory)` takes the place of the target map.
    """

    reference: Reference | None = None
    unit: ControlUnit
    loop: BarAngleLoop
    pressure_feedback: PressureFeedback | None = None
    compensator: PoleCompensator | None = None
    law: str | None = None

    @field_validator("pressure_feedback", "compensator")
    @classmethod
    def _is_sampled(cls, filtering, info: ValidationInfo):
        unit = info.data.get("unit")
        if filtering is None or unit is None:
            return filtering
        if unit.sample_time == 0.0:
            raise ValueError("a digital filter, but the unit is continuous; allowed: with a unit.sample_time over 0 s")
        name = "corner" if isinstance(filtering, PressureFeedback) else "frequency"
        fastest = math.pi / unit.sample_time
        if getattr(filtering, name) >= fastest:
            raise ValueError(
                f"{name} of {getattr(filtering, name):g} rad/s is beyond what a unit.sample_time of "
                f"{1e3 * unit.sample_time:g} ms can filter; allowed: less than {fastest:g} rad/s"
            )
        return filtering
