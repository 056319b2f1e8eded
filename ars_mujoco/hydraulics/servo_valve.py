"""Servo valve: the spool as a second-order lag with limited speed (paper eqs. 18 and 19, the saturation of Fig. 7)."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, number, quantity


class ServoValve(Parameters):
    """Single-stage servo valve; spool strokes are fractions of full stroke."""

    frequency: float = quantity("rad/s", gt=0)  # natural frequency w_sv
    damping: float = number(gt=0)  # d_sv; 1/sqrt(2) makes the frequency the -3 dB point
    max_rate: float = quantity("1/s", gt=0)  # spool speed limit, full strokes a second


@kernel
def spool_acceleration(valve: ServoValve, stroke: float, rate: float, command: float) -> float:
    """Second derivative of the spool stroke (1/s^2) for a commanded stroke (eq. 18, spool speed saturated)."""
    lag = 2.0 * valve.damping * valve.frequency
    return lag * (saturate(valve.frequency / (2.0 * valve.damping) * (command - stroke), valve.max_rate) - rate)
