"""Orifice: the flow through a sharp edge goes with the square root of the pressure difference (paper eqs. 9 to 11)."""

import math

from ars_mujoco.kernels.kernel import kernel


@kernel
def rounded_root(difference: float, rounding: float) -> float:
    """Square root (Pa^0.5) of a pressure difference (Pa), with its sign, rounded below `rounding` (Pa, gt 0).

    Through a small enough difference any orifice flows laminar, in proportion to it; so the slope is finite at zero,
    where that of the root is not and no step of an integrator would be short enough.
    """
    return difference / math.sqrt(math.sqrt(difference * difference + rounding * rounding))


@kernel
def root_slope(difference: float, rounding: float) -> float:
    """Derivative (Pa^-0.5) of `rounded_root` by the pressure difference."""
    square = difference * difference
    whole = square + rounding * rounding
    return (0.5 * square + rounding * rounding) / (whole * math.sqrt(math.sqrt(whole)))


@kernel
def in_series(first: float, second: float) -> float:
    """Q/sqrt(dp) of two orifices in series, each given so: their pressure drops add up."""
    if first <= 0.0 or second <= 0.0:
        return 0.0
    return first * second / math.sqrt(first * first + second * second)
