"""Displacement: sizes of a motor that turns a load, and of the pump that turns the motor, with what both lose."""

from ars_mujoco.hydraulics.vane_motor import VaneMotor


def motor_displacement(motor: VaneMotor, torque: float, rate: float, pressure: float) -> float:
    """D (m^3/rad) for a torque (Nm) at a rate (rad/s) and a pressure (Pa), besides the friction of `motor`."""
    return (torque + motor.coulomb_friction + motor.viscous_friction * rate) / pressure


def pump_flow(displacement: float, rate: float, leakage: float, pressure: float) -> float:
    """Flow (m^3/s) that a motor of `displacement` (m^3/rad) takes at a rate (rad/s), with what leaks (m^3/s/Pa)."""
    return displacement * rate + leakage * pressure
