"""Controllers in Python that broke runs, as they were met: each is refused with its reason, or gives what is right."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from ars_mujoco.cli import app as cli
from ars_mujoco.schema.errors import ArsError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

CASES = Path(__file__).parents[3] / "shared/cases"
REFUSED = {
    "args": "command() cannot be called as command(sensors, memory)",
    "raises": "the controller failed at 0.5 s: ValueError: sensor out of range (raises.py, line 3)",
    "index": "IndexError: index 32 is out of bounds for axis 0 with size 32 (index.py, line 3)",
    "none": "command() returned None; it must return two numbers",
    "nan": "the controller returned nan for the front bar's angle",
    "first_sample": "the controller returned inf for the front bar's angle",
    "inf": "for the front bar's angle at 0.99 s; allowed: up to 100 rad",
}

pytestmark = [
    pytest.mark.skipif(not CASES.is_dir(), reason="needs ../shared/cases beside the checkout"),
    pytest.mark.filterwarnings("ignore:.*does not compile"),
]


def drive(case, duration):
    inputs = read_inputs("step_steer_iso7401", controller=str(CASES / case), settings=[f"duration={duration} s"])
    return simulate(simulation_of(inputs))


@pytest.mark.filterwarnings("ignore:.*does it give degrees")
@pytest.mark.parametrize("name", REFUSED)
def test_a_fault_is_told_with_its_reason(name):
    with pytest.raises(ArsError) as error:
        drive(f"law_faults/{name}.py", 1.1)
    assert str(error.value).startswith(f"{CASES / 'law_faults' / name}.py: ")
    assert REFUSED[name] in str(error.value)


def test_degrees_for_radians_get_a_remark():
    with pytest.warns(UserWarning, match="what it returns is in rad: does it give degrees"):
        recording = drive("law_faults/degrees.py", 1.5)
    assert np.degrees(np.abs(recording["front.bar.command"]).max()) == pytest.approx(14.46)


def test_state_of_its_own_gives_what_memory_gives():
    kept, own = (drive(f"stateful_law/{name}.py", 4.0) for name in ("stateful_memory", "stateful"))
    np.testing.assert_array_equal(own.values, kept.values)
    assert np.degrees(np.abs(own["body.roll"]).max()) == pytest.approx(0.787, abs=0.001)


@pytest.mark.parametrize("name", ["prints", "prints_top"])
def test_prints_leave_the_results_one_json_document(name, tmp_path):
    law = str(CASES / "law_prints" / f"{name}.py")
    arguments = ["run", "step_steer_iso7401", "--controller", law, "--set", "duration=1.1 s", "--json"]
    result = CliRunner().invoke(cli.app, [*arguments, "--out", str(tmp_path)])
    assert json.loads(result.stdout)["runs"]
    assert "first sample at 0.0" in result.stderr or "controller loaded" in result.stderr
