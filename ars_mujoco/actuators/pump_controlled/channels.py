"""Channels of one axle's circuit: those that every stage has, and what the cylinder and the full circuit add."""

from ars_mujoco.actuators.pump_controlled.drive_speed import DriveOutput
from ars_mujoco.actuators.pump_controlled.full_circuit import FullCircuitEnergy
from ars_mujoco.actuators.pump_controlled.third_order_circuit import CircuitEnergy
from ars_mujoco.actuators.system import BarOutput
from ars_mujoco.hydraulics.vane_motor_channels import ChamberedVaneMotorOutput, ValveOutput, VaneMotorOutput
from ars_mujoco.schema.channels import channel, stored
from ars_mujoco.schema.parameters import Parameters


class PumpOutput(Parameters):
    speed: float = channel("rad/s", "speed of the shaft")
    stroke: float = channel("1", "stroke of the swash plate, fraction of full")
    flow: float = channel("m^3/s", "flow of the pump without its leakage")
    shaft_power: float = channel("W", "power taken from the shaft, negative where it is given back")
    loss_power: float = channel("W", "lost to the pump's torque loss")
    leakage_power: float = channel("W", "lost to leakage in the pump, its flow loss")
    extrapolation: float = channel(
        "1", "how far the pump is outside the range of its losses, as a share of the range's end"
    )


class CylinderPumpOutput(PumpOutput):
    control_pressure: float = channel(
        "Pa", "pressure difference across the control cylinder (where pump control has one)"
    )


class FullPumpOutput(CylinderPumpOutput):
    pressure_a: float = channel("Pa", "absolute pressure at the pump's port to side A")
    pressure_b: float = channel("Pa", "absolute pressure at its port to side B")


class ReliefOutput(Parameters):
    power: float = channel("W", "lost over the relief valve")


class ChargeOutput(Parameters):
    power: float = channel("W", "power drawn by charge and control supply")


class FullChargeOutput(ChargeOutput):
    pressure: float = channel("Pa", "absolute pressure of the charge line")


class EnergyOutput(CircuitEnergy):
    oil: float = stored("stored in the oil's compression")
    bar: float = stored("stored in the bar's torsion and the motor's mechanical stop")
    inertia: float = stored("stored in the motor's inertia")


class FullEnergyOutput(FullCircuitEnergy):
    oil: float = stored("stored in the oil's compression")
    bar: float = stored("stored in the bar's torsion and the motor's mechanical stop")
    inertia: float = stored("stored in the motor's inertia")
    oil_motion: float = stored("stored in the moving oil of the lines")


class AxleOutput(Parameters):
    """What one axle records with the reduced circuit."""

    bar: BarOutput
    motor: VaneMotorOutput
    pump: PumpOutput
    relief: ReliefOutput
    charge: ChargeOutput
    energy: EnergyOutput


class CylinderAxleOutput(AxleOutput):
    """The same where pump control has a cylinder."""

    pump: CylinderPumpOutput


class FullAxleOutput(CylinderAxleOutput):
    """What one axle records with the full circuit."""

    motor: ChamberedVaneMotorOutput
    pump: FullPumpOutput
    charge: FullChargeOutput
    valve: ValveOutput
    energy: FullEnergyOutput


class Output(Parameters):
    """What both axles and their drive record with reduced circuits."""

    front: AxleOutput
    rear: AxleOutput
    drive: DriveOutput


class CylinderOutput(Parameters):
    """The same where pump control has a cylinder."""

    front: CylinderAxleOutput
    rear: CylinderAxleOutput
    drive: DriveOutput


class FullOutput(Parameters):
    """The same with full circuits."""

    front: FullAxleOutput
    rear: FullAxleOutput
    drive: DriveOutput
