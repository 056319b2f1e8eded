"""Bypass valve: joins the motor's two sides, so that it turns freely."""

import math

from ars_mujoco.hydraulics.orifice import rounded_root
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity

ROUNDING = 1e5  # Pa, below which its orifice flows laminar


class BypassValve(Parameters):
    """A switching valve between the motor's chambers; `valve_opening` moves it."""

    flow: float = quantity("m^3/s", gt=0)  # rated, fully open
    pressure: float = quantity("Pa", gt=0)  # difference at the rated flow
    time: float = quantity("s", gt=0)  # of a full stroke


@kernel
def bypass_flow(valve: BypassValve, opening: float, difference: float) -> float:
    """Flow (m^3/s) through an opening (0 to 1), with the sign of the pressure difference (Pa)."""
    return opening * valve.flow / math.sqrt(valve.pressure) * rounded_root(difference, ROUNDING)
