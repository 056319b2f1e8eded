"""The command `ars analyze`."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ars_mujoco.analysis import compensators, frequency_response, hydraulic_poles, margins, stable_region
from ars_mujoco.analysis.analyze import ANALYSES, left_out, read_analyzed
from ars_mujoco.analysis.loop import loop_of
from ars_mujoco.analysis.parameter_box import TABLE_2, grid
from ars_mujoco.cli import app as cli
from ars_mujoco.schema.errors import InputError


@pytest.fixture
def analyze(monkeypatch, tmp_path):
    """Run `ars analyze` in an empty folder; returns stdout."""
    monkeypatch.chdir(tmp_path)
    return lambda *arguments: CliRunner().invoke(cli.app, ["analyze", *arguments], catch_exceptions=False).stdout


def test_it_writes_numbers_and_figures_of_every_analysis(analyze, monkeypatch, tmp_path):
    monkeypatch.setattr(frequency_response, "FREQUENCIES", frequency_response.FREQUENCIES[10::10])
    monkeypatch.setattr(compensators, "CORNERS", compensators.CORNERS[::4])
    printed = json.loads(analyze("--set", "actuator.control.loop.gain=30 1/rad", "--json"))
    folder = tmp_path / printed["folder"]
    assert {path.name for path in folder.iterdir()} == {
        f"{name}.{kind}" for name in printed["analyses"] for kind in ("json", "png", "svg")
    }
    assert printed["analyses"].keys() | printed["left_out"].keys() == ANALYSES.keys()
    assert printed["left_out"].keys() == {"line_inertance"}
    for name in printed["analyses"]:
        numbers = json.loads((folder / f"{name}.json").read_text())
        assert numbers == printed["analyses"][name]
        assert numbers["units"]
        assert numbers["inputs"]["actuator"]["overrides"] == ["--set actuator.control.loop.gain=30 1/rad"]
    assert printed["analyses"]["margins"]["gain"]["value"] == 30.0


def test_it_prints_a_short_table(analyze, monkeypatch):
    monkeypatch.setattr("ars_mujoco.analysis.analyze.ANALYSES", {"stable_region": ANALYSES["stable_region"]})
    out = analyze("--out", "here")
    assert "under 95.8 1/rad" in out
    assert "Figures and numbers: here" in out


@pytest.mark.slow
def test_of_a_full_circuit_it_says_what_it_leaves_out(analyze, monkeypatch):
    names = "stable_region", "hydraulic_poles", "line_inertance", "steady_state"
    monkeypatch.setattr("ars_mujoco.analysis.analyze.ANALYSES", {name: ANALYSES[name] for name in names})
    out = analyze("--actuator", "pump_controlled_full", "--axle", "rear", "--out", "here")
    assert "189 without the oil's mass, 105 with it 1/rad" in out
    assert "Left out: hydraulic_poles, stable_region: Table 2's C_H is no parameter of a full circuit" in out
    numbers = json.loads(Path("here/line_inertance.json").read_text())
    assert numbers["inputs"]["axle"] == "rear"
    assert numbers["own_length"] == pytest.approx(5.98)


def test_the_rear_s_line_is_softer_than_the_front_s():
    inputs = read_analyzed(None, None, [])
    front, rear = (hydraulic_poles.compute(loop_of(inputs, axle))["own"] for axle in ("front", "rear"))
    assert front["frequency"] == pytest.approx(814, abs=1)
    assert rear["frequency"] == pytest.approx(637, abs=1)


@pytest.mark.parametrize("stage", ["reduced", "full"])
def test_every_stage_of_pump_control_before_the_reduced_plant_has_nearly_the_same_region(stage):
    regions = []
    for settings in ([], [f"actuator.pump_control={stage}"]):
        loop = loop_of(read_analyzed(None, None, settings))
        regions.append(min(stable_region.critical_gain(loop.at(point)) for point in grid(tuple(TABLE_2))))
    assert regions[1] == pytest.approx(regions[0], rel=0.01)


def test_pump_control_without_its_cylinder_is_left_out():
    circuit = {"oil": None, "metering_edge": None, "control_cylinder": None}
    inputs = read_analyzed(None, None, [])
    plain = inputs.actuator.value.model_copy(update={"front": inputs.actuator.value.front.model_copy(update=circuit)})
    loop = loop_of(replace(inputs, actuator=replace(inputs.actuator, value=plain)))
    assert "pump_control_stages" in left_out(loop)


def test_twice_the_speed_with_half_the_gain_has_the_same_margins():
    nominal, fast = (
        margins.compute(loop_of(read_analyzed(None, None, settings)))["rows"][0]
        for settings in ([], ["actuator.control.loop.gain=30 1/rad", "actuator.front.pump.speed=6000 rpm"])
    )
    assert fast["gain_margin"] == pytest.approx(nominal["gain_margin"], rel=1e-6)


def test_the_controller_s_own_timing_is_among_the_margins():
    loop = loop_of(read_analyzed(None, "cascade", ["controller.unit.delay=7 ms"]))
    last = margins.compute(loop)["rows"][-1]
    assert (last["sample_time"], last["delay"]) == (1e-3, 7e-3)


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["--actuator", "passive"], "actuator 'passive' has no loop to analyse; allowed: pump_controlled"),
        (["--set", "duration=3 s"], "--set duration=3 s: an analysis drives no cycle; allowed: actuator.KEY"),
    ],
)
def test_what_cannot_be_analysed_is_refused_in_one_line(analyze, arguments, error):
    with pytest.raises(InputError, match=error):
        analyze(*arguments)


def test_a_missing_package_is_named_with_the_extra_that_brings_it(analyze, monkeypatch):
    for name in [each for each in sys.modules if each.startswith("ars_mujoco.analysis")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr("ars_mujoco.analysis")
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(InputError, match=r"'control'.*ars_mujoco\[analysis\]"):
        analyze()
