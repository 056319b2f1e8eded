"""Charge pump: a constant flow into a gallery, from which the check valves make up what the lines lose."""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class ChargePump(Parameters):
    """Fixed displacement pump on the shaft of the main one, with its gallery and the gallery's relief valve."""

    displacement: float = quantity("m^3/rad", gt=0)  # V_c/2pi
    efficiency: float = number(gt=0, le=1)  # mechanical
    relief_pressure: float = quantity("Pa", gt=0)  # absolute, at which the gallery opens to the tank
    relief_conductance: float = quantity("m^3/s/Pa", gt=0)  # flow over excess pressure, once open
    gallery_volume: float = quantity("m^3", gt=0)


@kernel
def charge_flow(charge: ChargePump, speed: float) -> float:
    """Flow (m^3/s) from the tank into the gallery at a shaft speed (rad/s)."""
    return charge.displacement * speed


@kernel
def charge_relief_flow(charge: ChargePump, pressure: float) -> float:
    """Flow (m^3/s) from the gallery at an absolute pressure (Pa) to the tank."""
    return charge.relief_conductance * max(pressure - charge.relief_pressure, 0.0)


@kernel
def charge_power(charge: ChargePump, speed: float, pressure: float, tank: float) -> float:
    """Power (W) the shaft gives to lift the flow from `tank` to `pressure` (Pa, absolute), over the efficiency.

    A gallery drawn below the tank's pressure would drive the pump; the loss is a loss then too.
    """
    rise = pressure - tank
    loss = (1.0 / charge.efficiency - 1.0) * abs(rise)
    return charge_flow(charge, speed) * (rise + loss)
