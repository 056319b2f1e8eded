"""The native loop: steps MuJoCo and records, with no Python between the steps."""

import ctypes
from functools import cache
from pathlib import Path

import mujoco
import numpy as np
from numba import carray

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.callback import call, doubles, word
from ars_mujoco.bridge.world import HEADER
from ars_mujoco.kernels.kernel import entry

_DATA = mujoco_layout.offsets("mjData")
_USERDATA, _XPOS, _XQUAT = _DATA["userdata"], _DATA["xpos"], _DATA["xquat"]
_TIME_SLOT, _STATUS_SLOT = (HEADER.names.index(name) for name in ("time", "status"))


@cache
def _mj_step() -> int:
    """Address of mj_step in the library that the mujoco package has loaded."""
    return ctypes.cast(ctypes.CDLL(str(_library())).mj_step, ctypes.c_void_p).value


def _library() -> Path:
    folder = Path(mujoco.__file__).parent
    return next(
        path for pattern in ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll") for path in folder.glob(pattern)
    )


def advance(model, data, times, values, poses, stride: int, slots, first: int, python: bool) -> int:
    """Step `len(times)` times with the installed callback, recording the sample before each step; return steps made.

    times (n,) s; values (n, nchannel), the numbers at `slots` (nchannel,) of userdata; poses
    (m, nbody, 7), position and quaternion wxyz at every `stride`-th step, counted with `first` steps made before.
    Stops early where the world's status says that something went wrong. With `python` the loop itself is in Python, as
    a callback in Python needs it.
    """
    if python:
        return _advance_python(model, data, times, values, poses, stride, slots, first)
    return _advance(_mj_step(), model._address, data._address, times, values, poses, stride, slots, first)


@entry
def _advance(mj_step, model, data, times, values, poses, stride, slots, first):
    userdata = carray(doubles(word(data + _USERDATA)), (1 << 30,))
    xpos, xquat = carray(doubles(word(data + _XPOS)), (1 << 30,)), carray(doubles(word(data + _XQUAT)), (1 << 30,))
    pose = 0
    for i in range(times.shape[0]):
        call(mj_step, model, data)
        times[i] = userdata[_TIME_SLOT]
        for k in range(values.shape[1]):
            values[i, k] = userdata[slots[k]]
        if (first + i) % stride == 0:
            for body in range(poses.shape[1]):
                for k in range(3):
                    poses[pose, body, k] = xpos[3 * body + k]
                for k in range(4):
                    poses[pose, body, 3 + k] = xquat[4 * body + k]
            pose += 1
        if userdata[_STATUS_SLOT] != 0.0:
            return i + 1
    return times.shape[0]


def _advance_python(model, data, times, values, poses, stride, slots, first):
    pose = 0
    for i in range(len(times)):
        mujoco.mj_step(model, data)
        times[i] = data.userdata[_TIME_SLOT]
        values[i] = data.userdata[slots]
        if (first + i) % stride == 0:
            poses[pose] = np.hstack([data.xpos, data.xquat])
            pose += 1
        if data.userdata[_STATUS_SLOT] != 0.0:
            return i + 1
    return len(times)
