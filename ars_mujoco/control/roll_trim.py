"""Roll trim: a slow correction of the bar angles by the measured roll, for what the statics do not know (optional)."""

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Parameters, Quantity
from ars_mujoco.saturation import saturate


class RollTrim(Parameters):
    """Integral controller on roll; off with a rate of zero."""

    rate: Quantity("1/s", ge=0)  # bar angle a second, over roll error
    limit: Quantity("rad", ge=0)  # of the correction


@kernel
def trim(settings, correction: float, roll_error: float, step: float) -> float:
    """The correction (rad of bar angle) one step later; `roll_error` (rad) is measured less wanted."""
    return saturate(correction + settings.rate * roll_error * step, settings.limit)
