"""Relief valve: limits a pressure difference, of both directions or of one line."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity


class ReliefValve(Parameters):
    """A pair of relief valves, one a line; both open at the same pressure."""

    pressure: float = quantity("Pa", gt=0)  # opening pressure
    conductance: float = quantity("m^3/s/Pa", ge=0)  # flow over excess pressure, once open


@kernel
def relief_flow(valve: ReliefValve, pressure: float) -> float:
    """Flow (m^3/s) from the high to the low side, with the sign of `pressure` (Pa)."""
    if pressure > valve.pressure:
        return valve.conductance * (pressure - valve.pressure)
    if pressure < -valve.pressure:
        return valve.conductance * (pressure + valve.pressure)
    return 0.0


@kernel
def one_way_relief(valve: ReliefValve, excess: float) -> float:
    """Flow (m^3/s, never negative) through one valve of the pair, `excess` (Pa) being the pressure over its outlet."""
    return valve.conductance * max(excess - valve.pressure, 0.0)
