"""Channels of the electromechanical bars and their supply."""

from ars_mujoco.actuators.electromechanical.unit import Energy
from ars_mujoco.actuators.system import BarOutput
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import share
from ars_mujoco.machines.electric_machine import drag
from ars_mujoco.machines.planetary_gear import gear_friction, mesh_energy, mesh_torque
from ars_mujoco.machines.supply_channels import SHED, SUPPLY_TAB, SupplyOutput
from ars_mujoco.schema.channels import channel, stored
from ars_mujoco.schema.parameters import Parameters
from ars_mujoco.schema.plots import Plot, Tab, axles


class MachineOutput(Parameters):
    speed: float = channel("rad/s", "speed of the machine")
    torque: float = channel("Nm", "torque of the machine in its air gap")
    current: float = channel("A", "torque current, amplitude of a phase")
    power: float = channel("W", "electrical power of the unit, negative where it gives back")
    loss_power: float = channel("W", "lost in windings and inverter")


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
    SUPPLY_TAB,
)

EVENTS = (SHED,)


@kernel
def report(axle, state, energy, out, command, twist: float, electric) -> None:
    """What one axle records; `electric` is the Running of its drive, `twist` (rad) its bar's."""
    unit, turned, between = axle.unit, state.angle - twist, state.rotor_angle - state.angle
    gear = unit.gear
    out.bar.angle, out.bar.command = state.angle, command.angle[0]
    out.machine.speed, out.machine.current = gear.ratio * state.rotor_rate, state.current
    out.machine.torque, out.machine.power = electric.torque, electric.drawn
    out.machine.loss_power = electric.copper + electric.inverter
    out.gear.torque = mesh_torque(gear, between)
    braking = drag(unit.drive.machine, out.machine.speed)
    friction = gear_friction(gear, gear.ratio * (electric.torque - braking), out.gear.torque, state.rotor_rate)
    out.gear.loss_power = friction * state.rotor_rate
    share(out.energy, energy)
    out.energy.bar, out.energy.mesh = 0.5 * axle.stiffness * turned * turned, mesh_energy(gear, between)
    out.energy.inertia = 0.5 * unit.rotor_inertia * out.machine.speed**2
    out.energy.bar_inertia = 0.5 * unit.bar_inertia * state.rate**2
