"""The native loop records what a plain loop over mj_step sees."""

import mujoco
import numpy as np
import pytest
import shipped

from ars_mujoco.bridge import world as worlds
from ars_mujoco.bridge.callback import installed
from ars_mujoco.bridge.native_loop import advance

STEPS, STRIDE, MADE_BEFORE = 45, 10, 3


@pytest.fixture(params=["s_curve_120kmh", "roll_plane_step", "bench_s_curve"])
def simulation(request):
    return shipped.simulation(request.param)


def recorded(simulation, data, python=False, channels=12):
    """(steps made, times, values, poses) from `data` on."""
    times, values = np.full(STEPS, np.nan), np.full((STEPS, channels), np.nan)
    poses = np.full((len(range(-MADE_BEFORE % STRIDE, STEPS, STRIDE)), simulation.model.nbody, 7), np.nan)
    slots = simulation.rig.slots[:channels]
    with installed(simulation.rig, simulation.model, data):
        made = advance(simulation.model, data, times, values, poses, STRIDE, slots, MADE_BEFORE, python)
    return made, times, values, poses


def test_it_records_bit_for_bit_what_a_python_loop_records(simulation):
    native, plain = (recorded(simulation, shipped.driven(simulation, 0.54), python) for python in (False, True))
    for ours, theirs in zip(native, plain, strict=True):
        np.testing.assert_array_equal(ours, theirs)
    assert np.isfinite(np.hstack([native[2].ravel(), native[3].ravel()])).all()


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
