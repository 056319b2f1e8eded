"""The world's record and how it moves on in time."""

import mujoco
import numpy as np
import pytest

from ars_mujoco.bridge.world import (
    MAGIC,
    NOT_FINITE,
    RUNNING,
    TIME_JUMP,
    begin,
    check_finite,
    layout_version,
    new_world,
    stop,
    view,
    world_dtype,
)

BLOCK = np.dtype([("number", "f8")])
WORLD = world_dtype(BLOCK, BLOCK, BLOCK, BLOCK)


@pytest.fixture
def world():
    """A world that has just been called at 1 s, with 1 in `now` and 2 in `later`."""
    world = new_world(WORLD, 0.001)[0]
    begin(world, 1.0)
    world.now.number, world.later.number = 1.0, 2.0
    return world


def test_a_new_world_is_marked_and_has_a_version_but_has_not_started():
    header = new_world(WORLD, 0.001)[0].header
    assert (header.magic, header.version, header.step) == (MAGIC, layout_version(WORLD), 0.001)
    assert (header.started, header.status) == (0.0, RUNNING)


def test_worlds_of_other_fields_have_other_versions():
    other = np.dtype([("figure", "f8")])
    assert layout_version(WORLD) != layout_version(world_dtype(BLOCK, BLOCK, BLOCK, other))
    assert layout_version(WORLD) == layout_version(world_dtype(BLOCK, BLOCK, BLOCK, BLOCK))


def test_the_world_is_all_float64_so_that_userdata_holds_it():
    assert WORLD.itemsize % 8 == 0
    assert len(WORLD) == 6
    assert new_world(WORLD, 0.001).view(np.float64)[0] == MAGIC  # the first number of userdata


def test_a_view_writes_to_mujocos_memory():
    spec = mujoco.MjSpec()
    spec.nuserdata = WORLD.itemsize // 8
    data = mujoco.MjData(spec.compile())
    view(data, WORLD).now.number = 7.0
    assert 7.0 in data.userdata
    assert view(data, WORLD).now.number == 7.0


@pytest.mark.parametrize("start", [0.0, 3.7])
def test_the_first_call_may_be_at_any_time(start):
    world = new_world(WORLD, 0.001)[0]
    world.now.number = 1.0
    begin(world, start)
    assert (world.header.time, world.header.started, world.header.status) == (start, 1.0, RUNNING)
    assert world.now.number == 1.0


def test_at_the_same_time_again_nothing_moves(world):
    before = world.copy()
    begin(world, 1.0)
    assert world == before


def test_one_step_later_what_was_later_is_now(world):
    begin(world, 1.001)
    assert (world.now.number, world.header.time, world.header.status) == (2.0, 1.001, RUNNING)


def test_a_hundred_thousand_rounded_steps_are_no_jump():
    world, time = new_world(WORLD, 0.001)[0], 0.0
    for _ in range(100_000):
        begin(world, time)
        time += 0.001
    assert world.header.status == RUNNING
    begin(world, 1000.0)
    assert world.header.status == TIME_JUMP


@pytest.mark.parametrize("time", [0.0, 0.999, 1.0005, 1.002, 5.0])
def test_any_other_time_is_a_jump(world, time):
    begin(world, time)
    assert (world.header.status, world.header.status_time) == (TIME_JUMP, time)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_stops_the_world(world, value):
    check_finite(world, 1e300, 1.0)
    assert world.header.status == RUNNING
    check_finite(world, value, 1.0)
    assert (world.header.status, world.header.status_time) == (NOT_FINITE, 1.0)


def test_the_first_thing_that_went_wrong_is_kept(world):
    stop(world, NOT_FINITE, 1.0)
    stop(world, TIME_JUMP, 2.0)
    assert (world.header.status, world.header.status_time) == (NOT_FINITE, 1.0)
