"""A recording: channels by name, chunks that join to the whole, the scene of a model."""

import mujoco
import numpy as np
import pytest

from ars_mujoco.recording.recording import joined, scene_of


def test_a_channel_is_found_by_its_name(run):
    assert np.degrees(run["body.roll"]).max() == pytest.approx(3.44, abs=0.01)
    with pytest.raises(KeyError):
        run["body.rol"]


def test_chunks_joined_are_the_run(run):
    whole = joined([run.part(0, 2.5), run.part(2.5, 4), run.part(4, 100)])
    for name in ("time", "values", "pose_time", "poses"):
        np.testing.assert_array_equal(getattr(whole, name), getattr(run, name))
    assert whole.events == run.events


def test_values_at_poses_are_those_of_the_same_time(run):
    shown = run.at_poses()
    np.testing.assert_array_equal(shown.time, run.pose_time)
    np.testing.assert_array_equal(shown["body.x"], shown.body("body")[:, 0])


def test_the_scene_holds_what_a_viewer_shows():
    model = mujoco.MjModel.from_xml_string("""
        <mujoco><worldbody>
          <geom type="plane" size="1 1 1"/>
          <body name="bob" pos="0 0 1">
            <joint/>
            <geom type="capsule" size="0.1 0.4" pos="0 0.5 0" rgba="1 0 0 0.5"/>
            <geom type="box" size="1 1 1" group="3"/>
          </body>
        </worldbody></mujoco>""")
    (geom,) = scene_of(model)
    assert (geom.body, geom.type) == ("bob", "capsule")
    np.testing.assert_allclose(geom.size[:2], (0.1, 0.4))
    np.testing.assert_allclose(geom.pos, (0, 0.5, 0))
    np.testing.assert_allclose(geom.rgba, (1, 0, 0, 0.5))
