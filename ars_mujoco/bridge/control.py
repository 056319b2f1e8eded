"""Control: what a step calls between mj_step's two halves, as C functions by their addresses.

    callback                      the rig with the shipped controller
    sense ─> law, if due ─> act   the rig with a user's law between, compiled or in Python

The interpreted twin (NUMBA_DISABLE_JIT=1) has one Python function in its place.
"""

from typing import NamedTuple

import mujoco
import numpy as np
from numba import carray

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.mjdata import Fields, call, doubles, word
from ars_mujoco.bridge.mujoco_functions import C_FUNCTION
from ars_mujoco.bridge.world import HEADER, MAGIC, OTHER_LAYOUT, RUNNING, place, stop
from ars_mujoco.kernels.kernel import interpreted, kernel
from ars_mujoco.schema.errors import ArsError

_USERDATA, _NUSERDATA = mujoco_layout.offsets("mjData")["userdata"], mujoco_layout.offsets("mjModel")["nuserdata"]
_STEP, _STATUS = (HEADER.names.index(name) for name in ("step", "status"))


class Control(NamedTuple):
    """C functions void(mjModel*, mjData*): `callback`, and where `law` is not 0, it at the samples of the control unit
    and then `act`. `sample_time` is where userdata holds the unit's, `size` how many numbers it has, and `version` the
    layout of the world in it.

    In the interpreted twin `callback` is a Python function.
    """

    callback: object
    size: int
    version: int
    law: int = 0
    act: int = 0
    sample_time: int = 0


def control_of(rig, model: mujoco.MjModel, data: mujoco.MjData, law=None) -> Control:
    """The Control of `rig`, with a running `law` (a `law_run.LawRun`) in place of the shipped controller.

    `data` is used to hold the struct offsets against. Raises ArsError for an integrator that calls more than once a
    step, and for a model not built for this rig.
    """
    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        raise ArsError("integrator RK4 is refused: it evaluates forces four times a step, the hydraulics advance once")
    if not _carries(model, rig):
        raise ArsError(f"this model was not built for the rig '{rig.NAME}': it carries no world of its layout")
    mujoco_layout.validate(model, data)
    layout = rig.SIZE, int(rig.VERSION)
    if interpreted:
        return Control(_in_python(rig, law), *layout)
    if not law:
        return Control(rig.CALLBACK.address, *layout)
    sample_time = place(rig.WORLD, "parameters", "unit", "sample_time")
    return Control(rig.SENSE.address, *layout, law.sampling(rig), rig.ACT.address, sample_time)


@kernel
def run(control, model: int, data: int, time: float) -> None:
    """Call a Control, as a plain tuple, for mjModel and mjData at their addresses."""
    callback, size, version, law, act, sample_time = control
    call(callback, model, data)
    if law != 0 and word(model + _NUSERDATA) == size:
        userdata = carray(doubles(word(data + _USERDATA)), (1 << 30,))
        if userdata[0] == MAGIC and userdata[1] == version and userdata[_STATUS] == RUNNING:
            period = max(round(userdata[sample_time] / userdata[_STEP]), 1)
            if round(time / userdata[_STEP]) % period == 0:
                call(law, model, data)
        call(act, model, data)


def run_once(control: Control, model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Call a Control without a law from Python."""
    function = control.callback
    if callable(function):
        function(model, data)
    else:
        C_FUNCTION(function)(model._address, data._address)


def tables_of(rig, model: mujoco.MjModel) -> np.record:
    """The tables that a model of `rig` holds before its initial world; what is written there stays in the model."""
    end = model.nnumericdata - rig.SIZE
    return model.numeric_data[end - rig.TABLES_SIZE : end].view(rig.TABLES).view(np.recarray)[0]


def _carries(model: mujoco.MjModel, rig) -> bool:
    """Whether `model` has a world of `rig` as its userdata and as its last custom numeric."""
    size = rig.SIZE
    if model.nuserdata != size or model.nnumericdata < size + rig.TABLES_SIZE:
        return False
    return tuple(model.numeric_data[-size:][:2]) == (MAGIC, rig.VERSION)


def _in_python(rig, law=None):
    """The interpreted twin of the callback."""

    def control(model, data):
        if not _carries(model, rig):
            return
        userdata = np.asarray(data.userdata)
        world = userdata.view(rig.WORLD).view(np.recarray)
        if world[0].header.magic != MAGIC:
            data.userdata[:] = model.numeric_data[-model.nuserdata :]
        if world[0].header.version != rig.VERSION:
            stop(world[0], OTHER_LAYOUT, data.time)
            return
        flat = (np.asarray(getattr(data, name)).reshape(-1) for name in Fields._fields[1:])
        mj, tables = Fields(data.time, *flat), tables_of(rig, model)
        if law:
            rig.sense(world[0], mj, tables)
            law.sample_if_due(rig, userdata)
            rig.act(world[0], mj, tables)
        else:
            rig.step(world[0], mj, tables)

    return control
