"""The opening of a switching valve: it follows its command at the speed of its stroke."""

from typing import Any

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate

CLOSE = 0.05  # of a stroke: nearer to its command the valve slows down, so that its rate has no step


@kernel
def opening_rate(valve: Any, opening: float, command: float) -> float:
    """Rate (1/s) of an opening (0 shut to 1 open) towards its command; a full stroke takes `valve.time` (s)."""
    return saturate((command - opening) / CLOSE, 1.0) / valve.time
