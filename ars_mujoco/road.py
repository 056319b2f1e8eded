"""Road: flat at height zero, with a bump that the wheels of one side roll over."""

import math

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Number, Parameters, Quantity


class Bump(Parameters):
    """A (1 - cos) bump across one half of the road."""

    side: Number(ge=-1, le=1) = 0.0  # 1 left (y > 0), -1 right, 0 no bump
    height: Quantity("m") = 0.04
    length: Quantity("m", gt=0) = 1.0
    position: Quantity("m") = 0.0  # x at which it begins


@kernel
def height_and_slope(p, x, y):
    """Height z (m) of the road at (x, y) (m), and its slopes dz/dx and dz/dy."""
    if p.side == 0.0:
        return 0.0, 0.0, 0.0
    s = (x - p.position) / p.length
    if s <= 0.0 or s >= 1.0 or y * p.side <= 0.0:
        return 0.0, 0.0, 0.0
    phase = 2.0 * math.pi * s
    return 0.5 * p.height * (1.0 - math.cos(phase)), math.pi * p.height / p.length * math.sin(phase), 0.0
