"""The bridge to MuJoCo for who steps by himself, in a loop of his own, a batch or the viewer: a rig as `mjcb_control`.

    mj_step ─> mjcb_control(m, d) ─> mjData fields + the world in userdata ─> rig.step ─> forces in mjData

The native callback takes no interpreter lock, so it also runs under `mujoco.batch.Batch`. What goes wrong is a status
in the world, as a run's own loop reads it; here it is told as a warning when it happens.
"""

import contextlib
import ctypes
import os
import threading
import warnings

import mujoco
import numpy as np
from numba import carray

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.control import Control, control_of, run
from ars_mujoco.bridge.engine_warnings import withheld
from ars_mujoco.bridge.mjdata import SIGNATURE, call, doubles, integers, word
from ars_mujoco.bridge.mujoco_functions import C_FUNCTION
from ars_mujoco.bridge.world import BURST, HEADER, MAGIC, NOT_FINITE, OTHER_LAYOUT, RUNNING, TIME_JUMP
from ars_mujoco.kernels.kernel import NativeCallback, kernel
from ars_mujoco.schema.errors import ArsError

_DATA, _MODEL = mujoco_layout.offsets("mjData"), mujoco_layout.offsets("mjModel")
_TIME, _USERDATA, _QPOS, _QVEL = (_DATA[name] for name in ("time", "userdata", "qpos", "qvel"))
_NUSERDATA, _NQ, _NV, _NKEY = (_MODEL[name] for name in ("nuserdata", "nq", "nv", "nkey"))
_QPOS0, _KEY_QPOS, _KEY_QVEL = (_MODEL[name] for name in ("qpos0", "key_qpos", "key_qvel"))
_STATUS = HEADER.names.index("status")
_NO_BOUND = 1 << 30  # the arrays below are not bounds-checked; their true lengths are the model's

_TOLD = {
    OTHER_LAYOUT: "the state that was restored is of another rig or another release",
    TIME_JUMP: "time jumped: a state is restored with its userdata, as mjSTATE_INTEGRATION has it, or the run begins "
    "anew with mj_resetDataKeyframe; what follows is not this run",
    NOT_FINITE: "the run diverged",
    BURST: "the actuator left what is physical",
}
_ELSEWHERE = -1
_BEGINS_ELSEWHERE = (
    "a run begins where mj_resetData puts it, at a stand; the cycle's start is mj_resetDataKeyframe(model, data, 0)"
)


@contextlib.contextmanager
def installed(rig, model: mujoco.MjModel, data: mujoco.MjData, law=None):
    """Install `rig`'s callback for the length of a `with` block, and restore what was there.

    There is one `mjcb_control` for the whole process; a second thread waits until the first one's block has ended.
    `data` is used to hold the struct offsets against; `law` is a `law.Law` in place of the shipped controller.
    Raises ArsError for an integrator that calls more than once a step, for a model not built for this rig, and at the
    end where something else has been installed meanwhile.
    """
    with _one_at_a_time, withheld(), law.running() if law else contextlib.nullcontext() as running:
        control = control_of(rig, model, data, running)
        function, before, now = _function(control), mujoco.get_mjcb_control(), _installed.copy()
        mujoco.set_mjcb_control(function)
        try:
            yield
        finally:
            replaced = mujoco.get_mjcb_control() is not function
            mujoco.set_mjcb_control(before)
            _installed[:] = now
        if replaced:
            raise ArsError("mjcb_control was replaced while a rig was installed: the steps since then were without it")


def _renew_lock() -> None:
    """A forked process has no thread that would release it."""
    global _one_at_a_time
    _one_at_a_time = threading.RLock()


_renew_lock()
os.register_at_fork(after_in_child=_renew_lock)

_installed = np.zeros(len(Control._fields), np.int64)  # the Control that `_watched` calls
_INSTALLED = _installed.ctypes.data


def _function(control: Control):
    """What MuJoCo gets as its callback."""
    if callable(control.callback):
        return control.callback
    _installed[:] = control
    return C_FUNCTION(_WATCHED.address)


@C_FUNCTION
def _tell(data, status):
    """Warn of what happened in the mjData at an address."""
    time = ctypes.c_double.from_address(data + _TIME).value
    if ctypes.c_int64(status or 0).value == _ELSEWHERE:
        text = _BEGINS_ELSEWHERE
    else:
        text = _TOLD.get(status, "the controller failed")
    warnings.warn(f"at {time:g} s: {text}", stacklevel=2)


_TELL = ctypes.cast(_tell, ctypes.c_void_p).value


@kernel
def _begins_elsewhere(model, data):
    """Whether mjData stands where mj_resetData puts it, and the model's first keyframe does not."""
    if word(model + _NKEY) == 0:
        return False
    nq, nv = word(model + _NQ), word(model + _NV)
    qpos, qpos0 = carray(doubles(word(data + _QPOS)), (nq,)), carray(doubles(word(model + _QPOS0)), (nq,))
    qvel, key_qpos = carray(doubles(word(data + _QVEL)), (nv,)), carray(doubles(word(model + _KEY_QPOS)), (nq,))
    key_qvel = carray(doubles(word(model + _KEY_QVEL)), (nv,))
    if (qpos != qpos0).any() or (qvel != 0.0).any():
        return False
    return (qpos != key_qpos).any() or (qvel != key_qvel).any()


def _watched(model, data):
    now = carray(integers(_INSTALLED), (6,))
    if word(model + _NUSERDATA) != now[1]:
        return  # another's model
    userdata = carray(doubles(word(data + _USERDATA)), (_NO_BOUND,))
    is_new, status = userdata[0] != MAGIC, userdata[_STATUS]
    elsewhere = is_new and _begins_elsewhere(model, data)
    control = now[0], now[1], now[2], now[3], now[4], now[5]
    run(control, model, data, carray(doubles(data + _TIME), (1,))[0])
    if userdata[0] == MAGIC and elsewhere:
        call(_TELL, data, _ELSEWHERE)
    if userdata[0] == MAGIC and (is_new or status == RUNNING) and userdata[_STATUS] != RUNNING:
        call(_TELL, data, int(userdata[_STATUS]))


_WATCHED = NativeCallback(SIGNATURE, _watched, cached=False)
