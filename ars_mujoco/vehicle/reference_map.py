"""Reference map of a vehicle: the bar angles that hold its body at a target roll, by the statics of its own model."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from ars_mujoco.control.reference_map import KNOTS
from ars_mujoco.control.target import target_roll
from ars_mujoco.schema.errors import ArsError
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import GRAVITY, Sedan
from ars_mujoco.vehicle.statics import Equilibrium, Statics, bar_stiffness

TARGET = ((0.0, 0.0), (0.3 * GRAVITY, 0.0), (0.6 * GRAVITY, math.radians(0.3)), (0.8 * GRAVITY, math.radians(1.3)))


@dataclass(frozen=True)
class ReferenceMap:
    """Bar angles over the sensor's reading; arrays of shape (n,), SI units."""

    lateral_acceleration: np.ndarray
    reading: np.ndarray
    roll: np.ndarray
    front_angle: np.ndarray
    rear_angle: np.ndarray
    front_torque: np.ndarray
    rear_torque: np.ndarray


def reference_map(
    model: mujoco.MjModel,
    vehicle: Sedan | RollPlane,
    target: tuple[tuple[float, float], ...] = TARGET,
    front_share: float = 0.6,
    largest: float = 1.1 * GRAVITY,
    points: int = KNOTS,
) -> ReferenceMap:
    """The bar angles that hold the body at `target`, knots of (lateral acceleration m/s^2, roll rad) from (0, 0) on.

    Beyond the last knot its slope goes on, up to `largest` or as far as the car stands on its wheels; `front_share` of
    the bars' torque is the front's. At most `points` rows, the knots among them. A bar's angle is its twist plus what
    its torsion needs: phi = psi + M / c.
    Raises ArsError where the target itself cannot be held.
    """
    statics, knots = Statics(model, vehicle), np.array(target)[:, 0]
    stiffness = bar_stiffness(vehicle, "locked")
    rows: list[Equilibrium] = []
    for lateral in _rows(knots, largest, points):
        try:
            rows.append(statics.held(lateral, target_roll(target, lateral), front_share))
        except ArsError:
            if lateral <= knots[-1]:
                raise
            break
    torque = np.array([row.torque for row in rows])
    angle = np.array([row.twist for row in rows]) + torque / stiffness
    return ReferenceMap(
        lateral_acceleration=np.array([row.lateral_acceleration for row in rows]),
        reading=np.array([row.reading for row in rows]),
        roll=np.array([row.roll for row in rows]),
        front_angle=angle[:, 0],
        rear_angle=angle[:, 1],
        front_torque=torque[:, 0],
        rear_torque=torque[:, 1],
    )


def _rows(knots: np.ndarray, largest: float, points: int) -> np.ndarray:
    """The knots and an even grid up to `largest`, less what of it falls on a knot; at most `points` in all."""
    grid = np.linspace(0.0, largest, points - len(knots) + 1)
    apart = np.abs(grid[:, None] - knots).min(axis=1) > 1e-3 * largest
    return np.sort(np.append(knots, grid[apart]))
