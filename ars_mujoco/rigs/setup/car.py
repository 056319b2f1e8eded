"""What the set-ups of both cars share: addresses, and the reference with its map from the statics."""

from pathlib import Path

import numpy as np

from ars_mujoco.actuators.system import Torsion, is_active
from ars_mujoco.control.controller import Controller
from ars_mujoco.control.law import Law, law
from ars_mujoco.control.reference import BOTH
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import ArsError, InputError
from ars_mujoco.schema.parameters import fill
from ars_mujoco.vehicle.reference_map import reference_map
from ars_mujoco.vehicle.roll_plane import RollPlane, RollPlaneBar
from ars_mujoco.vehicle.sedan import GRAVITY, Bar, Sedan


def fill_addresses(record, values: dict) -> None:
    """Write the numbers of things in the model, by name, into a record of addresses."""
    for name, value in values.items():
        if isinstance(value, dict):
            fill_addresses(record[name], value)
        else:
            record[name] = value


def law_of(controller: Controller) -> Law | None:
    """The user's law, where the controller names one."""
    return law(Path(controller.law)) if controller.law else None


def torsion(bar: Bar | RollPlaneBar) -> Torsion:
    """What a system is told of a bar."""
    return Torsion(bar.stiffness, bar.passive_stiffness)


def fill_reference(start: Start, controller: Controller, vehicle: RollPlane | Sedan) -> None:
    """Write the accelerometer and, where bars are active, the target as bar angles and torques by the statics of this
    model.
    """
    record, model = start.parameters.reference, start.simulation.model
    if controller.reference is None:
        raise InputError("controller.reference: is missing; only the bench does without")
    reference = controller.reference
    for name in ("accelerometer", "fade", "trim"):
        fill(record[name], getattr(reference, name))
    record.gravity, record.gives = GRAVITY, start.law.gives if start.law else BOTH
    if is_active(start.rig.system):
        try:
            table = reference_map(model, vehicle, reference.target, reference.front_share)
        except ArsError as error:
            raise InputError(f"controller.reference.target: this vehicle does not hold it: {error}") from None
        except (np.linalg.LinAlgError, ArithmeticError) as error:
            reference_map(model, vehicle)  # of a usual target: it fails too where the vehicle is at fault
            raise InputError(f"controller.reference: its target and its share do not go together: {error}") from None
        if not (np.diff(table.reading) > 0.0).all():
            raise InputError(
                "controller.reference.target: the roll falls so steeply that the accelerometer, which feels a part of "
                "gravity, reads less at more lateral acceleration"
            )
        record.map.count = len(table.reading)
        columns = {
            "sensor": table.reading, "roll": table.roll, "front": table.front_angle, "rear": table.rear_angle,
            "front_torque": table.front_torque, "rear_torque": table.rear_torque,
        }  # fmt: skip
        for name, column in columns.items():
            record.map[name][: len(column)] = column
