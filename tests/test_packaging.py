"""A wheel built from the project brings its models and cycles along."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

PROJECT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The folder that the unpacked wheel was put in."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=PROJECT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    zipfile.ZipFile(wheel).extractall(folder / "site")
    return folder / "site"


def test_everything_lies_inside_the_package(installed):
    assert {path.name.split("-")[0] for path in installed.iterdir()} == {"ars_mujoco"}


def test_the_shipped_files_are_found_away_from_the_checkout(installed, tmp_path):
    code = "from ars_mujoco.library import *; print(*(path for kind in SHIPPED for path in shipped(kind).values()))"
    environment = os.environ | {"PYTHONPATH": str(installed)}
    found = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True, capture_output=True, text=True
    ).stdout.split()
    assert all(Path(path).is_relative_to(installed) for path in found)
    assert {"s_curve_120kmh", "sedan", "pump_controlled", "cascade"} <= {Path(path).stem for path in found}
