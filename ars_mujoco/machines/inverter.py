"""Inverter: what it takes to drive a machine from a supply of direct voltage."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Inverter(Parameters):
    """Three half bridges and their gate drivers."""

    standby_power: float = quantity("W", ge=0)  # while it is switched on
    loss_share: float = number(ge=0)  # of its apparent power, U/2 times the amplitude of a phase's current


@kernel
def inverter_loss(inverter: Inverter, supply: float, current: float) -> float:
    """Loss (W) at a supply voltage (V) and an amplitude of the phases' current (A)."""
    return inverter.standby_power + inverter.loss_share * 0.5 * supply * current
