"""Drives that an actuator's file can name, and how they become the record that the kernels read."""

from typing import Annotated, Literal

from pydantic import Field

from ars_mujoco.actuators.pump_controlled import drive_speed as kinds
from ars_mujoco.excitation.knots import KnotsOf
from ars_mujoco.machines.engine import Engine
from ars_mujoco.machines.pump_drive import PumpDrive
from ars_mujoco.schema.parameters import Parameters, fill


class Constant(Parameters):
    """Each pump at its own `pump.speed`."""

    kind: Literal["constant"]


class Table(Parameters):
    """Both pumps at a speed over time; zero is an engine that is off."""

    kind: Literal["table"]
    speed: KnotsOf("rad/s", ge=0)


Drive = Annotated[Constant | Table | Engine | PumpDrive, Field(discriminator="kind")]


def first_speed(drive: Drive, stated: float) -> float:
    """Speed (rad/s) of a pump at the start, of which its file states `stated`; an engine is charged at that too."""
    match drive:
        case Table():
            return float(drive.speed.signal().values[0])
        case PumpDrive():
            return drive.speed
    return stated


def fill_drive(record, drive: Drive) -> None:
    """Write `drive` into a DRIVE record."""
    match drive:
        case Constant():
            record.kind = kinds.CONSTANT
        case Table():
            record.kind, record.speed = kinds.TABLE, drive.speed.signal()
        case Engine(ratios=ratios):
            record.kind, record.gearbox.count = kinds.ENGINE, len(ratios)
            record.gearbox.ratios[: len(ratios)] = ratios
            fill(record.engine, drive)
        case PumpDrive():
            record.kind = kinds.ELECTRIC
            fill(record.electric, drive)
