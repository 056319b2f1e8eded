"""Road: flat at height zero, with a bump that the wheels of one side roll over."""

import math

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Bump(Parameters):
    """A (1 - cos) bump across one half of the road."""

    side: float = number(ge=-1, le=1, default=0.0)  # 1 left (y > 0), -1 right, 0 no bump
    height: float = quantity("m", default=0.04)
    length: float = quantity("m", gt=0, default=1.0)
    position: float = quantity("m", default=0.0)  # x at which it begins


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
