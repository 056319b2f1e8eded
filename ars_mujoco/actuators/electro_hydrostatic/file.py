"""File: what a user writes of an electro-hydrostatic bar, and how it becomes the records that the kernels read."""

from typing import Literal

import numpy as np
from pydantic import model_validator

from ars_mujoco.actuators.electro_hydrostatic.circuit import Circuit
from ars_mujoco.actuators.electro_hydrostatic.control import Control
from ars_mujoco.actuators.system import Torsion
from ars_mujoco.machines.electric_drive import ElectricDrive
from ars_mujoco.machines.electric_supply import ElectricSupply
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.parameters import Parameters, fill

AXLES = ("front", "rear")
VALVES = {"bypass": 0.0, "fail_safe": 1.0}  # their openings at rest


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


def released(file: ElectroHydrostatic) -> ElectroHydrostatic:
    """`file` with the ports of its motors joined: the oil that they displace never meets a pressure, so what they
    displace is nothing to the circuit, and nothing is pumped.
    """
    motors = {name: getattr(file, name).motor.model_copy(update={"displacement": 0.0}) for name in AXLES}
    return file.model_copy(
        update={name: getattr(file, name).model_copy(update={"motor": motors[name]}) for name in AXLES}
    )


def check_valves(file: ElectroHydrostatic, inputs: dict[str, np.record]) -> None:
    """Refuse inputs (SIGNAL records) that move a valve which `file` has not."""
    for name, rest in ((f"{axle}_{valve}", rest) for axle in AXLES for valve, rest in VALVES.items()):
        axle, valve = name.split("_", 1)
        signal = inputs.get(name)
        if signal is None or (signal.values[: int(signal.count)] == rest).all():
            continue
        if getattr(getattr(file, axle), f"{valve}_valve") is None:
            raise InputError(
                f"inputs.{name}: the actuator has no {axle}.{valve}_valve; allowed: with "
                f"--set 'actuator.{axle}.{valve}_valve={{flow: 9 L/min, pressure: 2 bar, time: 20 ms}}'"
            )


def fill_axle(record, axle: Axle, control: Control, torsion: Torsion) -> None:
    """Write one axle into a record of `axle.Axle`; `torsion` is what the car tells of its bar."""
    record.stiffness = torsion.stiffness
    fill(record.circuit, axle)
    fill(record.drive, axle.drive)
    fill(record.control, control)
