"""Torsion bar: a spring between the wheels, or none; conventional, or the active bar with its motor held."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ars_mujoco.actuators.system import NOTHING, Car
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.schema.channels import stored
from ars_mujoco.schema.parameters import Parameters

NAME = "torsion_bar"
FOLLOWS = "nothing"


class NoBar(Parameters):
    """No stabilizer bar at all."""

    kind: Literal["none"]


class Passive(Parameters):
    """A conventional bar, with the stiffness the vehicle states for each axle."""

    kind: Literal["passive"]


class Locked(Parameters):
    """The active bar with its motor held: torsion only, with the active bar's stiffness."""

    kind: Literal["locked"]


File = Annotated[NoBar | Passive | Locked, Field(discriminator="kind")]


class EnergyOutput(Parameters):
    bar: float = stored("stored in the bar's torsion")


class AxleOutput(Parameters):
    energy: EnergyOutput


class Output(Parameters):
    """What both bars record."""

    front: AxleOutput
    rear: AxleOutput


PARAMETERS = np.dtype([("front", "f8"), ("rear", "f8")])  # Nm/rad
STATE = NOTHING


@kernel
def advance(p, now, later, out, work, command, twists, moment):
    """Torques (Nm) of two springs."""
    out.front.energy.bar = 0.5 * p.front * twists.front.angle * twists.front.angle
    out.rear.energy.bar = 0.5 * p.rear * twists.rear.angle * twists.rear.angle
    return -p.front * twists.front.held, -p.rear * twists.rear.held


@kernel
def sense(p, now, sensors) -> None:
    """Nothing turns between the halves, and nothing measures."""
    sensors.front_angle = sensors.rear_angle = 0.0
    sensors.front_torque = sensors.rear_torque = 0.0


@kernel
def is_beyond(p, state) -> bool:
    """Never: a spring has no limit here."""
    return False


def fill(record, file: NoBar | Passive | Locked, car: Car, step: float) -> None:
    """Write the torsion of each bar (Nm/rad)."""
    for axle, torsion in (("front", car.front), ("rear", car.rear)):
        match file:
            case Passive() if torsion:
                record[axle] = torsion.passive_stiffness
            case Locked() if torsion:
                record[axle] = torsion.stiffness
            case _:
                record[axle] = 0.0


def start(record, state) -> None:
    """A spring has no state."""
