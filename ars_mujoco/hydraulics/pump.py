"""Variable displacement pump: flow, leakage and torque loss (paper eqs. 22, 24, 41)."""

from ars_mujoco.kernel import kernel
from ars_mujoco.parameters import Number, Parameters, Quantity
from ars_mujoco.saturation import saturate


class Pump(Parameters):
    """Swash-plate axial piston pump, driven at a given shaft speed."""

    displacement: Quantity("m^3/rad", gt=0)  # V_p/2pi at full stroke
    speed: Quantity("rad/s", gt=0)  # shaft speed where the drive is constant
    leakage: Quantity("m^3/s/Pa", ge=0)  # the pump's share of k_Li
    loss_torque: Quantity("Nm", ge=0)  # normal value of the torque loss polynomial
    loss_constant: Number(ge=0)  # its coefficients: constant,
    loss_speed: Number(ge=0)  # of n^,
    loss_pressure: Number(ge=0)  # of p^,
    loss_stroke_pressure: Number(ge=0)  # of X^ p^
    normal_speed: Quantity("rad/s", gt=0)  # n_norm
    normal_pressure: Quantity("Pa", gt=0)  # p_norm


@kernel
def ideal_flow(pump, stroke: float) -> float:
    """Flow (m^3/s) without leakage; the mechanical stop limits the stroke to +-1 (eq. 24)."""
    return saturate(stroke, 1.0) * pump.displacement * pump.speed


@kernel
def torque_loss(pump, stroke: float, pressure: float) -> float:
    """Torque loss (Nm), positive in all four quadrants: eq. 22 in |X|, n and |dp| with (.)/(.)_norm to each power."""
    relative = 1.0 / pump.normal_pressure * abs(pressure)
    return pump.loss_torque * (
        pump.loss_constant
        + pump.loss_speed * pump.speed / pump.normal_speed
        + (pump.loss_pressure + pump.loss_stroke_pressure * abs(saturate(stroke, 1.0))) * relative
    )
