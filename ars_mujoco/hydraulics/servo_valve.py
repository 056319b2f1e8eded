"""Servo valve: the spool as a second-order lag with limited speed (paper eqs. 18 and 19, the saturation of Fig. 7)."""

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Number, Parameters, Quantity
from ars_mujoco.saturation import saturate


class ServoValve(Parameters):
    """Single-stage servo valve; spool strokes are fractions of full stroke."""

    frequency: Quantity("rad/s", gt=0)  # natural frequency w_sv
    damping: Number(gt=0)  # d_sv; 1/sqrt(2) makes the frequency the -3 dB point
    max_rate: Quantity("1/s", gt=0)  # spool speed limit, full strokes a second


@kernel
def spool_acceleration(valve, stroke: float, rate: float, command: float) -> float:
    """Second derivative of the spool stroke (1/s^2) for a commanded stroke (eq. 18, spool speed saturated)."""
    lag = 2.0 * valve.damping * valve.frequency
    return lag * (saturate(valve.frequency / (2.0 * valve.damping) * (command - stroke), valve.max_rate) - rate)
