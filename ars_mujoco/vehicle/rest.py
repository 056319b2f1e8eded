"""Rest: the keyframe in which nothing accelerates.

Settling by simulation stops at 1e-5 m/s^2; Newton's method on the accelerations goes to rounding. It sees the model
through `forward` alone, so whatever callback is installed (tires, bars, driver) belongs to the rest it finds.
"""

from collections.abc import Callable

import mujoco
import numpy as np

from ars_mujoco.schema.errors import ArsError

RESIDUAL = 1e-6  # largest acceleration left, m/s^2 and rad/s^2
DISPLACEMENT = 1e-7  # of the finite differences, m and rad
ITERATIONS = 20


def solve(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    forward: Callable[[mujoco.MjModel, mujoco.MjData], None] = mujoco.mj_forward,
    key: int = 0,
) -> float:
    """Bring `data` from its pose to rest, write it to keyframe `key`, and return the largest |qacc| left.

    Motions that no force answers (along the road, a wheel's spin) stay where they are.
    Raises ArsError where no rest is found.
    """
    tolerance, model.opt.tolerance = model.opt.tolerance, 0.0  # within it the solver calls any small acceleration zero
    try:
        return _newton(model, data, forward, key)
    finally:
        model.opt.tolerance = tolerance


def _newton(model, data, forward, key: int) -> float:
    for _ in range(ITERATIONS):
        residual = _acceleration(model, data, forward, data.qpos.copy())
        if np.abs(residual).max() < RESIDUAL:
            model.key_qpos[key], model.key_qvel[key] = data.qpos, 0.0
            return float(np.abs(residual).max())
        step = np.linalg.lstsq(_jacobian(model, data, forward), -residual, rcond=1e-9)[0]
        mujoco.mj_integratePos(model, data.qpos, step, 1.0)
    raise ArsError(f"no rest found: an acceleration of {np.abs(residual).max():.1e} m/s^2 is left")


def _acceleration(model, data, forward, qpos) -> np.ndarray:
    data.qpos, data.qvel, data.qacc_warmstart = qpos, 0.0, 0.0
    forward(model, data)
    return data.qacc.copy()


def _jacobian(model, data, forward) -> np.ndarray:
    """d qacc / d q, shape (nv, nv), by central differences about the pose of `data`, which is left as found."""
    pose, columns = data.qpos.copy(), []
    for direction in np.eye(model.nv) * DISPLACEMENT:
        ahead, behind = pose.copy(), pose.copy()
        mujoco.mj_integratePos(model, ahead, direction, 1.0)
        mujoco.mj_integratePos(model, behind, direction, -1.0)
        difference = _acceleration(model, data, forward, ahead) - _acceleration(model, data, forward, behind)
        columns.append(difference / (2 * DISPLACEMENT))
    data.qpos = pose
    return np.column_stack(columns)
