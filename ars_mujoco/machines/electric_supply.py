"""Electric supply: a converter of limited power and a store, at the end of a line that all loads share.

    source ─> converter (power limit, lag) ─> store (C) ─[R]─> loads

The converter holds the store at the nominal voltage as far as its power goes; what it cannot give comes from the store,
whose voltage sags. Over its last volts above the least voltage the store's share fades, so that the loads get what the
converter gives and no more: all are then scaled by the same factor.
"""

import math
from typing import Any

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.saturation import saturate
from ars_mujoco.schema.parameters import Parameters, number, quantity

FADE = 2.0  # V over the least voltage, within which the store's share fades to nothing


class ElectricSupply(Parameters):
    """Supply of both axles; a store of large capacity and a converter of large power make a stiff one."""

    voltage: float = quantity("V", gt=0)  # nominal
    least_voltage: float = quantity("V", gt=0)  # of the store, where loads are shed
    capacitance: float = quantity("F", gt=0)  # of the store
    store_power: float = quantity("W", ge=0)  # that loads may take from the store besides the converter's
    line_resistance: float = quantity("ohm", ge=0)
    converter_power: float = quantity("W", gt=0)  # to the store; it takes nothing back
    converter_lag: float = quantity("s", gt=0)
    converter_gain: float = quantity("W/V", gt=0)  # power over what the store lacks of the nominal voltage
    efficiency: float = number(gt=0, le=1)  # of the converter
    controller_power: float = quantity("W", ge=0)  # of control units, always on


@kernel
def budget(supply: ElectricSupply, store: float) -> float:
    """Power (W) that all loads together may take at a voltage (V) of the store: what is left behind the line."""
    share = saturate((store - supply.least_voltage) / FADE, 1.0)
    current = (supply.converter_power - supply.controller_power + supply.store_power * max(share, 0.0)) / store
    return (store - supply.line_resistance * current) * current


@kernel
def terminal_voltage(supply: ElectricSupply, store: float, load: float) -> float:
    """Voltage (V) at the loads that take a power (W) through the line: of two solutions the one near the store's."""
    resistance = supply.line_resistance
    return 0.5 * (store + math.sqrt(max(store * store - 4.0 * resistance * load, 0.0)))


@kernel
def supply_rates(supply: ElectricSupply, store: float, converter: float, load: float) -> Any:
    """Rates of the store's voltage (V/s) and of the converter's power (W/s) under a load (W), and the powers (W) drawn
    from the source, lost in converter, line and controllers, and delivered to the loads.
    """
    voltage = terminal_voltage(supply, store, load)
    current = load / voltage
    line = supply.line_resistance * current * current
    lacking = supply.converter_gain * (supply.voltage - store) + load + line + supply.controller_power
    wanted = min(max(lacking, 0.0), supply.converter_power)
    drawn = converter / supply.efficiency
    into_store = converter - supply.controller_power - load - line
    return (
        into_store / (supply.capacitance * store),
        (wanted - converter) / supply.converter_lag,
        (drawn, drawn - converter, line, supply.controller_power, load),
    )


@kernel
def store_energy(supply: ElectricSupply, store: float) -> float:
    """Energy (J) in the store, over what it has at the nominal voltage."""
    return 0.5 * supply.capacitance * (store * store - supply.voltage * supply.voltage)
