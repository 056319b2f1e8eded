"""The native loop: steps MuJoCo and records, with no Python between the steps.

It does what mj_step does, but calls the control itself: `mjcb_control` is one for the whole process, and neither what
another thread has put there nor what it takes away reaches a run.
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numba import carray

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.control import Control, run, run_once
from ars_mujoco.bridge.mjdata import call, doubles, word
from ars_mujoco.bridge.mujoco_functions import ACCELERATION, AFTER_CONTROL, BEFORE_CONTROL, addresses
from ars_mujoco.bridge.world import HEADER, LEFT_BEHIND, MAGIC, RUNNING, stop_in
from ars_mujoco.kernels.kernel import entry, kernel

_DATA = mujoco_layout.offsets("mjData")
_USERDATA, _XPOS, _XQUAT, _TIME = _DATA["userdata"], _DATA["xpos"], _DATA["xquat"], _DATA["time"]
_TIME_SLOT, _STATUS_SLOT = (HEADER.names.index(name) for name in ("time", "status"))


class Record(NamedTuple):
    """Room for samples: times (n,) s; values (n, nchannel), the numbers at `slots` (nchannel,) of userdata; poses
    (m, nbody, 7), position and quaternion wxyz at every `stride`-th step.
    """

    times: np.ndarray
    values: np.ndarray
    poses: np.ndarray
    slots: np.ndarray
    stride: int


def advance(model, data, control: Control, record: Record, first: int, last: bool = False) -> int:
    """Step as often as `record` has room, recording the sample before each step; return the samples taken.

    `first` steps were made before. Stops early where the world's status says that something went wrong; the step in
    which it did is not made, nor is that of the sample where `last`.
    """
    if callable(control.callback):
        return _advance_python(model, data, control.callback, record, first, last)
    return _advance(addresses(), model._address, data._address, tuple(control), tuple(record), first, last)


def forward(model: mujoco.MjModel, data: mujoco.MjData, control: Control) -> None:
    """What mj_forward does, with `control` for its callback."""
    for name in BEFORE_CONTROL:
        getattr(mujoco, name)(model, data)
    run_once(control, model, data)
    for name in ACCELERATION:
        getattr(mujoco, name)(model, data)


@entry
def _advance(functions, model, data, control, record, first, last):
    times, values, poses, slots, stride = record
    userdata = carray(doubles(word(data + _USERDATA)), (1 << 30,))
    xpos, xquat = carray(doubles(word(data + _XPOS)), (1 << 30,)), carray(doubles(word(data + _XQUAT)), (1 << 30,))
    now = carray(doubles(data + _TIME), (1,))
    pose = 0
    for i in range(times.shape[0]):
        for k in range(functions.shape[0] - 1):
            call(functions[k], model, data)
        run(control, model, data, now[0])
        times[i] = now[0]
        for k in range(values.shape[1]):
            values[i, k] = userdata[slots[k]]
        if (first + i) % stride == 0:
            for body in range(poses.shape[1]):
                for k in range(3):
                    poses[pose, body, k] = xpos[3 * body + k]
                for k in range(4):
                    poses[pose, body, 3 + k] = xquat[4 * body + k]
            pose += 1
        if _went_wrong(userdata, now[0]):
            return i + 1
        if not last:
            call(functions[-1], model, data)
    return times.shape[0]


@kernel
def _went_wrong(userdata, time):
    """Whether the run cannot go on: by the world's status, or as its control has left the world where it was."""
    if userdata[0] != MAGIC or userdata[_TIME_SLOT] != time:
        stop_in(userdata, LEFT_BEHIND, time)
    return userdata[_STATUS_SLOT] != RUNNING


def _advance_python(model, data, control, record, first, last):
    times, values, poses, slots, stride = record
    pose = 0
    for i in range(len(times)):
        for name in BEFORE_CONTROL:
            getattr(mujoco, name)(model, data)
        control(model, data)
        times[i], values[i] = data.time, data.userdata[slots]
        if (first + i) % stride == 0:
            poses[pose] = np.hstack([data.xpos, data.xquat])
            pose += 1
        if _went_wrong(data.userdata, data.time):
            return i + 1
        if not last:
            getattr(mujoco, AFTER_CONTROL)(model, data)
    return len(times)
