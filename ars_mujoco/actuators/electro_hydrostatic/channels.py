"""Channels of both axles and their supply, what stands together in plots, and the moments worth a line."""

from ars_mujoco.actuators.electro_hydrostatic.axle import SENSED, AxleEnergy, AxleState
from ars_mujoco.actuators.electro_hydrostatic.circuit import stored_energies
from ars_mujoco.actuators.system import BarOutput
from ars_mujoco.hydraulics.fixed_pump import fixed_pump_extrapolation
from ars_mujoco.hydraulics.vane_motor_channels import ChamberedVaneMotorOutput, ValveOutput, circuit_tabs
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers, share
from ars_mujoco.machines.supply_channels import SHED, SUPPLY_TAB, SupplyEnergy, SupplyOutput, SupplyState
from ars_mujoco.schema.channels import channel, stored
from ars_mujoco.schema.events import Condition
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab, axles


class State(Parameters):
    """State of both axles and their supply."""

    front: AxleState
    rear: AxleState
    supply: SupplyState


class Energy(Parameters):
    """Their energies since the start."""

    front: AxleEnergy
    rear: AxleEnergy
    supply: SupplyEnergy


class PumpOutput(Parameters):
    speed: float = channel("rad/s", "speed of the shaft")
    flow: float = channel("m^3/s", "flow of the pump without its leakage")
    loss_power: float = channel("W", "lost to the pump's torque loss")
    leakage_power: float = channel("W", "lost to leakage in the pump")
    extrapolation: float = channel(
        "1", "how far the pump is outside the range of its losses, as a share of the range's end"
    )


class MachineOutput(Parameters):
    torque: float = channel("Nm", "torque of the electric machine without its drag")
    current: float = channel("A", "torque current, an amplitude")
    power: float = channel("W", "power drawn from the supply, negative where it is given back")
    copper_power: float = channel("W", "lost in the windings")
    inverter_power: float = channel("W", "lost in the inverter")


class AccumulatorOutput(Parameters):
    pressure: float = channel("Pa", "absolute pressure on the circuit's low side")


class ReliefOutput(Parameters):
    power: float = channel("W", "lost over the relief valves")


class EnergyOutput(AxleEnergy):
    oil: float = stored("stored in the oil's compression")
    accumulator: float = stored("stored in the gas of the accumulator")
    rotor: float = stored("stored in the inertia of machine and pump")
    bar: float = stored("stored in the bar's torsion and the motor's mechanical stop")
    inertia: float = stored("stored in the motor's inertia")


class AxleOutput(Parameters):
    """What one axle records."""

    bar: BarOutput
    motor: ChamberedVaneMotorOutput
    pump: PumpOutput
    machine: MachineOutput
    accumulator: AccumulatorOutput
    relief: ReliefOutput
    valve: ValveOutput
    energy: EnergyOutput


class Output(Parameters):
    """What both axles and their supply record."""

    front: AxleOutput
    rear: AxleOutput
    supply: SupplyOutput


PLOTS = (
    *circuit_tabs("accumulator.pressure"),
    Tab(
        "machine",
        (
            Plot("pump speed", axles("pump.speed")),
            Plot("machine torque", axles("machine.torque")),
            Plot("machine power", axles("machine.power")),
        ),
    ),
    Tab(
        "energy",
        (
            Plot("losses of the oil", axles("pump.leakage_power", "motor.leakage_power", "pump.loss_power")),
            Plot("losses of the current", axles("machine.copper_power", "machine.inverter_power")),
            Plot("energy since the start", axles("energy.electrical")),
        ),
    ),
    SUPPLY_TAB,
)
LOW = 1e5  # Pa, absolute: below it oil gives off its air


def _events(axle: str) -> tuple[Condition, ...]:
    return (
        Condition(f"{axle}.relief.power", "above", 0.0, "WARN", f"the {axle} relief valve opens"),
        Condition(f"{axle}.motor.pressure_a", "below", LOW, "WARN", f"the {axle} motor's chamber A runs dry"),
        Condition(f"{axle}.motor.pressure_b", "below", LOW, "WARN", f"the {axle} motor's chamber B runs dry"),
        Condition(
            f"{axle}.pump.extrapolation", "above", 0.0, "WARN", f"the {axle} pump leaves the range of its losses"
        ),
    )


EVENTS = (
    *_events("front"),
    *_events("rear"),
    SHED,
)


@kernel
def report(p, now, energy, out, demand, electric, powers) -> None:
    """What one axle records.

    `now` and `energy` are its AxleState and AxleEnergy, `electric` is the Running of its drive, `powers` (W) are in the
    order of AxleEnergy.
    """
    _, _, _, _, pump_loss, pump_leak, motor_leak, relief, _, _, friction, motor = powers
    out.bar.angle, out.bar.command = now.angle, demand.command.angle[0]
    out.motor.pressure, out.motor.rate = now.motor_a - now.motor_b, now.rate
    out.motor.pressure_a, out.motor.pressure_b = now.motor_a, now.motor_b
    out.motor.output_power, out.motor.leakage_power, out.motor.friction_power = motor, motor_leak, friction
    out.pump.speed, out.pump.flow = now.speed, p.circuit.pump.displacement * now.speed
    out.pump.loss_power, out.pump.leakage_power = pump_loss, pump_leak
    out.pump.extrapolation = fixed_pump_extrapolation(p.circuit.pump, now.speed, now.pump_a - now.pump_b)
    out.machine.torque, out.machine.current = electric.torque, now.current
    out.machine.power, out.machine.copper_power = electric.drawn, electric.copper
    out.machine.inverter_power = electric.inverter
    out.accumulator.pressure, out.relief.power = now.accumulator, relief
    out.valve.bypass, out.valve.fail_safe = now.bypass, now.fail_safe
    share(out.energy, energy)
    oil, gas, rotor, bar, inertia = stored_energies(p.circuit, p.stiffness, demand.twist, numbers(now)[0:SENSED])
    out.energy.oil, out.energy.accumulator, out.energy.rotor = oil, gas, rotor
    out.energy.bar, out.energy.inertia = bar, inertia
