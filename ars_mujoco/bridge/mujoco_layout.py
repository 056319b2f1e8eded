"""Where MuJoCo keeps its fields: byte offsets in mjData and mjModel, from MuJoCo's own description of its structs.

The offsets follow from `mujoco.introspect` and C's alignment rules; `validate` holds them against a live model and
data, so that a MuJoCo whose structs differ is refused instead of being read at the wrong place.
"""

import ctypes
from functools import cache

import mujoco
import numpy as np
from mujoco.introspect import ast_nodes, enums, structs

from ars_mujoco.schema.errors import ArsError

# the fields that the callback reads or writes
DATA_FIELDS = (
    "qpos", "qvel", "ctrl", "qfrc_applied", "xfrc_applied", "mocap_pos", "userdata",
    "xpos", "xquat", "xmat", "site_xpos", "xanchor", "xaxis",
)  # fmt: skip
MODEL_FIELDS = ("numeric_data",)
MODEL_NUMBERS = ("signature", "nuserdata", "nnumericdata")

_SIZES = {"char": 1, "mjtByte": 1, "mjtBool": 1, "int": 4, "float": 4, "unsigned int": 4}  # all others: 8 bytes


@cache
def offsets(struct: str) -> dict[str, int]:
    """Byte offset of every field of `struct` ("mjData" or "mjModel")."""
    table, _, _ = _layout(struct)
    return table


def validate(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Hold the offsets the callback uses against live objects; raises ArsError where MuJoCo keeps a field elsewhere."""
    found = {("mjModel", name): (_word(model, "mjModel", name), getattr(model, name)) for name in MODEL_NUMBERS}
    for struct, live, names in (("mjData", data, DATA_FIELDS), ("mjModel", model, MODEL_FIELDS)):
        for name in names:
            array = getattr(live, name)
            if array.size:
                found[struct, name] = (_word(live, struct, name), array.ctypes.data)
    for (struct, name), (read, true) in found.items():
        if read != true:
            raise ArsError(f"MuJoCo {mujoco.__version__} keeps {struct}.{name} elsewhere than its description says")


def _word(live, struct: str, name: str) -> int:
    return ctypes.c_uint64.from_address(live._address + offsets(struct)[name]).value


def _layout(struct: str) -> tuple[dict[str, int], int, int]:
    table, at, widest = {}, 0, 1
    for field in structs.STRUCTS[struct].fields:
        size, alignment = _size(field if hasattr(field, "fields") else field.type)
        at = _aligned(at, alignment)
        table[field.name], at, widest = at, at + size, max(widest, alignment)
    return table, _aligned(at, widest), widest


def _size(kind) -> tuple[int, int]:
    """(size, alignment) in bytes of a type of MuJoCo's description."""
    if isinstance(kind, ast_nodes.ArrayType):
        size, alignment = _size(kind.inner_type)
        return size * int(np.prod(kind.extents)), alignment
    if isinstance(kind, ast_nodes.PointerType):
        return 8, 8
    if hasattr(kind, "fields"):  # an anonymous struct
        at, widest = 0, 1
        for field in kind.fields:
            size, alignment = _size(field.type)
            at, widest = _aligned(at, alignment) + size, max(widest, alignment)
        return _aligned(at, widest), widest
    if kind.name in structs.STRUCTS:
        _, size, alignment = _layout(kind.name)
        return size, alignment
    size = 4 if kind.name in enums.ENUMS else _SIZES.get(kind.name, 8)
    return size, size


def _aligned(at: int, alignment: int) -> int:
    return -(-at // alignment) * alignment
