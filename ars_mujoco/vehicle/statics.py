"""Statics in a steady turn: the pose, loads and bar torques of the very model that runs, at a lateral acceleration.

The turn's inertia is a tilted gravity (d'Alembert). The tires stand on their vertical springs and push sideways at
their contact patches, each axle with the share that the position of the centre of gravity asks, left and right in
proportion to their loads. Newton's method drives the model's own accelerations to zero, so that nothing of the
suspension, the drop links or the tires' roll is simplified away or tuned by hand.

Signs: a_y > 0 in a left turn, roll > 0 with the right side down, bar torque > 0 pushes the body to negative roll.
"""

import copy
import math
from dataclasses import dataclass

import mujoco
import numpy as np

from ars_mujoco.schema.errors import ArsError
from ars_mujoco.tires.tire import Tire
from ars_mujoco.vehicle.roll_plane import RollPlane
from ars_mujoco.vehicle.sedan import GRAVITY, Sedan

AXLES = ("front", "rear")
HELD = ("_steer", "_spin")  # joints that a steady turn holds or leaves alone
RESIDUAL = 1e-7  # largest acceleration left, m/s^2 and rad/s^2
DISPLACEMENT = 1e-6  # of the finite differences, m and rad
TORQUE = 1000.0  # Nm, the size of the unknown torque beside angles and lengths of order 1
ITERATIONS = 60


@dataclass(frozen=True)
class Equilibrium:
    """A steady turn: angles in rad, torques in Nm, forces in N; pairs are (front, rear)."""

    lateral_acceleration: float  # m/s^2
    reading: float  # m/s^2, of the lateral accelerometer on the body
    roll: float
    twist: np.ndarray  # (2,) left half less right half
    torque: np.ndarray  # (2,) of the bars
    wheel_load: np.ndarray  # (4,) fl fr rl rr; empty on the roll plane
    qpos: np.ndarray  # (nq,)


def roll_gradient(model: mujoco.MjModel, vehicle: Sedan | RollPlane, bars: str) -> float:
    """Roll gradient (deg/g) over 0.1 to 0.4 g with bars `none`, `passive` or `locked`; least squares."""
    statics, lateral = Statics(model, vehicle), np.array([0.1, 0.2, 0.3, 0.4])
    rolls = [statics.turned(a * GRAVITY, bar_stiffness(vehicle, bars)).roll for a in lateral]
    return math.degrees(np.polyfit(lateral, rolls, 1)[0])


def bar_stiffness(vehicle: Sedan | RollPlane, bars: str) -> np.ndarray:
    """Torsion (front, rear), Nm/rad, of bars that hold no angle of their own."""
    axles = (vehicle.front.bar, vehicle.rear.bar) if isinstance(vehicle, Sedan) else (vehicle.front, vehicle.rear)
    of = {"none": lambda bar: 0.0, "passive": lambda bar: bar.passive_stiffness, "locked": lambda bar: bar.stiffness}
    return np.array([of[bars](bar) for bar in axles])


