"""Several runs in one file: each below its name, ghosts riding along with the solid run."""

from dataclasses import replace

import numpy as np
import pytest
from rerun.chunk import RrdReader
from synthetic import s_curve

from ars_mujoco.recording.rerun.comparison import riding_with, write_comparison
from ars_mujoco.recording.rerun.rotation import roll_of, yaw_of
from ars_mujoco.schema.plots import Plot, Tab


@pytest.fixture(scope="module")
def flat():
    return s_curve(gradient=0.012, duration=6.0)


def test_each_run_stands_below_its_name(run, flat, tmp_path):
    write_comparison(tmp_path / "compare.rrd", {"passive": run, "pump_controlled": flat})
    assert [file.name for file in tmp_path.iterdir()] == ["compare.rrd"]
    reader = RrdReader(tmp_path / "compare.rrd")
    assert len(reader.blueprints()) == 1
    paths = set(reader.store().schema().entity_paths())
    for name in ("passive", "pump_controlled"):
        assert {f"/{name}/signals/body/roll", f"/{name}/world/car/body", f"/{name}/meta/run"} <= paths
    assert "/pump_controlled/world/scene/trail" in paths
    assert "/passive/world/scene/trail" not in paths


def test_runs_of_different_systems_share_the_tabs_of_all(run, flat, tmp_path):
    own = (Tab("motor", (Plot("torque", ("front.bar.torque", "rear.bar.torque")),)),)
    write_comparison(tmp_path / "compare.rrd", {"pump": run, "motor": replace(flat, tabs=own)})
    paths = set(RrdReader(tmp_path / "compare.rrd").store().schema().entity_paths())
    for name in ("pump", "motor"):
        assert {f"/{name}/signals/motor/torque", f"/{name}/signals/front_axle/bar_angle"} <= paths


def test_a_ghost_takes_place_and_heading_and_keeps_its_roll(run, flat):
    elsewhere = s_curve(gradient=-0.05, duration=6.0)
    elsewhere.poses[..., :3] += (3.0, -7.0, 0.0)
    riding = riding_with(elsewhere, flat)
    np.testing.assert_allclose(riding.body("body")[:, :2], flat.body("body")[:, :2], atol=1e-9)
    np.testing.assert_allclose(yaw_of(riding.body("body")[:, 3:]), yaw_of(flat.body("body")[:, 3:]), atol=1e-12)
    np.testing.assert_allclose(roll_of(riding.body("body")[:, 3:]), roll_of(elsewhere.body("body")[:, 3:]), atol=1e-12)


def test_a_ghost_shorter_than_the_run_rides_as_long_as_it_lasts(run, flat):
    riding = riding_with(run.part(0, 2), flat)
    np.testing.assert_allclose(riding.body("body")[:, :2], flat.body("body")[:200, :2], atol=1e-9)


def test_a_run_rides_with_itself_unmoved(run):
    np.testing.assert_allclose(riding_with(run, run).poses, run.poses, atol=1e-9)
