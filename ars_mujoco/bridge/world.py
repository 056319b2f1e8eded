"""The world: everything a run carries, parameters and state, as one record in `mjData.userdata`.

    header | parameters | now | later | out | scratch

`now` is the state at the time of the last call, `later` the state one step after it. A call whose time has moved on by
one step first makes `later` the new `now`; a call at the same time (`mj_forward` twice, finite differences) changes
nothing and computes the same again. So outputs are a pure function of (qpos, qvel, userdata), and a restored state
continues bit for bit. Where the magic number is absent (a reset wipes userdata), the world is initialised from the copy
that the model carries as its last custom numeric.
"""

import hashlib
import math

import mujoco
import numpy as np

from ars_mujoco.kernels.kernel import kernel

MAGIC = 4153115110.0  # marks an initialised world
NUMERIC = "ars_mujoco_world"  # the custom numeric that holds the initial world
TABLES = "ars_mujoco_tables"  # and the one before it, with what is only read

# status of a run, written by the callback and turned into an error by the loop
RUNNING, TIME_JUMP, NOT_FINITE, LAW_FAILED, OTHER_LAYOUT, BURST, LAW_ASTRAY, LEFT_BEHIND = range(8)
OF_THE_LAW = (LAW_FAILED, LAW_ASTRAY)

HEADER = np.dtype(
    [
        ("magic", "f8"),
        ("version", "f8"),  # of the layout, see `layout_version`
        ("step", "f8"),  # s, the physics step
        ("started", "f8"),  # 1 once a call has been made
        ("time", "f8"),  # s, of the last call
        ("status", "f8"),  # one of the above
        ("status_time", "f8"),  # s, when the status was first not RUNNING
    ]
)

_STATUS, _STATUS_TIME = HEADER.names.index("status"), HEADER.names.index("status_time")


def world_dtype(parameters: np.dtype, state: np.dtype, out: np.dtype, scratch: np.dtype) -> np.dtype:
    """The record of a rig's world; `scratch` is room for what is computed but not recorded."""
    blocks = {"header": HEADER, "parameters": parameters, "now": state, "later": state, "out": out, "scratch": scratch}
    return np.dtype(list(blocks.items()))


def layout_version(dtype: np.dtype) -> float:
    """A number that differs where the names or the order of a world's fields do: another rig, another release."""
    return float(int(hashlib.sha256(repr(dtype.descr).encode()).hexdigest()[:12], 16))


def place(dtype: np.dtype, *names: str) -> int:
    """Where a field, by the names on the way to it, lies in a record of numbers, counted in numbers."""
    at = 0
    for name in names:
        dtype, offset = dtype.fields[name][:2]
        at += offset
    return at // 8


def view(data: mujoco.MjData, dtype: np.dtype):
    """The world in `data.userdata` as a record: reads and writes go to MuJoCo's memory."""
    return np.asarray(data.userdata).view(dtype).view(np.recarray)[0]


def new_world(dtype: np.dtype, step: float):
    """A world with its header filled, all else zero, as a recarray of shape (1,)."""
    world = np.zeros(1, dtype=dtype).view(np.recarray)
    world[0].header.magic, world[0].header.version, world[0].header.step = MAGIC, layout_version(dtype), step
    return world


@kernel
def begin(world, time: float) -> None:
    """Bring the world to `time` (s): one step later than the last call, the same time again, or the start."""
    header = world.header
    if header.started == 0.0:
        header.started, header.time = 1.0, time
        return
    moved = time - header.time
    if moved == 0.0:
        return
    if abs(moved - header.step) > 1e-6 * header.step:
        stop(world, TIME_JUMP, time)
    world.now = world.later
    header.time = time


@kernel
def check_finite(world, value: float, time: float) -> None:
    """Record that a number which sums up the step is not finite."""
    if not math.isfinite(value):
        stop(world, NOT_FINITE, time)


@kernel
def stop(world, status: float, time: float) -> None:
    """Record the first thing that went wrong, and when (s)."""
    if world.header.status == RUNNING:
        world.header.status, world.header.status_time = status, time


@kernel
def stop_in(userdata, status: float, time: float) -> None:
    """The same in a world as the flat numbers of userdata."""
    if userdata[_STATUS] == RUNNING:
        userdata[_STATUS], userdata[_STATUS_TIME] = status, time
