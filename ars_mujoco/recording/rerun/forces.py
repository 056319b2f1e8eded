"""Forces in the 3D view: the tires' at their contact patches, and the bars' at their drop links."""

import numpy as np

from ars_mujoco.recording.recording import Geom, Recording
from ars_mujoco.recording.rerun.batch import Batch
from ars_mujoco.recording.rerun.display import CORNER_COLORS, CORNERS, rgba32
from ars_mujoco.recording.rerun.look import Look
from ars_mujoco.recording.rerun.rotation import axis, matrices

TIRE_SCALE = 0.2e-3  # m/N: a wheel's static load is drawn 0.8 m long, above the wheel
LINK_SCALE = 0.1e-3  # m/N
RADIUS = 0.02  # m
TORQUE_SCALE = 1400.0  # Nm of bar torque where the motor's color is full
COLD, REST, HOT = np.array((41, 121, 255)), np.array((150, 150, 150)), np.array((255, 61, 0))


class TireForces:
    """The load upward and the force in the road plane, two arrows a tire."""

    SIGNALS = ("longitudinal_force", "lateral_force", "vertical_force")

    def __init__(self, run: Recording, look: Look):
        self.corners = [c for c in CORNERS if self._is_known(run, c)]
        self.radius = {c: _wheel_radius(run.scene, f"{c}_wheel") for c in self.corners}
        alpha = round(255 * look.opacity)
        self.colors = [rgba32(look.tint or CORNER_COLORS[c], alpha) for c in self.corners for _ in range(2)]

    def _is_known(self, run: Recording, corner: str) -> bool:
        signals = [f"{corner}.tire.{signal}" for signal in self.SIGNALS]
        return f"{corner}_wheel" in run.bodies and all(signal in run.channels for signal in signals)

    def append(self, batch: Batch, entity: str, chunk: Recording) -> None:
        """Arrows at the chunk's poses."""
        if not self.corners:
            return
        vectors = np.empty((len(chunk.time), len(self.corners), 2, 3))
        origins = np.empty_like(vectors)
        for i, corner in enumerate(self.corners):
            force = np.stack([chunk[f"{corner}.tire.{signal}"] for signal in self.SIGNALS], -1) * TIRE_SCALE
            pose = chunk.body(f"{corner}_wheel")
            origins[:, i] = (pose[:, :3] - (0, 0, self.radius[corner]))[:, None]
            vectors[:, i] = _in_road_plane(force, axis(pose[:, 3:], 1))
        count = 2 * len(self.corners)
        batch.add(entity, "Arrows3D:vectors", vectors.reshape(len(chunk.time), count, 3))
        batch.add(entity, "Arrows3D:origins", origins.reshape(len(chunk.time), count, 3))


class BarForces:
    """What the two halves of an axle's bar push on their drop links with, and the motor's torque as a color."""

    def __init__(self, run: Recording, axle: str):
        self.channel = f"{axle}.bar.torque"
        self.halves = (f"{axle}_bar_left", f"{axle}_bar_right")
        self.is_known = self.channel in run.channels and all(half in run.bodies for half in self.halves)
        if self.is_known:
            self.ends = [_arm_end([g for g in run.scene if g.body == half]) for half in self.halves]
            self.is_known = all(end is not None for end in self.ends)

    def append(self, batch: Batch, entity: str, chunk: Recording) -> None:
        """Arrows at the arms' ends: positive torque lifts the left end and lowers the right."""
        torque = chunk[self.channel]
        vectors, origins = [], []
        for half, end, sign in zip(self.halves, self.ends, (1, -1), strict=True):
            pose = chunk.body(half)
            force = sign * torque / -end[0]
            origins.append(pose[:, :3] + matrices(pose[:, 3:]) @ end)
            vectors.append(axis(pose[:, 3:], 2) * force[:, None] * LINK_SCALE)
        batch.add(entity, "Arrows3D:vectors", np.stack(vectors, 1))
        batch.add(entity, "Arrows3D:origins", np.stack(origins, 1))

    def color(self, batch: Batch, entity: str, chunk: Recording) -> None:
        """The color of the motor's flange: gray at rest, red pushing to negative roll, blue to positive."""
        batch.add(entity, "Cylinders3D:colors", torque_colors(chunk[self.channel])[:, None])


def torque_colors(torque: np.ndarray) -> np.ndarray:
    """`torque` (n,) Nm as integers 0xRRGGBBAA (n,)."""
    share = np.clip(torque / TORQUE_SCALE, -1, 1)[:, None]
    mixed = REST + np.where(share > 0, share * (HOT - REST), -share * (COLD - REST))
    red, green, blue = np.rint(mixed).astype(np.uint32).T
    return red << 24 | green << 16 | blue << 8 | np.uint32(255)


def _in_road_plane(force: np.ndarray, axle: np.ndarray) -> np.ndarray:
    """`force` (n, 3) along the tire's axes as (n, 2, 3) in the world: the load, and the rest, on a level road.

    `axle` (n, 3) is the direction of the wheel's spin axis.
    """
    left = axle * (1, 1, 0)
    left /= np.linalg.norm(left, axis=1, keepdims=True)
    ahead = np.cross(left, (0.0, 0.0, 1.0))
    vectors = np.zeros((len(force), 2, 3))
    vectors[:, 0, 2] = force[:, 2]
    vectors[:, 1] = force[:, :1] * ahead + force[:, 1:2] * left
    return vectors


def _wheel_radius(scene: list[Geom], body: str) -> float:
    return max((geom.size[0] for geom in scene if geom.body == body and geom.type == "cylinder"), default=0.0)


def _arm_end(geoms: list[Geom]) -> np.ndarray | None:
    """The rearmost end (3,) m of a half's capsules: where its drop link hangs."""
    capsules = [geom for geom in geoms if geom.type == "capsule"]
    ends = [geom.pos + side * geom.size[1] * axis(geom.quat, 2) for geom in capsules for side in (-1, 1)]
    return min(ends, key=lambda end: end[0], default=None)
