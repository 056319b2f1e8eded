"""MuJoCo's fields are where its own description puts them, or are refused."""

import ctypes

import mujoco
import numpy as np
import pytest
import shipped

from ars_mujoco.bridge import mujoco_layout
from ars_mujoco.schema.errors import ArsError

CYCLES = ("s_curve_120kmh", "roll_plane_step", "bench_s_curve")
USED = [("mjData", name) for name in mujoco_layout.DATA_FIELDS if name != "mocap_pos"] + [
    ("mjModel", name) for name in (*mujoco_layout.MODEL_FIELDS, *mujoco_layout.MODEL_NUMBERS)
]


@pytest.fixture(scope="module")
def sedan():
    """(model, data) of the sedan, a step into a cycle."""
    simulation = shipped.simulation("s_curve_120kmh")
    return simulation.model, shipped.driven(simulation, 0.001)


@pytest.fixture
def misplaced(monkeypatch):
    """Move a field in the description that the offsets are read from."""
    offsets = mujoco_layout.offsets

    def move(struct, name):
        moved = offsets(struct) | {name: offsets(struct)[name] + 8}
        monkeypatch.setattr(mujoco_layout, "offsets", lambda each: moved if each == struct else offsets(each))

    return move


@pytest.mark.parametrize("cycle", CYCLES)
def test_the_offsets_hold_for_every_rig(cycle):
    simulation = shipped.simulation(cycle)
    mujoco_layout.validate(simulation.model, simulation.start())


def test_every_allocated_array_of_mjdata_is_where_its_offset_says(sedan):
    _, data = sedan
    held = 0
    for name, offset in mujoco_layout.offsets("mjData").items():
        array = getattr(data, name, None)
        if isinstance(array, np.ndarray) and array.size and array.dtype == np.float64:
            pointer = ctypes.c_uint64.from_address(data._address + offset).value
            if pointer:
                held += pointer == array.ctypes.data
    assert held > 60


def test_the_time_is_where_its_offset_says(sedan):
    _, data = sedan
    assert ctypes.c_double.from_address(data._address + mujoco_layout.offsets("mjData")["time"]).value == data.time > 0


@pytest.mark.parametrize(("struct", "name"), USED)
def test_a_field_that_is_elsewhere_is_refused_by_its_name(struct, name, sedan, misplaced):
    misplaced(struct, name)
    with pytest.raises(ArsError, match=rf"{mujoco.__version__} keeps {struct}\.{name} elsewhere"):
        mujoco_layout.validate(*sedan)
