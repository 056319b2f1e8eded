"""Pipe: the oil in a line has a volume, a mass and a friction (paper eqs. 30 and 33 to 39)."""

import math
from typing import Annotated, Any

from pydantic import AfterValidator

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity
from ars_mujoco.schema.units import Unit

LAMINAR, TURBULENT = 2300.0, 4000.0  # Reynolds numbers up to which, and from which, the flow is so
MOST_LUMPS = 4
BLASIUS = 0.3164  # the resistance coefficient of a smooth pipe is this over Re^(1/4)


def _whole(number: float) -> float:
    if number != int(number):
        raise ValueError("must be a whole number")
    return number


class Pipe(Parameters):
    """The line of one side, from pump to motor."""

    length: float = quantity("m", gt=0)  # l_L
    diameter: float = quantity("m", gt=0)  # d_L, inner
    wall_compliance: float = quantity(
        "1/Pa", ge=0
    )  # gain of volume with pressure; none for steel, 1e-10 to 1e-9 for a hose
    lumps: Annotated[float, Unit("1", ge=1, le=MOST_LUMPS), AfterValidator(_whole)]  # pieces it is divided into


@kernel
def area(pipe: Pipe) -> float:
    """Inner cross section (m^2): A_L."""
    return 0.25 * math.pi * pipe.diameter * pipe.diameter


@kernel
def volume(pipe: Pipe) -> float:
    """Volume of oil (m^3) in the whole line: V_L (eq. 30)."""
    return pipe.length * area(pipe)


@kernel
def inertance(pipe: Pipe, fluid: Any) -> float:
    """Pressure difference that a change of flow takes in the whole line (Pa s^2/m^3, eq. 35)."""
    return fluid.density * pipe.length / area(pipe)


@kernel
def reynolds(pipe: Pipe, fluid: Any, flow: float) -> float:
    """Reynolds number of a flow (m^3/s) in either direction (eq. 37)."""
    return abs(flow) * pipe.diameter / (area(pipe) * fluid.viscosity)


@kernel
def pressure_drop(pipe: Pipe, fluid: Any, flow: float) -> float:
    """Pressure (Pa) that friction takes from a flow (m^3/s) in the whole line, with the sign of the flow.

    Eq. 36 with the resistance coefficient 64/Re of laminar flow (eqs. 38, 39), and with that of Blasius where it is
    turbulent, which the paper leaves out; linear in Re between the two, where neither holds.
    """
    number = reynolds(pipe, fluid, flow)
    scale = fluid.density * pipe.length * fluid.viscosity * fluid.viscosity / pipe.diameter**3
    return math.copysign(scale * _resistance(number), flow)


@kernel
def _resistance(number: float) -> float:
    # Re^2 lambda/2, which is the pressure drop over rho l nu^2/d^3
    if number <= LAMINAR:
        return 32.0 * number
    if number >= TURBULENT:
        return _turbulent(number)
    share = (number - LAMINAR) / (TURBULENT - LAMINAR)
    return (1.0 - share) * 32.0 * LAMINAR + share * _turbulent(TURBULENT)


@kernel
def _turbulent(number: float) -> float:
    return 0.5 * BLASIUS * number * number / math.sqrt(math.sqrt(number))
