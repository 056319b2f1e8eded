"""The bridge to MuJoCo: a rig's step, compiled to a C function and installed as `mjcb_control`.

    mj_step ─> mjcb_control(m, d) ─> mjData fields + the world in userdata ─> rig.step ─> forces in mjData

The native callback takes no interpreter lock, so it also runs under `mujoco.batch.Batch` and in the viewer. The twin
for debugging (NUMBA_DISABLE_JIT=1) runs the same `rig.step` from Python.
"""

import contextlib
import ctypes
from collections import namedtuple

import mujoco
import numpy as np
from llvmlite import ir
from numba import carray, from_dtype, types
from numba.extending import intrinsic

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.world import HEADER, MAGIC, OTHER_LAYOUT, stop
from ars_mujoco.kernels.kernel import interpreted, kernel
from ars_mujoco.schema.errors import ArsError

# the fields of mjData a rig reads and writes, flat float64 arrays
Fields = namedtuple(
    "Fields", "time qpos qvel ctrl qfrc_applied xfrc_applied mocap_pos xpos xmat site_xpos xanchor xaxis"
)

SIGNATURE = types.void(types.intp, types.intp)  # mjModel*, mjData*

_DATA = mujoco_layout.offsets("mjData")
_MODEL = mujoco_layout.offsets("mjModel")
_TIME, _USERDATA = _DATA["time"], _DATA["userdata"]
_QPOS, _QVEL, _CTRL = _DATA["qpos"], _DATA["qvel"], _DATA["ctrl"]
_QFRC, _XFRC, _MOCAP = _DATA["qfrc_applied"], _DATA["xfrc_applied"], _DATA["mocap_pos"]
_XPOS, _XMAT, _SITE = _DATA["xpos"], _DATA["xmat"], _DATA["site_xpos"]
_XANCHOR, _XAXIS = _DATA["xanchor"], _DATA["xaxis"]
_NUSERDATA, _NNUMERICDATA, _NUMERIC = _MODEL["nuserdata"], _MODEL["nnumericdata"], _MODEL["numeric_data"]
_STATUS = HEADER.names.index("status")
_NO_BOUND = 1 << 30  # the arrays below are not bounds-checked; their true lengths are the model's


# what MuJoCo would write to its log file, the world records as a status and the loop raises
_SILENCE = ctypes.CFUNCTYPE(None, ctypes.c_char_p)(lambda _: None)


@contextlib.contextmanager
def installed(rig, model: mujoco.MjModel, data: mujoco.MjData, law=None):
    """Install `rig`'s callback for the length of a `with` block, and restore what was there.

    `data` is used to hold the struct offsets against; `law` is a `law.Law` in place of the shipped controller.
    Yields whether the callback is a Python function, which only a loop in Python may drive.
    Raises ArsError for an integrator that calls more than once a step, and for a model not built for this rig.
    """
    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        raise ArsError("integrator RK4 is refused: it evaluates forces four times a step, the hydraulics advance once")
    if not _carries(model, rig):
        raise ArsError(f"this model was not built for the rig '{rig.NAME}': it carries no world of its layout")
    mujoco_layout.validate(model, data)
    python = interpreted or law is not None and not law.is_native
    native = law.callback(rig) if law and not python else rig.CALLBACK
    function = python_callback(rig, law) if python else c_function(native.address)
    before, warned_before = mujoco.get_mjcb_control(), mujoco.get_mju_user_warning()
    mujoco.set_mjcb_control(function)
    mujoco.set_mju_user_warning(_SILENCE)
    try:
        yield python
    finally:
        mujoco.set_mjcb_control(before)
        mujoco.set_mju_user_warning(warned_before)


def _carries(model: mujoco.MjModel, rig) -> bool:
    """Whether `model` has a world of `rig` as its userdata and as its last custom numeric."""
    size = rig.SIZE
    if model.nuserdata != size or model.nnumericdata < size + rig.TABLES_SIZE:
        return False
    return tuple(model.numeric_data[-size:][:2]) == (MAGIC, rig.VERSION)


def tables_of(rig, model: mujoco.MjModel) -> np.record:
    """The tables that a model of `rig` holds before its initial world; what is written there stays in the model."""
    end = model.nnumericdata - rig.SIZE
    return model.numeric_data[end - rig.TABLES_SIZE : end].view(rig.TABLES).view(np.recarray)[0]


def c_function(address: int):
    """The ctypes function of a compiled callback."""
    return ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(address)


