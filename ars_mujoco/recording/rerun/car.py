"""The 3D side of a run in Rerun: bodies at their poses, what is fixed to them, the chase frame, forces, the level."""

import numpy as np
import rerun as rr

from ars_mujoco.recording.recording import Geom, Recording
from ars_mujoco.recording.rerun.batch import Batch
from ars_mujoco.recording.rerun.forces import RADIUS, BarForces, TireForces
from ars_mujoco.recording.rerun.ground import RIG_SPACING, ROAD_SPACING, Ground
from ars_mujoco.recording.rerun.level import level_over, log_body_bar, log_label, log_level
from ars_mujoco.recording.rerun.look import Look
from ars_mujoco.recording.rerun.rotation import about_z, matrices, product, roll_of, yaw_of
from ars_mujoco.recording.rerun.solids import add_solids

BODY = "body"  # the sprung body that the chase follows, where the rig has one
WORLD = "world"
AXLES = ("front", "rear")
LABEL_STEP = 10  # poses between two texts of the roll's label
FLANGE_RADIUS, FLANGE_LENGTH = 0.085, 0.03  # m
BAR_COLOR = (255, 183, 77)


class Car:
    """What moves in a run, below `<root>/world/car`; `row` is the line of its label, 0 where the run stands alone."""

    def __init__(self, stream: rr.RecordingStream, run: Recording, root: str, look: Look, row: int):
        self.stream, self.look, self.row = stream, look, row
        self.root, self.car = root, f"{root}/world/car"
        self.chase, self.label = f"{self.car}/chase", f"{self.car}/chase/roll"
        solids = {name: [geom for geom in run.scene if geom.body == name] for name in (WORLD, *run.bodies)}
        self.moving = [name for name in run.bodies if solids[name] and name != WORLD]
        self.follows = BODY in self.moving
        self.tires = TireForces(run, look)
        self.bars = {axle: bar for axle in AXLES if (bar := BarForces(run, axle)).is_known}
        self.ground = Ground(stream, root, ROAD_SPACING if self.follows else RIG_SPACING) if not look.tint else None
        self.level = level_over(solids[BODY]) if self.follows else None
        self.motors: dict[str, np.ndarray] = {}  # axle: place (3,) m on the body, known with the first pose
        self.started = False
        self._log_solids(solids)

    def _log_solids(self, solids: dict[str, list[Geom]]) -> None:
        batch = Batch()
        add_solids(batch, f"{self.root}/world/scene", solids[WORLD], self.look)
        for name in self.moving:
            add_solids(batch, f"{self.car}/{name}", solids[name], self.look)
        batch.send(self.stream)
        if not self.follows:
            self.stream.log(self.chase, rr.Transform3D(translation=(0, 0, 0)), static=True)

    def append(self, batch: Batch, chunk: Recording) -> None:
        """Add the poses and forces of a chunk that is not empty to `batch`, at the same times."""
        if not self.started:
            self._log_once(chunk)
        for name in self.moving:
            _add_pose(batch, f"{self.car}/{name}", chunk.body(name))
        self.tires.append(batch, f"{self.car}/tire_forces", chunk)
        for axle, bar in self.bars.items():
            bar.append(batch, f"{self.car}/{axle}_bar_forces", chunk)
            if self.follows:
                bar.color(batch, f"{self.car}/{BODY}/{axle}_torque", chunk)
        if self.follows:
            self._append_chase(batch, chunk)
        if self.ground:
            self.ground.append(chunk.body(BODY)[:, :3] if self.follows else np.zeros((1, 3)))

    def _log_once(self, chunk: Recording) -> None:
        """What hangs on the place of things in the first pose, and the styles of the arrows."""
        self.started = True
        if self.tires.corners:
            arrows = rr.Arrows3D.from_fields(colors=self.tires.colors, radii=RADIUS)
            self.stream.log(f"{self.car}/tire_forces", arrows, static=True)
        for axle in self.bars:
            color = self.look.tint or BAR_COLOR
            arrows = rr.Arrows3D.from_fields(colors=[(*color, round(255 * self.look.opacity))], radii=0.7 * RADIUS)
            self.stream.log(f"{self.car}/{axle}_bar_forces", arrows, static=True)
        if self.follows:
            self._log_flanges(chunk)
            height = chunk.body(BODY)[0, 2]
            if not self.look.tint:
                log_level(self.stream, self.chase, self.level, height)
            log_body_bar(self.stream, f"{self.car}/{BODY}", self.level, self.look)
            log_label(self.stream, self.label, self.level, height, self.look, self.row)

    def _log_flanges(self, chunk: Recording) -> None:
        """A disk about each motor, on the body, midway between the halves of its bar: its color shows the torque."""
        body = chunk.body(BODY)[0]
        for axle, bar in self.bars.items():
            middle = np.mean([chunk.body(half)[0, :3] for half in bar.halves], axis=0)
            center = (middle - body[:3]) @ matrices(body[3:])
            self.motors[axle] = center
            flange = rr.Cylinders3D.from_fields(
                radii=FLANGE_RADIUS,
                lengths=FLANGE_LENGTH,
                centers=[center],
                quaternions=[(-(0.5**0.5), 0, 0, 0.5**0.5)],
                fill_mode="solid",
            )
            self.stream.log(f"{self.car}/{BODY}/{axle}_torque", flange, static=True)

    def _append_chase(self, batch: Batch, chunk: Recording) -> None:
        _add_pose(batch, self.chase, chase_of(chunk.body(BODY)))
        labels = Batch(chunk.pose_time[::LABEL_STEP])
        degrees = np.degrees(roll_of(chunk.body(BODY)[::LABEL_STEP, 3:]))
        texts = [[self.look.label(f"roll {angle:+.1f} deg")] for angle in degrees]
        labels.add(self.label, "Points3D:labels", np.array(texts))
        labels.send(self.stream)


def chase_of(poses: np.ndarray) -> np.ndarray:
    """Poses (m, 7) of a body as those of the frame that follows it on the ground: x, y and heading only."""
    return np.column_stack((poses[:, :2], np.zeros(len(poses)), about_z(yaw_of(poses[:, 3:]))))


def in_chase_of(poses: np.ndarray, own: np.ndarray, other: np.ndarray) -> np.ndarray:
    """`poses` (m, nbody, 7) moved from the chase `own` (m, 7) to the chase `other` (m, 7)."""
    turn = about_z(yaw_of(other[:, 3:]) - yaw_of(own[:, 3:]))[:, None]
    offset = poses[..., :3] - own[:, None, :3]
    position = np.einsum("mxij,mbj->mbi", matrices(turn), offset) + other[:, None, :3]
    return np.concatenate((position, product(turn, poses[..., 3:])), axis=-1)


def _add_pose(batch: Batch, entity: str, poses: np.ndarray) -> None:
    batch.add(entity, "Transform3D:translation", poses[:, None, :3])
    batch.add(entity, "Transform3D:quaternion", poses[:, None, [4, 5, 6, 3]])
