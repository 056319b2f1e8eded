"""Roll trim: what the bars add by the measured roll, slowly for what the statics do not know, quickly to damp."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, quantity


class RollTrim(Parameters):
    """Integral of the roll's error, off with a rate of zero, and damping in proportion to the roll rate."""

    rate: float = quantity("1/s", ge=0)  # bar angle a second, over roll error
    limit: float = quantity("rad", ge=0)  # of the integral
    damping: float = quantity("s", ge=0)  # bar angle over roll rate


@kernel
def trim(settings, correction: float, roll_error: float, step: float) -> float:
    """The integral (rad of bar angle) one step later; `roll_error` (rad) is measured less wanted."""
    return saturate(correction + settings.rate * roll_error * step, settings.limit)


@kernel
def roll_damping(settings, roll_rate: float) -> float:
    """Bar angle (rad) against a roll rate (rad/s)."""
    return settings.damping * roll_rate
