"""Radial piston pump with a flow limit: its suction fills the cylinders only so far, whatever the speed.

    Q = q/(1 + (q/Q_lim)^m)^(1/m),   q = V n eta_v

A restrictor in the intake lowers the limit while little is needed. What throttles the suction costs no torque of its
own: the indicated work belongs to the oil delivered, not to V n, and drag and load torque are eq. 22's.
"""

from ars_mujoco.hydraulics.loss_polynomial import TorqueLoss, even_loss
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity

FULL = 1.0  # stroke, which eq. 22 has and this pump has not


class IntakeRestrictor(Parameters):
    """Throttle in the suction; it opens as soon as a torque is asked for."""

    least_share: float = number(gt=0, le=1)  # of the flow limit, while nothing is asked for; 1 where there is none
    time: float = quantity("s", gt=0)  # in which it opens and closes, 1/e
    wake_torque: float = quantity("Nm", gt=0)  # of a bar's command that opens it
    hold: float = quantity("s", ge=0)  # for which it stays open after the last such command


class RadialPistonPump(Parameters):
    """Pump of fixed displacement; the pressures are over the reservoir's."""

    displacement: float = quantity("m^3/rad", gt=0)  # V/2pi
    efficiency: float = number(gt=0, le=1)  # eta_v, volumetric, of the suction
    flow_limit: float = quantity("m^3/s", gt=0)  # Q_lim
    knee: float = number(ge=1)  # m
    leakage: float = quantity("m^3/s/Pa", ge=0)  # back through the inlet valves
    torque_loss: TorqueLoss
    intake: IntakeRestrictor


@kernel
def limited_flow(pump: RadialPistonPump, speed: float, share: float) -> float:
    """Flow (m^3/s) at a shaft speed (rad/s), with a `share` (0 to 1) of the flow limit."""
    unlimited = pump.displacement * pump.efficiency * speed
    return unlimited / (1.0 + (unlimited / (share * pump.flow_limit)) ** pump.knee) ** (1.0 / pump.knee)


@kernel
def shaft_loss(pump: RadialPistonPump, speed: float, pressure: float) -> float:
    """Power (W) that the shaft takes besides the indicated work, at a speed (rad/s) under a pressure (Pa)."""
    return even_loss(pump.torque_loss, FULL, speed, pressure) * speed


@kernel
def intake_wanted(intake: IntakeRestrictor, idle: float) -> float:
    """Share of the flow limit that the restrictor goes to, where nothing has been asked for a time (s)."""
    return intake.least_share if idle >= intake.hold else 1.0
