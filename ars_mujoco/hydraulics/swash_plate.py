"""Swash plate: the pump's stroke, integrated from the spool stroke by the control cylinder (paper eq. 20).

The paper's integrator knows no end: its stop acts on the flow alone, and while the valve stays open the stroke winds up
past full, from where it must first come back. A real plate is held: over the last of its stroke the cylinder's cushion
throttles it, so that it meets its stop without a blow and leaves it at once.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, choice, quantity

ON_FLOW, ON_STROKE = 0.0, 1.0
CUSHION = 0.02  # of full stroke, over which the cushion acts; its eigenvalue is then slower than the friction's at rest


class SwashPlate(Parameters):
    """Control cylinder and swash plate, reduced to the integrator that the servo valve dominates."""

    max_rate: float = quantity("1/s", gt=0)  # full strokes a second at a fully open valve
    stop: float = choice("flow", "stroke", default=ON_STROKE)  # what the stop acts on; `flow` is the paper's


@kernel
def stroke_rate(plate, spool: float, stroke: float) -> float:
    """Rate of the pump stroke (1/s), a fraction of full stroke (eq. 20 without the valve's lag)."""
    rate = plate.max_rate * spool
    if plate.stop == ON_STROKE and spool * stroke > 0.0:
        rate *= min(1.0, (1.0 - abs(stroke)) / CUSHION)
    return rate
