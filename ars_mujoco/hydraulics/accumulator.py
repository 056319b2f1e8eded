"""Accumulator: a gas cushion that keeps a closed circuit's low side filled.

The oil drawn from it lets its gas expand: p V^n is constant, so that

    p' = n p/V Q,   V = V_0 (p_0/p)^(1/n),   Q the flow of oil into it.
"""

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.parameters import Parameters, number, quantity


class Accumulator(Parameters):
    """A small gas-charged accumulator; its volume is that of the gas at the circuit's rest."""

    volume: float = quantity("m^3", gt=0)  # V_0, of the gas at
    pressure: float = quantity("Pa", gt=0)  # p_0, absolute
    exponent: float = number(gt=1, le=1.7)  # n: 1.4 where no heat passes; near 1 where the gas has time for it


@kernel
def accumulator_rate(accumulator: Accumulator, pressure: float, flow: float) -> float:
    """Rate (Pa/s) of the gas pressure (Pa, absolute) as a flow of oil (m^3/s) comes in."""
    return accumulator.exponent * pressure / gas_volume(accumulator, pressure) * flow


@kernel
def gas_volume(accumulator: Accumulator, pressure: float) -> float:
    """Volume (m^3) of the gas at an absolute pressure (Pa)."""
    return accumulator.volume * (accumulator.pressure / pressure) ** (1.0 / accumulator.exponent)


@kernel
def accumulator_energy(accumulator: Accumulator, pressure: float) -> float:
    """Energy (J) stored in the gas over that at rest: what the oil that came in pressed against p - p_0."""
    n, rest, volume = accumulator.exponent, accumulator.pressure, gas_volume(accumulator, pressure)
    compressed = (pressure * volume - rest * accumulator.volume) / (n - 1.0)
    return compressed - rest * (accumulator.volume - volume)
