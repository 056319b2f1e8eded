"""Recording: what a run leaves behind, as plain data; exporters and metrics see nothing else."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import mujoco
import numpy as np

from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.plots import Tab

GEOM_TYPES = {
    int(mujoco.mjtGeom.mjGEOM_SPHERE): "sphere",
    int(mujoco.mjtGeom.mjGEOM_CAPSULE): "capsule",
    int(mujoco.mjtGeom.mjGEOM_ELLIPSOID): "ellipsoid",
    int(mujoco.mjtGeom.mjGEOM_CYLINDER): "cylinder",
    int(mujoco.mjtGeom.mjGEOM_BOX): "box",
}
HALF_NANOSECOND = 5e-10  # s
VISIBLE_GROUPS = 3  # MuJoCo's viewer, too, draws groups 0 to 2 and hides the rest


@dataclass(frozen=True)
class Geom:
    """A solid fixed to `body`: `type` of GEOM_TYPES, `size` (3,) as MuJoCo defines it for the type, m;
    `pos` (3,) m and `quat` (4,) wxyz in the body's frame; `rgba` (4,) from 0 to 1."""

    body: str
    type: str
    size: np.ndarray
    pos: np.ndarray
    quat: np.ndarray
    rgba: np.ndarray


@dataclass(frozen=True)
class Event:
    """Something worth a line: `time` in s, `level` INFO, WARN or ERROR."""

    time: float
    level: str
    text: str


@dataclass
class Recording:
    """A run, or a piece of one: a chunk is a shorter Recording.

    `tabs` say which channels stand together when it is looked at, perhaps with others that this run does not have.
    `time` (n,) s; `values` (n, nchannel) SI, columns in the order of `channels`; `pose_time` (m,) s, some of `time`;
    `poses` (m, nbody, 7) world position m and quaternion wxyz, in the order of `bodies`.
    """

    title: str
    channels: dict[str, Channel]
    bodies: list[str] = field(default_factory=list)
    scene: list[Geom] = field(default_factory=list)
    tabs: tuple[Tab, ...] = ()
    inputs: dict = field(default_factory=dict)
    metrics: dict = field(default_factory=dict)
    time: np.ndarray = None
    values: np.ndarray = None
    pose_time: np.ndarray = None
    poses: np.ndarray = None
    events: list[Event] = field(default_factory=list)

    def __post_init__(self):
        empty = {"time": 0, "values": (0, len(self.channels)), "pose_time": 0, "poses": (0, len(self.bodies), 7)}
        for name, shape in empty.items():
            if getattr(self, name) is None:
                setattr(self, name, np.zeros(shape))

    def __getitem__(self, channel: str) -> np.ndarray:
        """The values of one channel, (n,); KeyError where the run has no such channel."""
        self.channels[channel]  # an unknown name ends here
        return self.values[:, list(self.channels).index(channel)]

    def body(self, name: str) -> np.ndarray:
        """The poses of one body, (m, 7)."""
        return self.poses[:, self.bodies.index(name)]

    def at_poses(self) -> "Recording":
        """The same with its values at the pose times only: 100 Hz, enough to look at."""
        rows = np.searchsorted(self.time, self.pose_time - HALF_NANOSECOND)
        return replace(self, time=self.pose_time, values=self.values[rows])

    def part(self, start: float, stop: float) -> "Recording":
        """The chunk with start <= time < stop, s."""
        rows = (self.time >= start) & (self.time < stop)
        frames = (self.pose_time >= start) & (self.pose_time < stop)
        return replace(
            self,
            time=self.time[rows],
            values=self.values[rows],
            pose_time=self.pose_time[frames],
            poses=self.poses[frames],
            events=[event for event in self.events if start <= event.time < stop],
        )


def joined(chunks: Sequence[Recording]) -> Recording:
    """One recording of successive `chunks` of a run."""
    names = ("time", "values", "pose_time", "poses")
    return replace(
        chunks[-1],
        **{name: np.concatenate([getattr(chunk, name) for chunk in chunks]) for name in names},
        events=[event for chunk in chunks for event in chunk.events],
    )


def scene_of(model: mujoco.MjModel) -> list[Geom]:
    """The solids of `model` that a viewer shows; planes and meshes are left out."""
    return [_geom(model, i) for i in range(model.ngeom) if _is_shown(model, i)]


def _is_shown(model: mujoco.MjModel, i: int) -> bool:
    return model.geom_type[i] in GEOM_TYPES and model.geom_group[i] < VISIBLE_GROUPS and model.geom_rgba[i, 3] > 0


def _geom(model: mujoco.MjModel, i: int) -> Geom:
    return Geom(
        body=model.body(model.geom_bodyid[i]).name,
        type=GEOM_TYPES[model.geom_type[i]],
        size=model.geom_size[i].copy(),
        pos=model.geom_pos[i].copy(),
        quat=model.geom_quat[i].copy(),
        rgba=model.geom_rgba[i].copy(),
    )
