"""Channels of an electric supply: its state, its energies and what it records, for every system that has one."""

from typing import Any

from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import share
from ars_mujoco.machines.electric_supply import ElectricSupply, store_energy, terminal_voltage
from ars_mujoco.schema.channels import channel, delivered, drawn, lost, stored
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab


class SupplyState(Parameters):
    """State of the supply."""

    store: float = channel("V", "voltage of the store", scale=1e-4)
    converter: float = channel("W", "power of the converter to the store", scale=1e-1)


class SupplyEnergy(Parameters):
    """Energies of the supply since the start, in the order of the powers of `supply_rates`."""

    source: float = drawn("drawn from the source")
    converter: float = lost("lost in the converter")
    line: float = lost("lost in the line to the drives")
    controllers: float = lost("drawn by control units")
    loads: float = delivered("delivered to both drives, less what they gave back")


class SupplyEnergyOutput(SupplyEnergy):
    store: float = stored("stored in the store, over what it has at its nominal voltage")


class SupplyOutput(Parameters):
    """What the supply records."""

    voltage: float = channel("V", "voltage at the drives")
    power: float = channel("W", "power of the converter")
    load: float = channel("W", "power of both drives together")
    share: float = channel("1", "share that the drives get of the power they wish for")
    energy: SupplyEnergyOutput


SUPPLY_TAB = Tab(
    "supply",
    (
        Plot("supply voltage", ("supply.voltage",)),
        Plot("supply power", ("supply.power", "supply.load")),
        Plot("share of the power asked for", ("supply.share",)),
    ),
)
SHED = Condition("supply.share", "below", 0.999, "WARN", "the supply sheds load: both axles get less than they ask")


@kernel
def report_supply(
    supply: ElectricSupply, now: Any, energy: SupplyEnergy, out: Any, load: float, granted: float
) -> None:
    """What the supply records under a load (W), where the drives get the share `granted` of what they wish for."""
    out.voltage, out.power = terminal_voltage(supply, now.store, load), now.converter
    out.load, out.share = load, granted
    share(out.energy, energy)
    out.energy.store = store_energy(supply, now.store)


def rest_supply(supply: ElectricSupply, state: Any, standby: float) -> None:
    """Write the supply's state at rest: its converter feeds what is always on, drives with a `standby` (W) among it."""
    voltage = terminal_voltage(supply, supply.voltage, standby)
    line = supply.line_resistance * (standby / voltage) ** 2
    state.store, state.converter = supply.voltage, supply.controller_power + standby + line
