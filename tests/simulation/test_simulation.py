"""The simulation: samples, chunks and what it does with a run that goes wrong."""

import mujoco
import numpy as np
import pytest
import shipped

from ars_mujoco.excitation.knots import JOINS
from ars_mujoco.recording.recording import joined
from ars_mujoco.schema.errors import SimulationError
from ars_mujoco.simulation.simulation import LAST_SAMPLES, simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

CYCLES = ("s_curve_120kmh", "step_steer_iso7401", "single_wheel_bump", "roll_plane_step", "bench_step_10deg")


@pytest.mark.parametrize("cycle", CYCLES)
def test_a_recording_has_a_sample_each_step_and_a_pose_each_hundredth_second(cycle):
    simulation, recording = shipped.simulation(cycle), shipped.recording(cycle)
    steps = round(simulation.duration / 0.001)
    np.testing.assert_allclose(recording.time, 0.001 * np.arange(steps + 1), rtol=1e-9)
    np.testing.assert_allclose(recording.pose_time, 0.01 * np.arange(steps // 10 + 1), rtol=1e-9)
    assert recording.values.shape == (steps + 1, len(recording.channels))
    assert recording.poses.shape == (steps // 10 + 1, len(recording.bodies), 7)
    assert np.isfinite(recording.values).all()


def test_poses_and_channels_are_of_the_same_moment():
    recording = shipped.recording("s_curve_120kmh")
    seen = recording.at_poses()
    np.testing.assert_array_equal(recording.body("body")[:, 0], seen["body.x"])
    np.testing.assert_array_equal(recording.body("body")[:, 1], seen["body.y"])


def test_the_chunks_are_the_recording():
    chunks = []
    recording = simulate(shipped.simulation("step_steer_iso7401"), chunks.append)
    assert [round(chunk.time[0], 3) for chunk in chunks] == [0.0, 2.0, 4.0, 5.0]  # the last sample needs no step
    for name in ("time", "values", "pose_time", "poses"):
        np.testing.assert_array_equal(getattr(joined(chunks), name), getattr(recording, name))


@pytest.mark.parametrize("duration", ["2 s", "1.999 s", "1 ms", "2.005 s"])
def test_a_cycle_ends_with_its_duration_wherever_the_chunks_end(duration):
    recording = shipped.recording("bench_s_curve", None, f"duration={duration}")
    seconds = float(duration.split()[0]) * (0.001 if "ms" in duration else 1)
    assert recording.time[-1] == pytest.approx(seconds)
    assert recording.time.size == round(seconds / 0.001) + 1
    assert np.isfinite(recording.values).all()


@pytest.mark.parametrize("cycle", CYCLES)
def test_the_same_cycle_twice_gives_identical_columns(cycle):
    again = simulate(simulation_of(read_inputs(cycle)))
    assert again.values.tobytes() == shipped.recording(cycle).values.tobytes()
    assert again.poses.tobytes() == shipped.recording(cycle).poses.tobytes()


# ---- what goes wrong


def not_a_number_at_3_s(cycle: str):
    """A cycle in which something is not a number from about 3 s on: a bump, a force or a command."""
    simulation, world = shipped.own_copy(shipped.simulation(cycle))
    p = world.parameters
    if cycle == "s_curve_120kmh":
        p.bump.side, p.bump.height, p.bump.length, p.bump.position = 1.0, np.nan, 1.0, 100.0
        return simulation
    signal = p.acceleration if cycle == "roll_plane_step" else p.command.knots
    signal.count, signal.join = 2.0, JOINS.index("step")
    signal.times[:2], signal.values[:2] = (0.0, 2.995), (1e-3, np.nan)
    return simulation


@pytest.fixture
def aside(tmp_path, monkeypatch):
    """MuJoCo writes what it warns of into the current folder."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("cycle", ["s_curve_120kmh", "roll_plane_step", "bench_s_curve"])
def test_a_run_that_diverges_is_an_error_with_time_channel_and_last_samples(cycle, aside):
    chunks = []
    with pytest.raises(SimulationError, match=r"diverged at [23]\.\d+ s: \S+ is not finite") as raised:
        simulate(not_a_number_at_3_s(cycle), chunks.append)
    error = raised.value
    assert 2.9 < error.time < 3.1
    assert error.channel in chunks[0].channels
    (samples,) = error.samples.values()
    assert len(samples) == LAST_SAMPLES
    assert np.isfinite(samples[:-1]).all()
    assert np.isnan(samples[-1])
    got = joined(chunks)
    np.testing.assert_allclose(got.time, 0.001 * np.arange(got.time.size), rtol=1e-9)
    assert got.time[-1] == pytest.approx(error.time)
    assert np.isfinite(got.values[:-2]).all()  # noticed at the latest a step later
    assert len(got.pose_time) == len(got.poses) == -(-got.time.size // 10)


def test_a_start_that_is_not_finite_is_an_error_at_0_s(aside):
    simulation, _ = shipped.own_copy(shipped.simulation("s_curve_120kmh"))
    simulation.model.key_qvel[0, 0] = np.nan
    chunks = []
    with pytest.raises(SimulationError) as raised:
        simulate(simulation, chunks.append)
    assert raised.value.time == 0.0
    assert chunks[0].time.size == 1


def test_a_step_of_another_length_is_an_error_that_says_so():
    simulation, _ = shipped.own_copy(shipped.simulation("s_curve_120kmh"))
    simulation.model.opt.timestep = 0.002
    with pytest.raises(SimulationError, match=r"time jumped to 0\.002 s: the simulation steps by 0\.001 s only"):
        simulate(simulation)


def test_a_run_that_went_wrong_leaves_no_callback_behind(aside):
    with pytest.raises(SimulationError):
        simulate(not_a_number_at_3_s("bench_s_curve"))
    assert mujoco.get_mjcb_control() is None
