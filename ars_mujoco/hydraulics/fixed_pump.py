"""Fixed-displacement pump: an internal gear machine that pumps and motors either way round, turned by its own motor.

Its oil goes with its speed alone. It creeps for minutes to make up for the leakage of a pressure that is held, where no
film of oil carries its gears: below some 200 rpm a boundary friction joins the losses of eq. 22.
"""

import math
from typing import Any

from pydantic import model_validator

from ars_mujoco.hydraulics.boundary_friction import BoundaryFriction
from ars_mujoco.hydraulics.loss_polynomial import TorqueLoss, beyond, even_loss
from ars_mujoco.hydraulics.pump_catalogue import like
from ars_mujoco.hydraulics.vane_motor import rounded_sign
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, quantity

FULL = 1.0  # stroke, which eq. 22 has and this pump has not


class FixedPump(Parameters):
    """Gear pump of one axle."""

    displacement: float = quantity("m^3/rad", gt=0)  # D_p = V_p/2pi
    leakage: float = quantity("m^3/s/Pa", ge=0)  # the pump's share of k_Li
    torque_loss: TorqueLoss
    boundary_friction: BoundaryFriction

    @model_validator(mode="before")
    @classmethod
    def _is_like(cls, block: Any) -> Any:
        return like(block, cls.model_fields)


@kernel
def loss_torque(pump: FixedPump, speed: float, pressure: float) -> float:
    """Torque loss (Nm) against the motion at a speed (rad/s), under a pressure difference (Pa)."""
    boundary = pump.boundary_friction
    dry = pump.torque_loss.norm * boundary.share * math.exp(-abs(speed) / boundary.decay_speed)
    size = even_loss(pump.torque_loss, FULL, speed, pressure) + dry
    return size * rounded_sign(speed / boundary.sign_speed)


@kernel
def fixed_pump_extrapolation(pump: FixedPump, speed: float, pressure: float) -> float:
    """How far the pump runs outside the range of its losses, as a share of the range's end; 0 inside."""
    return beyond(pump.torque_loss, FULL, speed, pressure)