class Statics:
    """Solves one steady turn after the other, each from the pose of the one before."""

    def __init__(self, model: mujoco.MjModel, vehicle: Sedan | RollPlane):
        self.model, self.data = _without_callback(model)
        self.body, self.sensor = model.body("body").id, model.site("accelerometer").id
        self.mass = model.body_subtreemass[self.body]
        self.unknowns, self.held_dofs = _unknown_dofs(model), _held_dofs(model)
        joints = [[model.joint(f"{axle}_bar_{side}") for side in ("left", "right")] for axle in AXLES]
        self.hinges = np.array([[joint.dofadr[0] for joint in pair] for pair in joints])  # (2, 2) axle, side
        self.angles = np.array([[joint.qposadr[0] for joint in pair] for pair in joints])
        self.tires = _tires(model, vehicle)
        self.pose, self.jacobian = self.data.qpos.copy(), np.empty((0, 0))

    def turned(
        self, lateral_acceleration: float, stiffness: np.ndarray, angle: np.ndarray | float = 0.0
    ) -> Equilibrium:
        """The turn with bars of torsion `stiffness` (Nm/rad) at motor angles `angle` (rad): M = c (phi - psi).

        Both (front, rear). Raises ArsError where the car does not stand.
        """

        def torque() -> np.ndarray:
            return stiffness * (angle - self._twist())

        def residual(unknown: np.ndarray) -> np.ndarray:
            self._place(unknown)
            return self._accelerations(lateral_acceleration, torque())

        self._newton(residual, np.zeros(len(self.unknowns)))
        return self._equilibrium(lateral_acceleration, torque())

    def held(self, lateral_acceleration: float, roll: float, front_share: float) -> Equilibrium:
        """The turn with the torques, `front_share` of them in front, that hold the body at `roll` (rad).

        Raises ArsError where the car does not stand.
        """
        share = np.array([front_share, 1.0 - front_share])

        def residual(unknown: np.ndarray) -> np.ndarray:
            self._place(unknown[:-1])
            accelerations = self._accelerations(lateral_acceleration, unknown[-1] * TORQUE * share)
            return np.append(accelerations, self._roll() - roll)

        unknown = self._newton(residual, np.zeros(len(self.unknowns) + 1))
        return self._equilibrium(lateral_acceleration, unknown[-1] * TORQUE * share)

    def _newton(self, residual, start: np.ndarray) -> np.ndarray:
        """The unknowns, counted from the last solved pose, that make `residual` vanish; the Jacobian is reused."""
        unknown, error, fresh = start, residual(start), False
        for _ in range(ITERATIONS):
            if not np.isfinite(error).all():
                break
            if np.abs(error).max() < RESIDUAL:
                self.pose = self.data.qpos.copy()
                return unknown
            if len(self.jacobian) != len(start):
                self.jacobian, fresh = _differences(residual, unknown, error), True
            step = np.linalg.solve(self.jacobian, error)
            ahead = residual(unknown - step)
            if np.abs(ahead).max() < 0.3 * np.abs(error).max() or fresh:
                unknown, error, fresh = unknown - step, ahead, False
            else:
                self.jacobian = np.empty((0, 0))  # too far from where it was taken
        lateral = -self.model.opt.gravity[1] / GRAVITY
        raise ArsError(f"no steady turn at {lateral:#.3g} g: a wheel lifts or a drop link is out of reach")

    def _place(self, displacement: np.ndarray) -> None:
        """Move the free coordinates by `displacement` from the last solved pose; positions follow."""
        motion = np.zeros(self.model.nv)
        motion[self.unknowns] = displacement
        self.data.qpos = self.pose
        mujoco.mj_integratePos(self.model, self.data.qpos, motion, 1.0)
        mujoco.mj_fwdPosition(self.model, self.data)

    def _accelerations(self, lateral_acceleration: float, torque: np.ndarray) -> np.ndarray:
        """What the free coordinates would do under the tilted gravity, the tires and the bars' torques (Nm)."""
        model, data = self.model, self.data
        model.opt.gravity[1] = -lateral_acceleration
        data.qfrc_applied = 0.0
        self._push_tires(lateral_acceleration)
        data.qfrc_applied[self.hinges] += np.outer(torque, [1.0, -1.0])
        data.qacc_warmstart = 0.0
        mujoco.mj_forwardSkip(model, data, mujoco.mjtStage.mjSTAGE_POS, 1)
        return data.qacc[self.unknowns]

    def _push_tires(self, lateral_acceleration: float) -> None:
        """Apply the tires' forces; the steering and the wheels' rotation are held, so they take what reaches them."""
        if not self.tires:
            return
        patches = np.array([_patch(self.data, wheel, tire) for wheel, tire in self.tires])
        lateral = lateral_acceleration * self.mass * _lateral_shares(patches, self.data.subtree_com[self.body, 0])
        for (wheel, _), (*place, load), force in zip(self.tires, patches, lateral, strict=True):
            mujoco.mj_applyFT(
                self.model, self.data, np.array([0.0, force, load]), np.zeros(3), np.array(place), wheel,
                self.data.qfrc_applied,
            )  # fmt: skip
        self.data.qfrc_applied[self.held_dofs] = 0.0

    def _twist(self) -> np.ndarray:
        """Twist (front, rear) of the bars, rad: left half less right half."""
        left, right = self.data.qpos[self.angles].T
        return left - right

    def _roll(self) -> float:
        """Roll (rad) of the body relative to the road."""
        return math.atan2(self.data.xmat[self.body, 7], self.data.xmat[self.body, 8])

    def _equilibrium(self, lateral_acceleration: float, torque: np.ndarray) -> Equilibrium:
        lateral_axis = self.data.site_xmat[self.sensor].reshape(3, 3)[:, 1]
        return Equilibrium(
            lateral_acceleration=lateral_acceleration,
            reading=float(-lateral_axis @ self.model.opt.gravity),
            roll=self._roll(),
            twist=self._twist(),
            torque=torque,
            wheel_load=np.array([_patch(self.data, wheel, tire)[3] for wheel, tire in self.tires]),
            qpos=self.pose.copy(),
        )


