"""Fail-safe valve: stands in a line before the motor and, shut, holds the oil in it."""

import math

from ars_mujoco.hydraulics.orifice import rounded_root
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity

SHUT = 0.05  # opening under which no oil passes
LAMINAR_SHARE = 0.05  # of the rated flow, below which its orifice flows laminar
ROUNDING = 1e5  # Pa, below which it does where the pressures on both its sides are states


class FailSafeValve(Parameters):
    """A switching valve in the line; `valve_opening` moves it."""

    flow: float = quantity("m^3/s", gt=0)  # rated, fully open
    pressure: float = quantity("Pa", gt=0)  # drop at the rated flow
    time: float = quantity("s", gt=0)  # of a full stroke


@kernel
def is_shut(valve: FailSafeValve, opening: float) -> bool:
    """Whether an opening (0 to 1) lets no oil pass."""
    return opening < SHUT


@kernel
def fail_safe_drop(valve: FailSafeValve, opening: float, flow: float) -> float:
    """Pressure (Pa) that a flow (m^3/s) loses through an opening that is not shut, with the sign of the flow: in
    proportion to its square, and to the flow itself where that is small, so that a slope is left at zero.
    """
    relative = flow / (valve.flow * opening)
    laminar = LAMINAR_SHARE / opening
    return valve.pressure * relative * math.sqrt(relative * relative + laminar * laminar)


@kernel
def fail_safe_flow(valve: FailSafeValve, opening: float, difference: float) -> float:
    """Flow (m^3/s) that a pressure difference (Pa) drives through an opening, with its sign; none through one that is
    shut.
    """
    if is_shut(valve, opening):
        return 0.0
    return opening * valve.flow / math.sqrt(valve.pressure) * rounded_root(difference, ROUNDING)
