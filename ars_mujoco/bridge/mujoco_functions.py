"""MuJoCo's functions by the address that the library which the mujoco package has loaded gives them."""

import ctypes
from functools import cache
from pathlib import Path

import mujoco
import numpy as np

# what mj_step does before it calls mjcb_control, and in mj_step2 after it; the models have no use for energies
BEFORE_CONTROL = ("mj_checkPos", "mj_checkVel", "mj_fwdPosition", "mj_sensorPos", "mj_fwdVelocity", "mj_sensorVel")
AFTER_CONTROL = "mj_step2"
ACCELERATION = ("mj_fwdActuation", "mj_fwdAcceleration", "mj_fwdConstraint")  # the part of it that mj_forward has

C_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)  # void(mjModel*, mjData*)


@cache
def addresses() -> np.ndarray:
    """Addresses of BEFORE_CONTROL and, last, of AFTER_CONTROL."""
    library = ctypes.CDLL(str(_library()))
    names = (*BEFORE_CONTROL, AFTER_CONTROL)
    return np.array([ctypes.cast(getattr(library, name), ctypes.c_void_p).value for name in names])


def _library() -> Path:
    folder = Path(mujoco.__file__).parent
    return next(
        path for pattern in ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll") for path in folder.glob(pattern)
    )
