"""Solids of a MuJoCo scene in Rerun, all of one kind on a body in one entity."""

from collections.abc import Callable, Sequence

import numpy as np

from ars_mujoco.recording.recording import Geom
from ars_mujoco.recording.rerun.batch import Batch
from ars_mujoco.recording.rerun.look import Look
from ars_mujoco.recording.rerun.rotation import axis, matrices

SOLID = np.array([[3]], np.uint8)  # Rerun's fill mode


def add_solids(batch: Batch, entity: str, geoms: Sequence[Geom], look: Look) -> None:
    """Add `geoms` of one body to a static batch, below `entity`: `<entity>/box`, `<entity>/capsule` and so on."""
    for kind, (archetype, shape) in KINDS.items():
        alike = [geom for geom in geoms if geom.type == kind]
        if not alike:
            continue
        size, pos, quat = (np.array([getattr(geom, name) for geom in alike]) for name in ("size", "pos", "quat"))
        columns = shape(size, pos, quat) | {
            "quaternions": quat[:, [1, 2, 3, 0]],
            "colors": np.array([look.geom_color(geom.rgba) for geom in alike], np.uint32),
        }
        for name, values in columns.items():
            batch.add(f"{entity}/{kind}", f"{archetype}:{name}", values[None])
        batch.add(f"{entity}/{kind}", f"{archetype}:fill_mode", SOLID)


def extent(geoms: Sequence[Geom]) -> tuple[np.ndarray, np.ndarray]:
    """The least and greatest coordinates (3,) m, in the body's frame, of boxes around `geoms`."""
    half = np.array([HALF_SIZES[geom.type](*geom.size) for geom in geoms])
    half = np.einsum("nij,nj->ni", np.abs(matrices(np.array([geom.quat for geom in geoms]))), half)
    pos = np.array([geom.pos for geom in geoms])
    return (pos - half).min(0), (pos + half).max(0)


def _box(size: np.ndarray, pos: np.ndarray, quat: np.ndarray) -> dict[str, np.ndarray]:
    return {"half_sizes": size, "centers": pos}


def _sphere(size: np.ndarray, pos: np.ndarray, quat: np.ndarray) -> dict[str, np.ndarray]:
    return {"half_sizes": np.repeat(size[:, :1], 3, axis=1), "centers": pos}


def _cylinder(size: np.ndarray, pos: np.ndarray, quat: np.ndarray) -> dict[str, np.ndarray]:
    return {"radii": size[:, 0], "lengths": 2 * size[:, 1], "centers": pos}


def _capsule(size: np.ndarray, pos: np.ndarray, quat: np.ndarray) -> dict[str, np.ndarray]:
    # MuJoCo's capsule has its origin in the middle, Rerun's at one end
    ends = pos - axis(quat, 2) * size[:, 1:2]
    return {"radii": size[:, 0], "lengths": 2 * size[:, 1], "translations": ends}


# kind: (Rerun's archetype, its columns)
KINDS: dict[str, tuple[str, Callable]] = {
    "box": ("Boxes3D", _box),
    "ellipsoid": ("Ellipsoids3D", _box),
    "sphere": ("Ellipsoids3D", _sphere),
    "cylinder": ("Cylinders3D", _cylinder),
    "capsule": ("Capsules3D", _capsule),
}
HALF_SIZES: dict[str, Callable] = {
    "box": lambda x, y, z: (x, y, z),
    "ellipsoid": lambda x, y, z: (x, y, z),
    "sphere": lambda radius, *_: (radius, radius, radius),
    "cylinder": lambda radius, half, _: (radius, radius, half),
    "capsule": lambda radius, half, _: (radius, radius, half + radius),
}
