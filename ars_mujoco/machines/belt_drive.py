"""Belt drive: what turns the shaft of one pump: a constant speed, a table or an engine (paper section 3).

The speed is set once a physics step and kept over it.
"""

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from ars_mujoco.excitation.knots import SIGNAL, KnotsOf, value
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.machines.engine import GEARBOX, Engine, engine_speed, gear
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, fill, quantity, record_dtype

CONSTANT, TABLE, ENGINE = 0.0, 1.0, 2.0


class ConstantSpeed(Parameters):
    """The pump at one speed."""

    kind: Literal["constant"]
    speed: float = quantity("rad/s", ge=0)


class SpeedTable(Parameters):
    """The pump at a speed over time; zero is an engine that is off, or a belt that is lost."""

    kind: Literal["table"]
    speed: KnotsOf("rad/s", ge=0)  # type: ignore[valid-type]  # a class, made where it is named


BeltDrive = Annotated[ConstantSpeed | SpeedTable | Engine, Field(discriminator="kind")]

BELT_DRIVE = np.dtype(
    [
        ("kind", "f8"),  # one of the above
        ("constant", "f8"),  # rad/s
        ("table", SIGNAL),  # rad/s
        ("engine", record_dtype(Engine)),
        ("gearbox", GEARBOX),
    ]
)


class BeltDriveState(Parameters):
    gear: float = channel("1", "gear of the engine, 0 the first")


@kernel
def pump_speed(drive: Any, now: Any, later: Any, time: float, road_speed: float) -> float:
    """Speed (rad/s) of the pump over the step that begins at `time` (s), at a road speed (m/s); shifts the gear."""
    if drive.kind == ENGINE:
        later.gear = gear(drive.engine, drive.gearbox, now.gear, road_speed)
        return drive.engine.pump_ratio * engine_speed(drive.engine, drive.gearbox, later.gear, road_speed)
    speed: float = value(drive.table, time) if drive.kind == TABLE else drive.constant  # type: ignore[no-untyped-call]
    return speed


def fill_belt_drive(record: Any, drive: Any) -> None:
    """Write a BeltDrive into a BELT_DRIVE record."""
    match drive:
        case ConstantSpeed():
            record.kind, record.constant = CONSTANT, drive.speed
        case SpeedTable():
            record.kind, record.table = TABLE, drive.speed.signal()
        case Engine(ratios=ratios):
            record.kind, record.gearbox.count = ENGINE, len(ratios)
            record.gearbox.ratios[: len(ratios)] = ratios
            fill(record.engine, drive)


def first_speed(drive: Any) -> float:
    """Speed (rad/s) of the pump at the start, of a BELT_DRIVE record; with an engine that of its idle."""
    if drive.kind == ENGINE:
        return float(drive.engine.pump_ratio * drive.engine.idle_speed)
    return float(drive.table["values"][0] if drive.kind == TABLE else drive.constant)
