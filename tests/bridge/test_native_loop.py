"""The native loop records what a plain loop over mj_step sees."""

import ctypes

import mujoco
import numpy as np
import pytest
import shipped

from ars_mujoco.bridge import world as worlds
from ars_mujoco.bridge.callback import installed
from ars_mujoco.bridge.control import control_of
from ars_mujoco.bridge.mujoco_functions import C_FUNCTION
from ars_mujoco.bridge.native_loop import Record, advance
from ars_mujoco.schema.errors import SimulationError
from ars_mujoco.simulation.simulation import check, empty_recording

STEPS, STRIDE, MADE_BEFORE = 45, 10, 3


@pytest.fixture(params=["s_curve_120kmh", "roll_plane_step", "bench_s_curve"])
def simulation(request):
    return shipped.simulation(request.param)


def room(simulation, channels=12):
    poses = np.full((len(range(-MADE_BEFORE % STRIDE, STEPS, STRIDE)), simulation.model.nbody, 7), np.nan)
    slots = simulation.rig.slots[:channels]
    return Record(np.full(STEPS, np.nan), np.full((STEPS, channels), np.nan), poses, slots, STRIDE)


def recorded(simulation, data, **control):
    """(samples taken, times, values, poses) from `data` on; `control` replaces parts of the rig's."""
    record = room(simulation)
    made = advance(
        simulation.model, data, control_of(simulation.rig, simulation.model, data)._replace(**control), record,
        MADE_BEFORE,
    )  # fmt: skip
    return made, record.times, record.values, record.poses


def plainly(simulation, data):
    """The same by mj_step, with the rig's callback installed."""
    times, values, poses, slots, stride = room(simulation)
    frames = iter(poses)
    with installed(simulation.rig, simulation.model, data):
        for i in range(STEPS):
            mujoco.mj_step(simulation.model, data)
            times[i], values[i] = worlds.view(data, simulation.rig.WORLD).header.time, data.userdata[slots]
            if (MADE_BEFORE + i) % stride == 0:
                next(frames)[:] = np.hstack([data.xpos, data.xquat])
    return STEPS, times, values, poses


def test_it_records_bit_for_bit_what_a_python_loop_over_mj_step_records(simulation):
    native, plain = (record(simulation, shipped.driven(simulation, 0.54)) for record in (recorded, plainly))
    for ours, theirs in zip(native, plain, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    assert np.isfinite(np.hstack([native[2].ravel(), native[3].ravel()])).all()


def test_so_does_the_loop_of_the_interpreted_twin(simulation):
    def control(model, data):
        native(model._address, data._address)

    native = C_FUNCTION(simulation.rig.CALLBACK.address)
    in_python = recorded(simulation, shipped.driven(simulation, 0.54), callback=control)
    for ours, theirs in zip(in_python, recorded(simulation, shipped.driven(simulation, 0.54)), strict=True):
        np.testing.assert_array_equal(ours, theirs)


def test_what_others_install_as_mujocos_callback_does_not_reach_it(simulation):
    def theirs(model, data):
        data.qfrc_applied[:] = 1e3

    alone = recorded(simulation, shipped.driven(simulation, 0.54))
    data = shipped.driven(simulation, 0.54)
    mujoco.set_mjcb_control(theirs)
    try:
        beside = recorded(simulation, data)
    finally:
        mujoco.set_mjcb_control(None)
    for ours, same in zip(beside, alone, strict=True):
        np.testing.assert_array_equal(ours, same)


def test_a_step_whose_control_leaves_the_world_where_it_was_stops_the_run(simulation):
    nothing = C_FUNCTION(lambda model, data: None)
    data = shipped.driven(simulation, 0.54)
    made, *_ = recorded(simulation, data, callback=ctypes.cast(nothing, ctypes.c_void_p).value)
    assert made == 1
    with pytest.raises(SimulationError, match=r"the step at 0\.54 s did not advance the world"):
        check(simulation, data, empty_recording(simulation))


def test_a_sample_is_of_the_time_before_its_step(simulation):
    data = shipped.driven(simulation, 0.54)
    _, times, _, _ = recorded(simulation, data)
    np.testing.assert_allclose(times, 0.54 + 0.001 * np.arange(STEPS), rtol=1e-12)
    assert data.time == pytest.approx(0.54 + 0.001 * STEPS)


def test_poses_are_of_every_tenth_step_of_the_whole_run(simulation):
    _, _, _, poses = recorded(simulation, shipped.driven(simulation, 0.54))
    data = shipped.driven(simulation, 0.54 + 0.001 * 7)  # three steps were made before, seven more make ten
    with installed(simulation.rig, simulation.model, data):
        mujoco.mj_forward(simulation.model, data)
    np.testing.assert_allclose(poses[0], np.hstack([data.xpos, data.xquat]), rtol=0, atol=1e-12)


def test_it_stops_at_the_step_in_which_something_went_wrong(simulation, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes what it warns of into the current folder
    data = shipped.driven(simulation, 0.54)
    worlds.view(data, simulation.rig.WORLD).later.system.front.circuit.angle = np.nan
    made, times, _, _ = recorded(simulation, data)
    assert made == 1
    assert worlds.view(data, simulation.rig.WORLD).header.status == worlds.NOT_FINITE
    assert np.isnan(times[1:]).all()
