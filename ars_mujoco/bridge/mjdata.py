"""mjData and mjModel at their addresses, as compiled code reads them."""

from collections import namedtuple

import numpy as np
from llvmlite import ir
from numba import carray, from_dtype, types
from numba.extending import intrinsic

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.bridge.world import HEADER, MAGIC, OTHER_LAYOUT
from ars_mujoco.kernels.kernel import kernel

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
def integers(_, address):
    """A pointer to the 8-byte integers at an address."""

    def codegen(context, builder, signature, args):
        return builder.inttoptr(args[0], ir.IntType(64).as_pointer())

    return types.CPointer(types.int64)(types.intp), codegen


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
