"""What the set-ups of both cars share: addresses, stabilizers, and the reference with its map from the statics."""

import mujoco
import numpy as np

from ars_mujoco.actuators.actuator import Actuator, PumpControlled
from ars_mujoco.control.controller import Controller
from ars_mujoco.rigs.setup.start import Start
from ars_mujoco.schema.errors import ArsError, InputError
from ars_mujoco.schema.parameters import fill
from ars_mujoco.vehicle.reference_map import reference_map
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import GRAVITY, Sedan


def fill_addresses(record, values: dict) -> None:
    """Write the numbers of things in the model, by name, into a record of addresses."""
    for name, value in values.items():
        if isinstance(value, dict):
            fill_addresses(record[name], value)
        else:
            record[name] = value


def fill_stabilizers(start: Start, actuator: Actuator, front_bar, rear_bar) -> None:
    """Write both axles of `actuator`; the bars give their stiffnesses."""
    for axle, bar in (("front", front_bar), ("rear", rear_bar)):
        start.fill_stabilizer(axle, actuator, bar.stiffness, bar.passive_stiffness)


def fill_reference(
    record, model: mujoco.MjModel, actuator: Actuator, controller: Controller, vehicle: RollPlane | Sedan
) -> None:
    """Write the accelerometer and, where bars are active, the target as bar angles by the statics of this model."""
    if controller.reference is None:
        raise InputError("controller.reference: is missing; only the bench does without")
    reference = controller.reference
    for name in ("accelerometer", "fade", "trim"):
        fill(record[name], getattr(reference, name))
    record.gravity = GRAVITY
    if isinstance(actuator, PumpControlled):
        try:
            table = reference_map(model, vehicle, reference.target, reference.front_share)
        except ArsError as error:
            raise InputError(f"controller.reference.target: this vehicle does not hold it: {error}") from None
        if not (np.diff(table.reading) > 0.0).all():
            raise InputError(
                "controller.reference.target: the roll falls so steeply that the accelerometer, which feels a part of "
                "gravity, reads less at more lateral acceleration"
            )
        record.map.count = len(table.reading)
        columns = {
            "sensor": table.reading, "roll": table.roll, "front": table.front_angle, "rear": table.rear_angle,
        }  # fmt: skip
        for name, column in columns.items():
            record.map[name][: len(column)] = column
