"""Swash plate: the pump's stroke, integrated from the spool stroke by the control cylinder (paper eq. 20)."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class SwashPlate(Parameters):
    """Control cylinder and swash plate, reduced to the integrator that the servo valve dominates."""

    max_rate: float = quantity("1/s", gt=0)  # full strokes a second at a fully open valve


@kernel
def stroke_rate(plate, spool: float) -> float:
    """Rate of the pump stroke (1/s), a fraction of full stroke (eq. 20 without the valve's lag)."""
    return plate.max_rate * spool
