"""File: what a user writes of an electro-hydrostatic bar, and how it becomes the records that the kernels read."""

from typing import Literal

from pydantic import model_validator

from ars_mujoco.actuators.electro_hydrostatic.circuit import Circuit
from ars_mujoco.actuators.electro_hydrostatic.control import Control
from ars_mujoco.actuators.system import Torsion
from ars_mujoco.machines.electric_drive import ElectricDrive
from ars_mujoco.machines.electric_supply import ElectricSupply
from ars_mujoco.schema.parameters import Parameters, fill

AXLES = ("front", "rear")


class Axle(Circuit):
    """One axle's circuit, and the drive of its pump."""

    drive: ElectricDrive


class ElectroHydrostatic(Parameters):
    """The electro-hydrostatic active bar, front and rear, on one supply."""

    kind: Literal["electro_hydrostatic"]
    supply: ElectricSupply
    control: Control
    front: Axle
    rear: Axle

    @model_validator(mode="after")
    def _low_side_is_fed(self) -> "ElectroHydrostatic":
        for name in AXLES:
            axle = getattr(self, name)
            if axle.check_valve.opening_pressure >= axle.accumulator.pressure:
                raise ValueError(
                    f"{name}.check_valve.opening_pressure is {1e-5 * axle.check_valve.opening_pressure:.4g} bar, which "
                    f"the accumulator's {1e-5 * axle.accumulator.pressure:.4g} bar do not open; allowed: less than that"
                )
        return self


def fill_axle(record, axle: Axle, control: Control, torsion: Torsion) -> None:
    """Write one axle into a record of `axle.Axle`; `torsion` is what the car tells of its bar."""
    record.stiffness = torsion.stiffness
    fill(record.circuit, axle)
    fill(record.drive, axle.drive)
    fill(record.control, control)
