"""A wheel built from the project brings its models and cycles along, and runs away from the checkout."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The folder that the wheel was installed in."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=PROJECT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target"]
    subprocess.run([*install, str(folder / "site"), str(wheel)], check=True, capture_output=True)
    return folder / "site"


@pytest.fixture
def away(installed, tmp_path):
    """Run a command of the installed package in an empty folder, with an empty cache; returns its stdout."""
    environment = os.environ | {"PYTHONPATH": str(installed)}
    here = tmp_path / "here"
    here.mkdir()

    def call(*command):
        done = subprocess.run(command, cwd=here, env=environment, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call


def test_everything_lies_inside_the_package(installed):
    assert {path.name.split("-")[0] for path in installed.iterdir()} == {"ars_mujoco", "bin"}


def test_the_shipped_files_are_found_away_from_the_checkout(installed, away):
    code = (
        "from ars_mujoco.schema.library import *; print(*(path for kind in SHIPPED for path in shipped(kind).values()))"
    )
    found = away(sys.executable, "-c", code).split()
    assert all(Path(path).is_relative_to(installed) for path in found)
    assert {"s_curve_120kmh", "sedan", "pump_controlled", "cascade"} <= {Path(path).stem for path in found}
    assert Path(found[0]).with_name("bench_recorded.csv").is_file()


def test_its_command_lists_what_is_shipped(installed, away):
    assert "s_curve_120kmh" in away(installed / "bin" / "ars", "list")


def test_its_command_runs_a_cycle(installed, away, tmp_path):
    result = json.loads(away(installed / "bin" / "ars", "run", "bench_step_1deg", "--set", "duration=50 ms", "--json"))
    assert result["runs"]["verification"]["metrics"]["energy_audit_error"]["value"] < 1e-3
    folder = tmp_path / "here" / "runs" / "bench_step_1deg" / "verification"
    assert sorted(path.name for path in folder.iterdir()) == ["run.parquet", "run.rrd", "summary.json"]
