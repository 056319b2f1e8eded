"""Channels of both axles and what they share, what stands together in plots, and the moments worth a line."""

from typing import Any

from ars_mujoco.actuators.system import BarOutput
from ars_mujoco.actuators.valve_controlled.axle import AxleEnergy, axle_stored
from ars_mujoco.actuators.valve_controlled.block import BlockEnergy, block_stored, coil_power
from ars_mujoco.actuators.valve_controlled.unit import UnitState
from ars_mujoco.hydraulics.pressure_valve import setting_pressure
from ars_mujoco.hydraulics.vane_motor_channels import ChamberedVaneMotorOutput
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import share
from ars_mujoco.schema.channels import channel, stored
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab, axles


class EnergyOutput(AxleEnergy):
    oil: float = stored("stored in the oil's compression")
    bar: float = stored("stored in the bar's torsion and the motor's mechanical stop")
    inertia: float = stored("stored in the motor's inertia")


class AxleOutput(Parameters):
    """What one axle records."""

    bar: BarOutput
    motor: ChamberedVaneMotorOutput
    energy: EnergyOutput


class PumpOutput(Parameters):
    speed: float = channel("rad/s", "speed of the shaft")
    flow: float = channel("m^3/s", "flow of the pump without its leakage")
    intake: float = channel("1", "share of the flow limit that the intake restrictor leaves")
    shaft_power: float = channel("W", "power of the shaft")
    hydraulic_power: float = channel("W", "power of the oil that the pump delivers")


class ValveOutput(Parameters):
    pressure: float = channel("Pa", "pressure of its node over the reservoir's")
    setting: float = channel("Pa", "pressure that its solenoid holds, what it works against being without pressure")
    current: float = channel("A", "current of its solenoid")
    opening: float = channel("1", "opening of the pressure valve")
    loss_power: float = channel("W", "lost over the pressure valve")


class SwitchingOutput(Parameters):
    direction: float = channel("1", "position of the direction valve, 1 gives pressure to chambers A")
    fail_safe: float = channel("1", "opening of the fail-safe valve, 0 shut")


class ElectricOutput(Parameters):
    power: float = channel("W", "electrical power of all valves and the control unit")


class SupplyEnergyOutput(BlockEnergy):
    oil: float = stored("stored in the oil's compression")


class SupplyOutput(Parameters):
    """What pump, valve block and unit record."""

    pump: PumpOutput
    front_valve: ValveOutput
    rear_valve: ValveOutput
    switching: SwitchingOutput
    electric: ElectricOutput
    unit: UnitState
    energy: SupplyEnergyOutput


class Output(Parameters):
    """What the system records."""

    front: AxleOutput
    rear: AxleOutput
    supply: SupplyOutput


def _pressures(axle: str) -> Plot:
    node, command = f"supply.{axle}_valve.pressure", f"supply.unit.{axle}_pressure"
    return Plot(f"{axle} pressures", (node, command, f"{axle}.motor.pressure_a", f"{axle}.motor.pressure_b"))


PLOTS = (
    Tab("front axle", (Plot("motor pressure", ("front.motor.pressure",)),)),
    Tab("rear axle", (Plot("motor pressure", ("rear.motor.pressure",)),)),
    Tab(
        "circuit",
        (
            _pressures("front"),
            _pressures("rear"),
            Plot("direction and fail-safe valve", ("supply.switching.direction", "supply.switching.fail_safe")),
        ),
    ),
    Tab(
        "valves",
        (
            Plot("valve current", ("supply.front_valve.current", "supply.rear_valve.current")),
            Plot("valve opening", ("supply.front_valve.opening", "supply.rear_valve.opening")),
            Plot("unit acts", ("supply.unit.active", "supply.unit.failed")),
        ),
    ),
    Tab(
        "energy",
        (
            Plot("power of the pump", ("supply.pump.shaft_power", "supply.pump.hydraulic_power")),
            Plot(
                "losses",
                ("supply.front_valve.loss_power", "supply.rear_valve.loss_power", *axles("motor.friction_power")),
            ),
            Plot("energy since the start", ("supply.energy.shaft", "supply.energy.generator")),
        ),
    ),
)
DRY = -1e5  # Pa over the reservoir's: there is no pressure left

EVENTS = (
    Condition("supply.unit.failed", "above", 0.0, "ERROR", "the test before driving off fails"),
    Condition("supply.switching.fail_safe", "below", 0.05, "WARN", "the fail-safe valve seals the front motor"),
    Condition("front.motor.pressure_a", "below", DRY, "WARN", "the front motor's chamber A runs dry"),
    Condition("front.motor.pressure_b", "below", DRY, "WARN", "the front motor's chamber B runs dry"),
    Condition("rear.motor.pressure_a", "below", DRY, "WARN", "the rear motor's chamber A runs dry"),
    Condition("rear.motor.pressure_b", "below", DRY, "WARN", "the rear motor's chamber B runs dry"),
)


@kernel
def report_axle(p: Any, state: Any, energy: Any, out: Any, twist: float, powers: Any) -> None:
    """What one axle records; `powers` (W) are in the order of AxleEnergy."""
    _, _, _, leakage, friction, motor = powers
    out.bar.angle = state.angle
    out.motor.pressure, out.motor.rate = state.chamber_a - state.chamber_b, state.rate
    out.motor.pressure_a, out.motor.pressure_b = state.chamber_a, state.chamber_b
    out.motor.output_power, out.motor.leakage_power, out.motor.friction_power = motor, leakage, friction
    share(out.energy, energy)
    out.energy.oil, out.energy.bar, out.energy.inertia = axle_stored(p, twist, state)


@kernel
def report_supply(p: Any, now: Any, out: Any, setting: Any, powers: Any) -> None:
    """What pump and block record; `now` has their `state` and `energy`, `powers` (W) stand as in BlockEnergy."""
    state, block, electrics = now.state.supply, p.block, p.electrics
    shaft, _, loss, _, _, front_loss, rear_loss, _, _, _, _, _, _, _ = powers
    out.pump.speed, out.pump.flow, out.pump.intake = setting.speed, setting.flow, now.drive.intake
    out.pump.shaft_power, out.pump.hydraulic_power = shaft, shaft - loss
    front, rear = out.front_valve, out.rear_valve
    front.pressure, rear.pressure = state.front_pressure, state.rear_pressure
    front.setting = setting_pressure(block.front_valve, state.front_current, state.front_turned)
    rear.setting = setting_pressure(block.rear_valve, state.rear_current, state.rear_turned)
    front.current, rear.current = state.front_current, state.rear_current
    front.opening, rear.opening = state.front_opening, state.rear_opening
    front.loss_power, rear.loss_power = front_loss, rear_loss
    out.switching.direction, out.switching.fail_safe = state.spool, state.fail_safe
    coils = coil_power(block, setting, state.front_current, state.rear_current)
    out.electric.power = coils + electrics.unit_power
    share(out.energy, now.energy.supply)
    out.energy.oil = block_stored(p, state)
