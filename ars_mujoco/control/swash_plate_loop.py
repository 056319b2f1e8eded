"""Swash-plate loop: the inner loop of the cascade, from stroke error to spool stroke (paper Fig. 10)."""

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Parameters, Quantity
from ars_mujoco.saturation import saturate


class SwashPlateLoop(Parameters):
    """Proportional controller of the pump stroke."""

    gain: Quantity("1/s", gt=0)  # K_in: rate of stroke asked for, over the stroke's error


@kernel
def valve_command(loop, plate, command: float, stroke: float) -> float:
    """Commanded spool stroke, a fraction within +-1, for a commanded and an actual pump stroke."""
    return saturate(loop.gain / plate.max_rate * (command - stroke), 1.0)
