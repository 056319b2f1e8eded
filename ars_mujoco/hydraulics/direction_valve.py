"""Direction valve: gives pressure to one side of the motors and joins the other with the return line.

    spool  +1: P to A, B to T      0: A and B to T, P shut      -1: P to B, A to T

A sensor tells where the spool is. Springs centre it without current; around the centre the pressure port overlaps and
both motor ports have a narrow way to the return line.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

A, B = 1.0, -1.0  # the motor's sides


class DirectionValve(Parameters):
    """A switching valve with three positions; `valve_opening` moves it."""

    overlap: float = number(ge=0, lt=1)  # of the way from the centre, over which the pressure port stays shut
    flow: float = quantity("m^3/s", gt=0)  # rated, of one edge fully open
    pressure: float = quantity("Pa", gt=0)  # drop over it
    time: float = quantity("s", gt=0)  # from the centre to an end
    leakage: float = quantity("m^3/s/Pa", ge=0)  # of the spool, from the pressure port to the return line
    power: float = quantity("W", ge=0)  # of a solenoid that holds it at an end


@kernel
def pressure_opening(valve: DirectionValve, spool: float, side: float) -> float:
    """Opening (0 to 1) from the pressure port to the motor's side A or B."""
    return max(side * spool - valve.overlap, 0.0) / (1.0 - valve.overlap)


@kernel
def return_opening(valve: DirectionValve, spool: float, side: float) -> float:
    """Opening (0 to 1) from the motor's side A or B to the return line."""
    return max(valve.overlap - side * spool, 0.0) / (1.0 + valve.overlap)
