"""Swash plate: the pump's stroke, integrated from the spool stroke by the control cylinder (paper eq. 20).

The paper's integrator knows no end: its stop acts on the flow alone, and while the valve stays open the stroke winds up
past full, from where it must first come back. A real plate is held at its stop and leaves it at once.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, choice, quantity

ON_FLOW, ON_STROKE = 0.0, 1.0


class SwashPlate(Parameters):
    """Control cylinder and swash plate, reduced to the integrator that the servo valve dominates."""

    max_rate: float = quantity("1/s", gt=0)  # full strokes a second at a fully open valve
    stop: float = choice("flow", "stroke", default=ON_STROKE)  # what the stop acts on; `flow` is the paper's


@kernel
def stroke_rate(plate: SwashPlate, spool: float) -> float:
    """Rate of the pump stroke (1/s), a fraction of full stroke (eq. 20 without the valve's lag)."""
    return plate.max_rate * spool


@kernel
def held(plate: SwashPlate, stroke: float) -> float:
    """The stroke at which the plate stands after a substep that would have led it to `stroke`."""
    return saturate(stroke, 1.0) if plate.stop == ON_STROKE else stroke
