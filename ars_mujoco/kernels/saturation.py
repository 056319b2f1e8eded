"""Saturation: a value limited to a symmetric range."""

from ars_mujoco.kernels.kernel import kernel


@kernel
def saturate(value: float, limit: float) -> float:
    """`value` limited to [-limit, limit]; NaN stays NaN."""
    if value > limit:
        return limit
    if value < -limit:
        return -limit
    return value
