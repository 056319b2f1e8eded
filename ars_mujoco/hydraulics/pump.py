"""Variable displacement pump: flow, flow loss and torque loss (paper eqs. 21 to 24, 41)."""

import math
from typing import Any

from pydantic import model_validator

from ars_mujoco.hydraulics.loss_polynomial import FlowLoss, TorqueLoss, beyond, even_loss, odd_loss
from ars_mujoco.hydraulics.pump_catalogue import like
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, quantity


class Pump(Parameters):
    """Swash-plate axial piston pump, driven at a given shaft speed."""

    displacement: float = quantity("m^3/rad", gt=0)  # V_p/2pi at full stroke
    speed: float = quantity("rad/s", gt=0)  # shaft speed where the drive is constant
    leakage: float = quantity("m^3/s/Pa", ge=0)  # the pump's share of k_Li
    flow_loss: FlowLoss | None = None  # besides the leakage
    torque_loss: TorqueLoss

    @model_validator(mode="before")
    @classmethod
    def _is_like(cls, block: Any) -> Any:
        return like(block, cls.model_fields)

    @model_validator(mode="after")
    def _check_speed(self) -> "Pump":
        for name in ("torque_loss", "flow_loss"):
            loss = getattr(self, name)
            if loss and not loss.validity.speed[0] <= self.speed <= loss.validity.speed[1]:
                speed, least, most = (30.0 / math.pi * each for each in (self.speed, *loss.validity.speed))
                raise ValueError(
                    f"speed: {speed:.6g} rpm is outside the range of {name}; allowed: {least:.6g} to {most:.6g} rpm"
                )
        return self


@kernel
def ideal_flow(pump: Any, stroke: float) -> float:
    """Flow (m^3/s) without losses; the mechanical stop limits the stroke to +-1 (eq. 24)."""
    return saturate(stroke, 1.0) * pump.displacement * pump.speed


@kernel
def flow_loss(pump: Any, stroke: float, pressure: float) -> float:
    """Flow (m^3/s) lost from the high to the low side, signed like the pressure: eqs. 41 and 21."""
    linear = pump.leakage * pressure
    if pump.flow_loss.norm > 0.0:
        return linear + odd_loss(pump.flow_loss, saturate(stroke, 1.0), pump.speed, pressure)
    return linear


@kernel
def torque_loss(pump: Any, stroke: float, pressure: float) -> float:
    """Torque loss (Nm), which the shaft pays in all four quadrants (eq. 22)."""
    return even_loss(pump.torque_loss, saturate(stroke, 1.0), pump.speed, pressure)


@kernel
def extrapolation(pump: Any, stroke: float, pressure: float) -> float:
    """How far the pump runs outside the range of its losses, as a share of the range's end; 0 inside."""
    stroke = saturate(stroke, 1.0)
    outside = beyond(pump.torque_loss, stroke, pump.speed, pressure)
    if pump.flow_loss.norm > 0.0:
        return max(outside, beyond(pump.flow_loss, stroke, pump.speed, pressure))
    return outside
