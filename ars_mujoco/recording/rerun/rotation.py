"""Rotations by quaternions (w, x, y, z), over arrays of them."""

import numpy as np


def matrices(quat: np.ndarray) -> np.ndarray:
    """(..., 4) unit quaternions as rotation matrices (..., 3, 3)."""
    return np.stack([axis(quat, i) for i in range(3)], -1)


def axis(quat: np.ndarray, i: int) -> np.ndarray:
    """The turned x, y or z axis (..., 3), `i` 0, 1 or 2, of rotations (..., 4)."""
    w, x, y, z = components(quat)
    if i == 0:
        return np.stack((1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)), -1)
    if i == 1:
        return np.stack((2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)), -1)
    return np.stack((2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)), -1)


def components(quat: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """w, x, y and z, each (...,), of quaternions (..., 4)."""
    return quat[..., 0], quat[..., 1], quat[..., 2], quat[..., 3]


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The rotation b, then a; shapes (..., 4)."""
    aw, ax, ay, az = components(a)
    bw, bx, by, bz = components(b)
    return np.stack(
        (
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ),
        -1,
    )


def yaw_of(quat: np.ndarray) -> np.ndarray:
    """The heading (...,) in rad of rotations (..., 4): the angle about z of the turned x axis."""
    w, x, y, z = components(quat)
    return np.arctan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z))


def about_z(angle: np.ndarray) -> np.ndarray:
    """The rotation by `angle` (...,) rad about z, (..., 4)."""
    zero = np.zeros_like(angle)
    return np.stack((np.cos(angle / 2), zero, zero, np.sin(angle / 2)), -1)


def roll_of(quat: np.ndarray) -> np.ndarray:
    """The roll (...,) in rad of rotations (..., 4), positive right side down."""
    w, x, y, z = components(quat)
    return np.arctan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
