"""Dynamic pressure feedback: the motor's pressure difference, high-passed, is taken off the stroke command (Fig. 12).

H(s) = gain s/(s + corner) works like a leakage that only the ringing sees: it damps the hydraulic poles and leaves the
load that is held alone. As a digital filter it is the bilinear transform, which keeps the gain of 0 at rest and the
gain at high frequencies exactly; prewarped, so that the corner stays where it is stated.
"""

import math

import numpy as np

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity

STATE = np.dtype([("pressure", "f8"), ("stroke", "f8")])  # of the sample before: Pa, and what was taken off


class PressureFeedback(Parameters):
    """A first-order high-pass with a gain."""

    gain: float = quantity("1/Pa")  # stroke over pressure, beyond the corner; 0: off
    corner: float = quantity("rad/s", gt=0)  # of the high-pass, -3 dB


@kernel
def fed_back(feedback, now, later, pressure: float, sample_time: float) -> float:
    """Stroke (1) to take off the command for a pressure (Pa) sampled every `sample_time` s."""
    warped = math.tan(0.5 * feedback.corner * sample_time)
    risen = feedback.gain * (pressure - now.pressure)
    later.pressure = pressure
    later.stroke = (risen + (1.0 - warped) * now.stroke) / (1.0 + warped)
    return later.stroke