def python_callback(rig, law=None):
    """The same callback from Python: for debugging, and for a controller that does not compile."""

    def control(model, data):
        if not _carries(model, rig):
            return
        world = np.asarray(data.userdata).view(rig.WORLD).view(np.recarray)
        if world[0].header.magic != MAGIC:
            data.userdata[:] = model.numeric_data[-model.nuserdata :]
        if world[0].header.version != rig.VERSION:
            stop(world[0], OTHER_LAYOUT, data.time)
            return
        if not interpreted:  # only the law is in Python
            rig.native_sense(model._address, data._address)
            law.apply(world[0])
            rig.native_act(model._address, data._address)
            return
        flat = (np.asarray(getattr(data, name)).reshape(-1) for name in Fields._fields[1:])
        mj, tables = Fields(data.time, *flat), tables_of(rig, model)
        if law:
            rig.sense(world[0], mj, tables)
            law.apply(world[0])
            rig.act(world[0], mj, tables)
        else:
            rig.step(world[0], mj, tables)

    return control


@intrinsic
def word(_, address):
    """The 8-byte integer at an address."""

    def codegen(context, builder, signature, args):
        return builder.load(builder.inttoptr(args[0], ir.IntType(64).as_pointer()))

    return types.int64(types.intp), codegen


@intrinsic
def doubles(_, address):
    """A pointer to the float64 numbers at an address."""

    def codegen(context, builder, signature, args):
        return builder.inttoptr(args[0], ir.DoubleType().as_pointer())

    return types.CPointer(types.float64)(types.intp), codegen


@intrinsic
def call(_, function, first, second):
    """Call the C function void(void*, void*) at an address."""

    def codegen(context, builder, signature, args):
        integer = ir.IntType(64)
        function_type = ir.FunctionType(ir.VoidType(), [integer, integer])
        builder.call(builder.inttoptr(args[0], function_type.as_pointer()), args[1:])
        return context.get_dummy_value()

    return types.void(types.intp, types.intp, types.intp), codegen


def record_at(dtype: np.dtype):
    """An intrinsic that views the memory at an address as a record of `dtype`."""
    record = from_dtype(dtype)

    @intrinsic
    def view_record(_, address):
        def codegen(context, builder, signature, args):
            return builder.inttoptr(args[0], context.get_value_type(record))

        return record(types.intp), codegen

    return view_record


@kernel
def world_address(model: int, data: int, size: int, version: float) -> int:
    """Address of the world in userdata, `size` numbers of the layout `version`, or 0 where the model is another's.

    Where the magic is absent, as after a reset, the world is initialised from the model's last custom numeric. A world
    of another layout, as a state from another release holds it, is left alone but for its status.
    """
    first = word(model + _NNUMERICDATA) - size
    if word(model + _NUSERDATA) != size or first < 0:
        return 0
    initial = carray(doubles(word(model + _NUMERIC)), (_NO_BOUND,))
    if initial[first] != MAGIC or initial[first + 1] != version:
        return 0
    address = word(data + _USERDATA)
    userdata = carray(doubles(address), (_NO_BOUND,))
    if userdata[0] != MAGIC:
        for i in range(size):
            userdata[i] = initial[first + i]
    if userdata[1] != version:
        userdata[_STATUS] = OTHER_LAYOUT
        return 0
    return address


@kernel
def tables_address(model: int, size: int, tables_size: int) -> int:
    """Address of the tables, `tables_size` numbers that lie before the initial world of `size` numbers in the model."""
    return word(model + _NUMERIC) + 8 * (word(model + _NNUMERICDATA) - size - tables_size)


@kernel
def fields(data: int):
    """The fields of the mjData at an address."""
    return Fields(
        carray(doubles(data + _TIME), (1,))[0],
        carray(doubles(word(data + _QPOS)), (_NO_BOUND,)),
        carray(doubles(word(data + _QVEL)), (_NO_BOUND,)),
        carray(doubles(word(data + _CTRL)), (_NO_BOUND,)),
        carray(doubles(word(data + _QFRC)), (_NO_BOUND,)),
        carray(doubles(word(data + _XFRC)), (_NO_BOUND,)),
        carray(doubles(word(data + _MOCAP)), (_NO_BOUND,)),
        carray(doubles(word(data + _XPOS)), (_NO_BOUND,)),
        carray(doubles(word(data + _XMAT)), (_NO_BOUND,)),
        carray(doubles(word(data + _SITE)), (_NO_BOUND,)),
        carray(doubles(word(data + _XANCHOR)), (_NO_BOUND,)),
        carray(doubles(word(data + _XAXIS)), (_NO_BOUND,)),
    )
