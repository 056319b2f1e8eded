"""Second-order compensator: a badly damped pole pair is cancelled, a better damped one takes its place (Fig. 13).

    (s^2 + 2 damping w s + w^2) / (s^2 + 2 new_damping w s + w^2)

in series with the stroke command. As a digital filter it is the bilinear transform, which keeps the gain of 1 at rest,
prewarped at w, so that the zeros meet the poles that they are to cancel.
"""

import math

import numpy as np

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

STATE = np.dtype([("first", "f8"), ("second", "f8")])  # of the filter's transposed direct form


class PoleCompensator(Parameters):
    """Zeros on a pole pair, and the poles that replace it."""

    frequency: float = quantity("rad/s", gt=0)  # w, natural frequency of both pairs
    damping: float = number(ge=0)  # of the pair that is cancelled
    new_damping: float = number(gt=0)  # of the pair in its place


@kernel
def compensated(compensator, now, later, command: float, sample_time: float) -> float:
    """The stroke command (1) behind the compensator, for one sampled every `sample_time` s."""
    warped = math.tan(0.5 * compensator.frequency * sample_time)
    square = warped * warped
    zeros, poles = 2.0 * compensator.damping * warped, 2.0 * compensator.new_damping * warped
    middle, scale = 2.0 * (square - 1.0), 1.0 / (1.0 + poles + square)
    output = scale * ((1.0 + zeros + square) * command + now.first)
    later.first = middle * (command - output) + now.second
    later.second = (1.0 - zeros + square) * command - (1.0 - poles + square) * output
    return output
