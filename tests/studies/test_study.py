"""A study: every shipped cycle keeps what it expects, as `ars check` holds it, and a run that fails costs no other."""

import json

import pytest

from ars_mujoco.metrics.expectation import check
from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError, SimulationError
from ars_mujoco.studies.inputs import read_compared
from ars_mujoco.studies.study import study

SHORT = ["duration=0.3 s", "manoeuvre.acceleration.knots=[[0 s, 0 m/s^2], [0.1 s, 8 m/s^2]]"]
GOOD = "def command(sensors, memory):\n    return 0.01, 0.01\n"
BAD = """
def command(sensors, memory):
    if sensors.time > 0.0995:
        raise ValueError(1)
    return 0.01, 0.01
"""
WHOLE = ["run.parquet", "run.rrd", "summary.json"]


def nobody(name, share):
    """Nobody looks at the progress."""


def push(actuators, out, law=None, *settings, progress=nobody):
    """Study a short push of the roll plane."""
    controller = None
    if law:
        controller = out.parent / "law.py"
        controller.write_text(law)
    compared = read_compared("roll_plane_step", actuators, controller and str(controller), settings=[*SHORT, *settings])
    return study(*compared, out, progress)


def files(folder):
    return sorted(path.name for path in folder.iterdir())


def told(folder, metric):
    return json.loads((folder / "summary.json").read_text())["metrics"][metric]


@pytest.mark.parametrize("cycle", library.shipped("cycle"))
def test_a_shipped_cycle_keeps_its_expectations(cycle):
    runs, references = read_compared(cycle, [None])
    (result,) = study(runs, references, None, nobody)
    assert not check(runs[0].cycle.value.expect, result.metrics)


def test_each_run_is_measured_against_the_others_and_written(tmp_path):
    passive, active = push(["passive", "pump_controlled"], tmp_path / "out")
    assert files(tmp_path / "out") == ["compare.rrd", "passive", "pump_controlled"]
    assert files(tmp_path / "out" / "passive") == files(tmp_path / "out" / "pump_controlled") == WHOLE
    assert passive.metrics["roll_reduction_factor"].value is None
    assert active.metrics["roll_reduction_factor"].value > 1
    assert active.metrics["roll_reduction_factor_against_locked"].value > 1


def test_files_of_the_same_name_are_told_apart_and_measured_against_what_is_meant(tmp_path):
    own = tmp_path / "passive.yaml"
    own.write_text("kind: none\n")
    without, passive = push([str(own), "passive"], tmp_path / "out")
    assert (without.name, passive.name) == ("passive", "passive-2")
    assert files(tmp_path / "out") == ["compare.rrd", "passive", "passive-2"]
    assert without.metrics["roll_reduction_factor"].value < 1
    assert passive.metrics["roll_reduction_factor"].note == "no reference run to compare with"


@pytest.mark.parametrize("actuators", [["passive", "pump_controlled"], ["pump_controlled", "passive"]])
def test_a_run_that_fails_leaves_the_others_complete(tmp_path, actuators):
    out = tmp_path / "out"
    with pytest.raises(SimulationError, match=r"^pump_controlled: .*law\.py: the controller failed at 0\.1 s"):
        push(actuators, out, BAD)
    assert files(out) == ["passive", "pump_controlled"]
    assert files(out / "passive") == WHOLE
    assert files(out / "pump_controlled") == ["run.rrd.part"]
    assert "value" in told(out / "passive", "peak_roll")


def test_a_factor_against_a_run_that_failed_says_so(tmp_path):
    out = tmp_path / "out"
    (passive,) = push(["passive"], out, BAD, "reference=pump_controlled")
    factor = told(out / "passive", "roll_reduction_factor")
    assert factor["value"] is None
    assert factor["reason"].startswith("no reference run to compare with; pump_controlled: ")
    assert "the controller failed at 0.1 s" in factor["reason"]
    assert passive.metrics["roll_reduction_factor_against_locked"].value < 1


def test_a_run_is_whole_before_the_next_begins(tmp_path):
    seen = {}

    def look(name, share):
        if share:
            seen.setdefault(name, sorted(path.parent.name for path in tmp_path.glob("out/*/summary.json")))

    push(["none", "passive", "pump_controlled"], tmp_path / "out", progress=look)
    assert seen == {"passive": [], "locked": [], "none": ["passive"], "pump_controlled": ["none", "passive"]}


def test_an_interrupted_study_keeps_what_was_finished_and_what_was_simulated(tmp_path):
    def interrupt(name, share):
        if share and name == "pump_controlled":
            raise KeyboardInterrupt

    out = tmp_path / "out"
    with pytest.raises(KeyboardInterrupt):
        push(["passive", "pump_controlled"], out, progress=interrupt)
    assert files(out / "passive") == WHOLE
    assert files(out / "pump_controlled") == ["run.rrd.part"]


def test_a_comparison_of_earlier_runs_does_not_outlive_them(tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "compare.rrd").write_text("old")
    with pytest.raises(SimulationError):
        push(["passive", "pump_controlled"], out, BAD)
    assert not (out / "compare.rrd").exists()


def test_what_cannot_be_set_up_is_told_before_anything_is_written(tmp_path):
    with pytest.raises(InputError, match="has no function command"):
        push(["passive", "pump_controlled"], tmp_path / "out", "command = 3")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("place", ["file/out", "file"])
def test_a_folder_that_cannot_be_made_is_told_before_anything_is_simulated(tmp_path, place):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written to: Not a directory"):
        push(["passive"], tmp_path / place, progress=pytest.fail)
    assert files(tmp_path) == ["file"]


def test_a_law_has_no_target_to_miss(tmp_path):
    (law,) = push(["pump_controlled"], tmp_path / "out", GOOD)
    (cascade,) = push(["pump_controlled"], tmp_path / "out")
    assert law.metrics["target_map_error"].note == "the bar follows no target"
    assert cascade.metrics["target_map_error"].note != "the bar follows no target"
