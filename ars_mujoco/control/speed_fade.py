"""Speed fade: the reference fades in with speed.

A tire's carcass is damped by rolling: at walking pace the body sways on the tires at 2 to 3 Hz with almost no damping,
and the loop from the accelerometer over the bars to that sway would feed it.
"""

from pydantic import model_validator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class SpeedFade(Parameters):
    """Speeds (m/s) from which the reference begins to act, and at which it acts in full."""

    begin: float = quantity("m/s", ge=0)
    full: float = quantity("m/s", gt=0)

    @model_validator(mode="after")
    def _rises(self):
        if not self.full > self.begin:
            raise ValueError(f"full must be greater than begin, {self.begin:g} m/s")
        return self


@kernel
def fade(settings, speed: float) -> float:
    """Share of the reference, 0 to 1, at a forward speed (m/s); linear between the two speeds."""
    return min(max((abs(speed) - settings.begin) / (settings.full - settings.begin), 0.0), 1.0)
