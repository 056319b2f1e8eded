"""File: what a user writes of a valve-controlled system, and how it becomes the records that the kernels read."""

from typing import Literal

import numpy as np
from pydantic import ValidationInfo, field_validator

from ars_mujoco.actuators.system import Car
from ars_mujoco.actuators.valve_controlled.axle import Axle
from ars_mujoco.actuators.valve_controlled.block import Block, Electrics
from ars_mujoco.actuators.valve_controlled.unit import Control
from ars_mujoco.hydraulics.radial_piston_pump import RadialPistonPump
from ars_mujoco.machines.belt_drive import BeltDrive, fill_belt_drive
from ars_mujoco.machines.engine import Engine
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill

AXLES = ("front", "rear")


class ValveControlled(Parameters):
    """The valve-controlled active bars, front and rear, on one pump."""

    kind: Literal["valve_controlled"]
    drive: BeltDrive  # of the pump
    pump: RadialPistonPump
    block: Block
    electrics: Electrics
    control: Control
    front: Axle
    rear: Axle

    @field_validator("control")
    @classmethod
    def _is_reached(cls, control: Control, info: ValidationInfo) -> Control:
        block = info.data.get("block")
        for axle in AXLES if block else ():
            wanted, most = getattr(control, f"{axle}_pressure"), getattr(block, f"{axle}_valve").pressure_range
            if wanted > most:
                raise ValueError(
                    f"{axle}_pressure is {1e-5 * wanted:.4g} bar, which block.{axle}_valve does not hold; allowed: "
                    f"up to its pressure_range, {1e-5 * most:.4g} bar"
                )
        return control


def released(file: ValveControlled) -> ValveControlled:
    """`file` with the ports of its motors joined: the oil that they displace never meets a pressure."""
    free = {}
    for name in AXLES:
        axle = getattr(file, name)
        motor = axle.motor.model_copy(update={"displacement": 0.0})
        free[name] = axle.model_copy(update={"motor": motor})
    return file.model_copy(update=free)


def fill_system(record: np.record, file: ValveControlled, car: Car, step: float) -> None:
    """Write all parameters but the substeps; the physics step is in s.

    Raises InputError where the rig does not serve what the file asks for.
    """
    if isinstance(file.drive, Engine) and not car.has_road:
        raise InputError(
            "actuator.drive.kind: 'engine' turns with the road speed, which this rig has not; allowed: constant, table"
        )
    samples = file.control.sample_time / step
    if abs(samples - round(samples)) > 1e-6:
        raise InputError(
            f"actuator.control.sample_time: {file.control.sample_time:g} s is not a whole multiple of the time step "
            f"{step:g} s"
        )
    fill_belt_drive(record.drive, file.drive)
    for name in ("pump", "block", "electrics", "control"):
        fill(record[name], getattr(file, name))
    for name, torsion in (("front", car.front), ("rear", car.rear or car.front)):
        fill(record[name].axle, getattr(file, name))
        record[name].stiffness = torsion.stiffness
    record.has_rear, record.has_road = car.rear is not None, car.has_road
