"""What the README shows is what runs."""

import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ars_mujoco.cli.app import app

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text()
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", README, re.DOTALL)
COMMANDS = [
    line.split("  #")[0].strip()
    for language, block in BLOCKS
    if language == "sh"
    for line in block.splitlines()
    if line.startswith("ars ")
]
(POINTS,) = [block for language, block in BLOCKS if language == "csv"]
LAW, SYSTEM, PROGRAM = [block for language, block in BLOCKS if language == "python"]
COMPENSATORS, SYSTEM_FILE = [block for language, block in BLOCKS if language == "yaml"]

LONG = ("ars analyze", "ars reproduce")  # whose parts tests/analysis and tests/reproduce run


@pytest.mark.parametrize(
    "command", [pytest.param(each, marks=pytest.mark.slow) if each in LONG else each for each in COMMANDS]
)
def test_every_command_of_the_readme_runs(command, tmp_path, monkeypatch):
    if command == "ars bench":
        pytest.skip("a benchmark is run by name: it wants an idle machine")
    monkeypatch.chdir(tmp_path)
    Path("my_controller.py").write_text(LAW)
    Path("servo.py").write_text(SYSTEM)
    Path("servo.yaml").write_text(SYSTEM_FILE)
    Path("pump.csv").write_text(POINTS)
    result = CliRunner().invoke(app, shlex.split(command)[1:])
    assert result.exit_code == 0, result.output


def test_its_long_commands_are_there():
    assert set(LONG) < set(COMMANDS)


def test_the_controller_of_the_readme_keeps_the_car_nearly_level(tmp_path):
    from ars_mujoco.simulation.simulation import simulate
    from ars_mujoco.studies.inputs import read_inputs
    from ars_mujoco.studies.study import simulation_of

    law = tmp_path / "my_controller.py"
    law.write_text(LAW)
    settings = ["duration=9 s"]
    own = simulate(simulation_of(read_inputs("s_curve_120kmh", controller=str(law), settings=settings)))
    passive = simulate(simulation_of(read_inputs("s_curve_120kmh", actuator="passive", settings=settings)))
    assert abs(own["body.roll"]).max() < 0.3 * abs(passive["body.roll"]).max()


def test_the_program_of_the_readme_runs(capsys):
    exec(compile(PROGRAM, "README.md", "exec"), {})
    time, roll = map(float, capsys.readouterr().out.split())
    assert time == pytest.approx(5.0)
    assert 0.015 < roll < 0.03


def test_the_inputs_of_the_bench_are_those_of_the_readme(tmp_path, monkeypatch):
    from ars_mujoco.studies.inputs import read_inputs

    forms = dict(re.findall(r"^\| (\w+) \| `(\{.*?\})`", README, re.MULTILINE))
    (header,) = re.findall(r"such as `(time.*?)`", README)
    monkeypatch.chdir(tmp_path)
    Path("travel.csv").write_text(f"{header}\n0,0\n1,20\n")
    assert list(forms) == ["step", "sine", "sweep", "recorded"]
    for form in forms.values():
        read_inputs("bench_ends_free", settings=[f"manoeuvre.ends={form}"])


def test_the_scripts_of_the_readme_exist_and_run_what_it_says():
    compare = "ars compare cycles/s_curve_120kmh.yaml --actuators passive,pump_controlled"
    assert compare in (ROOT / "scripts/run").read_text()
    assert "pytest" in (ROOT / "scripts/test").read_text()
    assert "scripts/test" in (ROOT / ".ci/run").read_text()


def test_the_picture_of_the_readme_is_there():
    (picture,) = re.findall(r"!\[.*?\]\((.*?)\)", README)
    assert (ROOT / picture).is_file()


def test_the_compensators_of_the_readme_are_accepted(tmp_path):
    from ars_mujoco.schema.library import shipped
    from ars_mujoco.studies.inputs import read_inputs

    mine, text = tmp_path / "mine.yaml", shipped("actuator")["pump_controlled"].read_text()
    mine.write_text(text.replace("control:  ", COMPENSATORS.join(["control:\n", "  #"]), 1))
    control = read_inputs("s_curve_120kmh", str(mine)).actuator.value.control
    assert control.pressure_feedback.gain == pytest.approx(0.072e-5)
    assert control.compensator.frequency == pytest.approx(834)


def test_the_system_of_the_readme_is_short_and_levels_the_car(tmp_path, monkeypatch):
    from ars_mujoco.studies.inputs import read_compared
    from ars_mujoco.studies.study import study

    assert len(SYSTEM.splitlines()) < 60
    monkeypatch.chdir(tmp_path)
    Path("servo.py").write_text(SYSTEM)
    Path("servo.yaml").write_text(SYSTEM_FILE)
    (result,) = study(*read_compared("s_curve_120kmh", ["servo.py"]), None, lambda name, share: None)
    assert result.metrics["roll_reduction_factor"].value > 7.0
    assert result.metrics["energy_audit_error"].value < 1e-3
    assert result.inputs.record()["actuator"]["system"]["path"] == "servo.py"
