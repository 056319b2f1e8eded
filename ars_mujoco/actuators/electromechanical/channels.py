"""Channels of the electromechanical bars and their supply."""

from ars_mujoco.actuators.electromechanical.unit import Energy
from ars_mujoco.schema.channels import channel, delivered, drawn, lost, stored
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab, axles


class BarOutput(Parameters):
    angle: float = channel("rad", "angle between the bar's halves")
    command: float = channel(
        "rad", "commanded angle; of a unit that follows a torque the angle at which the bar gives it"
    )


class MachineOutput(Parameters):
    speed: float = channel("rad/s", "speed of the machine")
    torque: float = channel("Nm", "torque of the machine in its air gap")
    current: float = channel("A", "torque current, amplitude of a phase")
    power: float = channel("W", "electrical power of the unit, negative where it gives back")
    loss_power: float = channel("W", "lost in windings, inverter, iron and bearings")


class GearOutput(Parameters):
    torque: float = channel("Nm", "torque of the meshing teeth at the output")
    loss_power: float = channel("W", "lost to friction in the gear")


class EnergyOutput(Energy):
    bar: float = stored("stored in the bar's torsion")
    mesh: float = stored("stored in the gear's torsion")
    inertia: float = stored("stored in the machine's inertia")
    bar_inertia: float = stored("stored in the inertia of the output and the bar's halves")


class AxleOutput(Parameters):
    """What one axle's unit records."""

    bar: BarOutput
    machine: MachineOutput
    gear: GearOutput
    energy: EnergyOutput


class SupplyEnergy(Parameters):
    source: float = drawn("drawn from the source by the converter")
    converter: float = lost("lost in the converter")
    line: float = lost("lost in the line to the loads")
    controllers: float = lost("taken by control units")
    loads: float = delivered("delivered to the units of both axles, less what they gave back")


class SupplyEnergyOutput(SupplyEnergy):
    store: float = stored("stored in the store, over what it holds at its nominal voltage")


class SupplyOutput(Parameters):
    """What the supply records."""

    voltage: float = channel("V", "voltage at the loads")
    power: float = channel("W", "power of the converter")
    load: float = channel("W", "power of the loads together")
    share: float = channel("1", "share that the loads get of the power they ask for")
    energy: SupplyEnergyOutput


class Output(Parameters):
    """What both axles and their supply record."""

    front: AxleOutput
    rear: AxleOutput
    supply: SupplyOutput


PLOTS = (
    Tab("front axle", (Plot("machine current", ("front.machine.current",)),)),
    Tab("rear axle", (Plot("machine current", ("rear.machine.current",)),)),
    Tab(
        "machine",
        (
            Plot("machine speed", axles("machine.speed")),
            Plot("machine torque", axles("machine.torque")),
            Plot("machine power", axles("machine.power")),
        ),
    ),
    Tab(
        "supply",
        (
            Plot("supply voltage", ("supply.voltage",)),
            Plot("supply power", ("supply.power", "supply.load")),
            Plot("share of the power asked for", ("supply.share",)),
        ),
    ),
)

EVENTS = (
    Condition("supply.share", "below", 0.999, "WARN", "the supply sheds load: both axles get less than they ask"),
)