def _without_callback(model: mujoco.MjModel) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A copy of the model that runs neither callback nor actuators, at its first keyframe."""
    model = copy.copy(model)
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ACTUATION
    model.opt.tolerance = 0.0  # within it the solver calls any small acceleration zero
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def _unknown_dofs(model: mujoco.MjModel) -> np.ndarray:
    """The motions that statics answer: heave, roll, pitch, travels, bar halves; not those along the road, nor HELD."""
    moved = [
        model.joint(j).dofadr[0]
        for j in range(model.njnt)
        if model.jnt_type[j] == mujoco.mjtJoint.mjJNT_HINGE and not model.joint(j).name.endswith(HELD)
    ]
    free = [2, 3, 4] if model.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE else []
    return np.array(free + moved)


def _held_dofs(model: mujoco.MjModel) -> np.ndarray:
    """Steering and the wheels' spin."""
    return np.array(
        [model.joint(j).dofadr[0] for j in range(model.njnt) if model.joint(j).name.endswith(HELD)], dtype=int
    )


def _tires(model: mujoco.MjModel, vehicle: Sedan | RollPlane) -> list[tuple[int, Tire]]:
    """(body of the wheel, its tire) of each corner; none on the roll plane."""
    if isinstance(vehicle, RollPlane):
        return []
    return [
        (model.body(f"{axle[0]}{side}_wheel").id, parameters.tire)
        for axle, parameters in vehicle.axles.items()
        for side in "lr"
    ]


def _patch(data: mujoco.MjData, wheel: int, tire: Tire) -> tuple[float, float, float, float]:
    """(x, y, z of the contact patch, load N) of a wheel on the level road at height 0, as `ars_mujoco.tires` has it."""
    x, y, height = data.xpos[wheel]
    axis_x, axis_y, sin = data.xmat[wheel, 1::3]
    cos = math.hypot(axis_x, axis_y)
    out = height * sin / cos**2
    return x + out * axis_x, y + out * axis_y, 0.0, max(0.0, tire.stiffness * (tire.radius * cos - height))


def _lateral_shares(patches: np.ndarray, cg: float) -> np.ndarray:
    """Share (4,) of each tire in the lateral force that turns a car with its centre of gravity at x = `cg` (m)."""
    position, load = patches[:, 0].reshape(2, 2), patches[:, 3].reshape(2, 2)
    with np.errstate(invalid="ignore"):  # an axle off the road: its NaN ends Newton's method
        of_axle = load / load.sum(axis=1, keepdims=True)
    front, rear = (position * of_axle).sum(axis=1)
    axle = np.array([cg - rear, front - cg]) / (front - rear)
    return (axle[:, None] * of_axle).ravel()


def _differences(residual, unknown: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Jacobian of `residual` at `unknown`, where it is `error`, by forward differences."""
    columns = [(residual(unknown + move) - error) / DISPLACEMENT for move in np.eye(len(unknown)) * DISPLACEMENT]
    return np.column_stack(columns)
