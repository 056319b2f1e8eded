"""The Rerun file of a run: what stands in it, and what a killed process leaves."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest
from rerun.chunk import RrdReader

from ars_mujoco.recording.recording import Event, Recording, scene_of
from ars_mujoco.recording.rerun.rerun_file import RerunFile, write_rerun
from ars_mujoco.schema.channels import Channel
from ars_mujoco.schema.plots import Plot, Tab

ROOM = Path(__file__).parents[1]  # where `synthetic` is


@pytest.fixture(scope="module")
def path(run, tmp_path_factory):
    """The run, written in three chunks."""
    path = tmp_path_factory.mktemp("rerun") / "run.rrd"
    file = RerunFile(path, run)
    for start, stop in ((0, 2), (2, 4.5), (4.5, 100)):
        file.append(run.part(start, stop))
    file.finish(run)
    return path


def table(path, entity, component):
    """Times in ns (n,) and values of one component of one entity."""
    batches = []
    for chunk in RrdReader(path).store().stream().filter(content=entity, has_timeline="sim_time").to_chunks():
        batch = chunk.to_record_batch()
        if component in batch.schema.names:
            batches.append((batch["sim_time"].cast("int64").to_numpy(), batch[component].to_pylist()))
    batches.sort(key=lambda item: item[0][0])
    return np.concatenate([time for time, _ in batches]), np.array([row for _, rows in batches for row in rows])


def static(path, entity, component):
    """The last static value of one component of one entity."""
    chunks = [chunk for chunk in RrdReader(path).store().stream().filter(content=entity).to_chunks() if chunk.is_static]
    batches = [chunk.to_record_batch() for chunk in chunks]
    return [batch[component].to_pylist()[-1] for batch in batches if component in batch.schema.names][-1]


def test_signals_are_shown_in_degrees_at_exact_nanoseconds(run, path):
    time, roll = table(path, "/signals/body/roll", "Scalars:scalars")
    np.testing.assert_array_equal(time, np.arange(601) * 10_000_000)
    np.testing.assert_array_equal(roll[:, 0], run["body.roll"][::10] * (180 / np.pi))
    assert static(path, "/signals/body/roll", "SeriesLines:names") == ["roll [deg]"]


def test_signals_of_a_plot_share_an_entity_and_carry_their_unit(run, path):
    names = static(path, "/signals/energy/power", "SeriesLines:names")
    assert {"front pump shaft power [W]", "front motor output power [W]"} <= set(names)
    _, power = table(path, "/signals/energy/power", "Scalars:scalars")
    column = names.index("rear pump shaft power [W]")
    np.testing.assert_array_equal(power[:, column], run["rear.pump.shaft_power"][::10])


def test_no_channel_is_left_out(run, path):
    columns = RrdReader(path).store().schema().component_columns()
    entities = {column.entity_path for column in columns if "Scalars" in column.component}
    series = sum(len(static(path, entity, "SeriesLines:names")) for entity in entities)
    assert series == len(run.channels)


def test_bodies_stand_at_their_poses(run, path):
    time, position = table(path, "/world/car/rl_wheel", "Transform3D:translation")
    _, rotation = table(path, "/world/car/rl_wheel", "Transform3D:quaternion")
    np.testing.assert_array_equal(time[0], 0)
    np.testing.assert_allclose(position[:, 0], run.body("rl_wheel")[:, :3], rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(rotation[:, 0], run.body("rl_wheel")[:, [4, 5, 6, 3]], atol=1e-6)


def test_the_chase_takes_place_and_heading_only(run, path):
    _, position = table(path, "/world/car/chase", "Transform3D:translation")
    _, rotation = table(path, "/world/car/chase", "Transform3D:quaternion")
    np.testing.assert_allclose(position[:, 0, :2], run.body("body")[:, :2], rtol=1e-6)
    assert (position[:, 0, 2] == 0).all()
    assert (rotation[:, 0, :2] == 0).all()
    np.testing.assert_allclose(2 * np.arctan2(rotation[:, 0, 2], rotation[:, 0, 3]), run["body.yaw"][::10], atol=1e-3)


def test_a_tires_load_points_up_from_the_road(run, path):
    _, vectors = table(path, "/world/car/tire_forces", "Arrows3D:vectors")
    _, origins = table(path, "/world/car/tire_forces", "Arrows3D:origins")
    load_of_fl = vectors[:, 0]
    np.testing.assert_allclose(load_of_fl[:, 2], 0.2e-3 * run["fl.tire.vertical_force"][::10], rtol=1e-5)
    assert (load_of_fl[:, :2] == 0).all()
    np.testing.assert_allclose(origins[:, 0, 2], run.body("fl_wheel")[:, 2] - 0.32, atol=1e-5)


def test_lateral_forces_point_into_the_curve(run, path):
    _, vectors = table(path, "/world/car/tire_forces", "Arrows3D:vectors")
    frame = np.searchsorted(run.pose_time, 2.9)
    yaw = run["body.yaw"][10 * frame]
    left = np.array((-np.sin(yaw), np.cos(yaw), 0))
    for corner in range(4):
        assert vectors[frame, 2 * corner + 1] @ left > 0


def test_the_bar_lifts_its_left_link_and_lowers_its_right_in_a_left_curve(run, path):
    _, vectors = table(path, "/world/car/front_bar_forces", "Arrows3D:vectors")
    frame = np.searchsorted(run.pose_time, 2.9)
    force = run["front.bar.torque"][10 * frame] / 0.15
    assert vectors[frame, 0, 2] == pytest.approx(0.1e-3 * force, rel=0.02)
    assert vectors[frame, 1, 2] == pytest.approx(-0.1e-3 * force, rel=0.02)


def test_events_and_notes_can_be_read(run, path):
    time, text = table(path, "/events", "TextLog:text")
    assert [(t / 1e9, line) for t, (line,) in zip(time, text, strict=True)] == [(e.time, e.text) for e in run.events]
    (notes,) = static(path, "/meta/run", "TextDocument:text")
    assert "| peak_roll | 3.4377 deg |" in notes
    assert "| actuators.front | made up |" in notes


def test_the_layout_is_in_the_file_and_only_the_final_name_is_left(path):
    assert len(RrdReader(path).blueprints()) == 1
    assert [file.name for file in path.parent.iterdir()] == ["run.rrd"]


def test_a_rig_without_a_car_is_recorded_too(tmp_path):
    model = mujoco.MjModel.from_xml_string("""
        <mujoco><worldbody>
          <body name="bar_left"><joint axis="0 1 0"/><geom type="capsule" size="0.02 0.2"/></body>
        </worldbody></mujoco>""")
    time = np.arange(11) * 0.01
    run = Recording(
        title="bench",
        channels={"bar.angle": Channel("bar.angle", "rad", "angle"), "odd": Channel("odd", "kg/m", "unlisted unit")},
        time=time,
        values=np.column_stack((time, np.full(11, np.nan))),
        bodies=["bar_left"],
        scene=scene_of(model),
        tabs=(Tab("bar", (Plot("bar angle", ("bar.command", "bar.angle")),)),),
        pose_time=time,
        poses=np.tile((0, 0, 0, 1.0, 0, 0, 0), (11, 1, 1)),
        events=[Event(0.0, "INFO", "start")],
    )
    write_rerun(tmp_path / "run.rrd", run)
    entities = RrdReader(tmp_path / "run.rrd").store().schema().entity_paths()
    assert {"/signals/bar/bar_angle", "/world/car/bar_left", "/signals/odd/kg_per_m"} <= set(entities)


def test_a_run_that_fails_leaves_all_up_to_the_failure_under_its_unfinished_name(run, tmp_path):
    def fail_after_a_second():
        with RerunFile(tmp_path / "run.rrd", run) as file:
            file.append(run.part(0, 1))
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail_after_a_second()
    assert [file.name for file in tmp_path.iterdir()] == ["run.rrd.part"]
    time, _ = table(tmp_path / "run.rrd.part", "/signals/body/roll", "Scalars:scalars")
    assert len(time) == 100


def test_a_run_without_a_step_is_a_file_too(run, tmp_path):
    with RerunFile(tmp_path / "run.rrd", run.part(0, 0)) as file:
        file.finish(run.part(0, 0))
    assert len(RrdReader(tmp_path / "run.rrd").blueprints()) == 1


KILLED = """
import sys, time
from pathlib import Path
sys.path.insert(0, {here!r})
from synthetic import s_curve
from ars_mujoco.recording.rerun.rerun_file import RerunFile
run = s_curve(duration=3.0)
file = RerunFile(Path({path!r}), run)
for start in (0.0, 1.0):
    time.sleep(0.55)
    file.append(run.part(start, start + 1))
time.sleep(0.5)
print("two of three seconds", flush=True)
time.sleep(60)
"""


def test_a_killed_process_leaves_what_was_simulated_and_no_final_name(tmp_path):
    path = tmp_path / "run.rrd"
    script = KILLED.format(here=str(ROOM), path=str(path))
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, cwd=ROOM.parents[1])
    assert process.stdout.readline().strip() == b"two of three seconds"
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert not path.exists()
    with pytest.warns(match="no footer"):
        reader = RrdReader(tmp_path / "run.rrd.part")
    chunks = reader.stream().filter(content="/signals/body/roll").to_chunks()
    rows = sum(chunk.num_rows for chunk in chunks if not chunk.is_static)
    assert rows == 200
