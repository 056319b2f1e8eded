"""Bar-angle loop: the outer loop of the cascade, from the bar's angle to the pump's stroke (paper section 5)."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, number, quantity

LEAST_SPEED = 50.0  # rad/s, below any idle, under which a scheduled gain is no longer raised: an engine may be off


class BarAngleLoop(Parameters):
    """Proportional controller of the bar angle."""

    gain: float = quantity("1/rad", gt=0)  # K_p at the gain's own speed: full stroke over angle error
    gain_speed: float = quantity("rad/s", gt=0)  # the pump speed at which `gain` holds
    schedule: float = number(ge=0, le=1)  # 1: K_p ~ 1/n, the loop is the same at every speed; 0: fixed, the paper's
    max_angle: float = quantity("rad", gt=0)  # limit of the command, not the motor's mechanical stop


@kernel
def outer_gain(loop, speed: float) -> float:
    """K_p (1/rad) at a pump speed (rad/s)."""
    return loop.gain * (1.0 + loop.schedule * (loop.gain_speed / max(speed, LEAST_SPEED) - 1.0))


@kernel
def limited(loop, command: float) -> float:
    """The command within the range of the bar."""
    return saturate(command, loop.max_angle)
