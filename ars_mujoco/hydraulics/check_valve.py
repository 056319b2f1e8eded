"""Check valve: lets oil from the charge gallery into a line, and none back."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class CheckValve(Parameters):
    """A spring-loaded check valve."""

    opening_pressure: float = quantity("Pa", ge=0)  # of its spring, a difference
    conductance: float = quantity("m^3/s/Pa", gt=0)  # flow over excess pressure, once open


@kernel
def check_flow(valve: CheckValve, ahead: float, behind: float) -> float:
    """Flow (m^3/s, never negative) from the pressure `ahead` of the valve to that `behind` it (Pa)."""
    return valve.conductance * max(ahead - behind - valve.opening_pressure, 0.0)
