"""Lines and chambers: the compressible oil between pump and motor (paper eqs. 30 to 32)."""

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Parameters, Quantity


class Line(Parameters):
    """One line a side, with the motor's chamber at its end."""

    volume: Quantity("m^3", gt=0)  # V_L, one line
    capacitance: Quantity("m^3/Pa", gt=0)  # C_0, of both sides in series with the motor in its middle


@kernel
def middle_volume(line, motor) -> float:
    """Volume of one side (m^3), line and chamber, with the motor in its middle position: V_0 (eqs. 30, 31)."""
    return line.volume + motor.displacement * motor.stop_angle


@kernel
def capacitance(line, motor, angle: float) -> float:
    """Series capacitance (m^3/Pa) of both sides at a motor angle: eq. 32 with the minus sign that its algebra gives."""
    share = motor.displacement / middle_volume(line, motor) * angle
    return line.capacitance * (1.0 - share * share)


@kernel
def capacitance_slope(line, motor, angle: float) -> float:
    """Derivative of `capacitance` by the angle (m^3/Pa/rad)."""
    share = motor.displacement / middle_volume(line, motor)
    return -2.0 * line.capacitance * share * share * angle
