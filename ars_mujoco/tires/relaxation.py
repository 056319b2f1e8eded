"""Transient slip: the carcass deflects before the contact patch slips, over a distance of one relaxation length.

States are the deflections u (longitudinal) and v (lateral) in m of the single-contact-point model (Pacejka, Tyre and
Vehicle Dynamics, section 7.2), from which the slips follow:

    du/dt + |V_x| u / sigma_x = -V_sx,   kappa     = u / sigma_x
    dv/dt + |V_x| v / sigma_y =  V_sy,   tan_alpha = v / sigma_y

At speed these are first-order lags of time constant sigma / |V_x|; at standstill they are springs, which hold a parked
car without creep. Two things are added for low speed, both gone at speed: a damper beside the spring, since |V_x| no
longer damps it; and a limit, since a spring that a sliding wheel wound up beyond the force's peak would push the
stopped car back by as much.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Relaxation(Parameters):
    """Relaxation lengths and the standstill behaviour; grade "judgement" but for the lateral length (the sedan's)."""

    longitudinal: float = quantity("m", gt=0, default=0.25)
    lateral: float = quantity("m", gt=0, default=0.45)
    standstill_speed: float = quantity("m/s", gt=0, default=2.0)  # the damper acts below it
    standstill_damping: float = quantity("s", ge=0, default=0.02)  # damping over stiffness of the carcass at standstill
    peak_slip: float = number(
        gt=0, default=2.4
    )  # normalised slip of the force's peak, all that a tire at standstill can hold
    sliding_speed: float = quantity(
        "m/s", gt=0, default=1.0
    )  # the limit on slip doubles with each such speed: no limit when rolling


@kernel
def advance(deflection, rate, speed, length, h):
    """The deflection (m) a step h (s) later, slipping at `rate` (m/s) while the tire rolls at `speed` (m/s, >= 0).

    The solution's exponential exp(-x), x = h speed / length, is taken as 1 / (1 + x + x^2 / 2): second order,
    L-stable, free of overshoot at any speed, exact in the steady state and at standstill.
    """
    x = h * speed / length
    return (deflection + h * rate * (1.0 + 0.5 * x)) / (1.0 + x + 0.5 * x * x)


@kernel
def limit(p, rho, speed):
    """The factor (<= 1) that brings a normalised slip rho > 0, moving at `speed` (m/s), to what can be stored."""
    return min(1.0, p.peak_slip * (1.0 + speed / p.sliding_speed) / rho)


@kernel
def damping(p, speed):
    """Damping over stiffness of the carcass (s): smoothly gone at `standstill_speed`."""
    away = max(0.0, 1.0 - (speed / p.standstill_speed) ** 2)
    return p.standstill_damping * away * away
