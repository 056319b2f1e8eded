"""Lines and chambers: the compressible oil between pump and motor (paper eqs. 30 to 32), as one capacitance."""

from ars_mujoco.hydraulics.vane_motor import VaneMotor
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, choice, quantity

SERIES, ONE_SIDED = 0.0, 1.0  # weights, for a branch in the loop over the substeps would cost several percent of it


class Line(Parameters):
    """One line a side, with the motor's chamber at its end.

    In `series`, the oil that leaves one side enters the other and both pressures change: C_0 = V_0/2K. `one_sided`, the
    low pressure is held constant, as by a charge supply, and the high-pressure side alone counts: C_0 = V_0/K.
    """

    volume: float = quantity("m^3", gt=0)  # V_L, one line
    capacitance: float = quantity("m^3/Pa", gt=0)  # C_0, of `sides`, with the motor in its middle
    sides: float = choice("series", "one_sided", default=SERIES)


@kernel
def middle_volume(line: Line, motor: VaneMotor) -> float:
    """Volume of one side (m^3), line and chamber, with the motor in its middle position: V_0 (eqs. 30, 31)."""
    return line.volume + motor.displacement * motor.stop_angle


@kernel
def capacitance(line: Line, motor: VaneMotor, angle: float, pressure: float) -> float:
    """Capacitance (m^3/Pa) at a motor angle: of both sides in series, eq. 32 with the minus sign that its algebra
    gives; one-sided, of the side that the sign of `pressure` (Pa, the difference) makes the high one.
    """
    share = motor.displacement / middle_volume(line, motor) * angle
    return line.capacitance * (1.0 + share * (line.sides * _high_side(pressure) - (1.0 - line.sides) * share))


@kernel
def capacitance_slope(line: Line, motor: VaneMotor, angle: float, pressure: float) -> float:
    """Derivative of `capacitance` by the angle (m^3/Pa/rad)."""
    share = motor.displacement / middle_volume(line, motor)
    return line.capacitance * share * (line.sides * _high_side(pressure) - 2.0 * (1.0 - line.sides) * share * angle)


@kernel
def _high_side(pressure: float) -> float:
    # 1 for side A, -1 for side B; neither at zero, so that a mirrored state has the same capacitance to the last bit
    return 1.0 * (pressure > 0.0) - 1.0 * (pressure < 0.0)
