"""Actuators: the stabilizers a user can choose, read from a file and turned into the two axles' parameters."""

from typing import Annotated, Literal

from pydantic import Field

from ars_mujoco.actuators.axle import NO_BAR, PUMP_CONTROLLED, TORSION_BAR
from ars_mujoco.actuators.drive import Constant, Drive
from ars_mujoco.hydraulics.reduced_circuit import ReducedCircuit
from ars_mujoco.hydraulics.substeps import substeps
from ars_mujoco.parameters import Parameters, fill


class NoBar(Parameters):
    """No stabilizer bar at all."""

    kind: Literal["none"]


class Passive(Parameters):
    """A conventional bar, with the stiffness the vehicle states for each axle."""

    kind: Literal["passive"]


class Locked(Parameters):
    """The active bar with its motor held: torsion only, with the active bar's stiffness."""

    kind: Literal["locked"]


class PumpControlled(Parameters):
    """The pump-controlled active bar, front and rear."""

    kind: Literal["pump_controlled"]
    circuit: Literal["reduced"] = "reduced"
    drive: Drive = Constant(kind="constant")
    front: ReducedCircuit
    rear: ReducedCircuit


Actuator = Annotated[NoBar | Passive | Locked | PumpControlled, Field(discriminator="kind")]


def fill_axle(record, actuator: Actuator, axle: str, stiffness: float, passive_stiffness: float, step: float):
    """Write the parameters of one axle ("front" or "rear") of `actuator` into an `axle.Axle` record.

    `stiffness` and `passive_stiffness` (Nm/rad) are the torsion of the active bar and of the conventional one in its
    place; the physics step (s) is divided into substeps.
    """
    match actuator:
        case NoBar():
            record.kind = NO_BAR
        case Passive():
            record.kind, record.stiffness = TORSION_BAR, passive_stiffness
        case Locked():
            record.kind, record.stiffness = TORSION_BAR, stiffness
        case PumpControlled():
            record.kind, record.stiffness = PUMP_CONTROLLED, stiffness
            fill(record.circuit, getattr(actuator, axle))
            record.substeps = substeps(record.circuit, stiffness, step)
