"""Swash-plate loop: the inner loop of the cascade, from stroke error to spool stroke (paper Fig. 10)."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, quantity


class SwashPlateLoop(Parameters):
    """Proportional controller of the pump stroke."""

    gain: float = quantity("1/s", gt=0)  # K_in: rate of stroke asked for, over the stroke's error


@kernel
def valve_command(loop, plate, command: float, stroke: float) -> float:
    """Commanded spool stroke, a fraction within +-1, for a commanded and an actual pump stroke."""
    return saturate(loop.gain / plate.max_rate * (command - stroke), 1.0)
