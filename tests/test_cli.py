"""The command line: what it prints, what it writes, and how it refuses."""

import json
import math
import subprocess
import sys
from itertools import product

import pyarrow.parquet as pq
import pytest
import yaml
from typer.testing import CliRunner

from ars_mujoco.cli import app as cli
from ars_mujoco.schema import library

BENCH_CYCLE = """\
title: A small step
description: One degree on the bench.
rig: bench
duration: 50 ms
manoeuvre:
  kind: bar_command
  command: {join: step, knots: [[0 s, 1 deg]]}
expect:
  energy_audit_error: "<= 0.1 %"
"""


@pytest.fixture
def ars(monkeypatch, capsys, tmp_path):
    """Run `ars` in an empty folder with a small cycle in it; returns (exit status, stdout, stderr)."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "small.yaml").write_text(BENCH_CYCLE)

    def call(*arguments):
        monkeypatch.setattr(sys, "argv", ["ars", *arguments])
        with pytest.raises(SystemExit) as leaving:
            cli.main()
        out, err = capsys.readouterr()
        if isinstance(leaving.value.code, str):  # what Python prints on stderr as it leaves with status 1
            return 1, out, err + leaving.value.code
        return leaving.value.code or 0, out, err

    return call


def test_list_shows_what_is_shipped(ars):
    status, out, _ = ars("list")
    assert status == 0
    assert all(name in out for name in ("s_curve_120kmh", "pump_controlled", "sedan", "cascade"))


def test_list_is_machine_readable(ars):
    status, out, _ = ars("list", "cycles", "--json")
    assert status == 0
    assert {"name": "s_curve_120kmh", "description": "S-curve at 120 km/h"} in json.loads(out)["cycles"]


def test_every_listed_channel_has_a_unit_and_a_description(ars):
    channels = json.loads(ars("list", "channels", "--json")[1])["channels"]
    assert {"body.roll", "front.bar.angle", "fl.tire.vertical_force"} <= {each["name"] for each in channels}
    assert all(each["unit"] and each["description"] for each in channels)


def test_the_sensors_of_a_controller_in_python_are_listed_with_unit_and_meaning(ars):
    from ars_mujoco.control.sensors import SENSORS

    sensors = json.loads(ars("list", "sensors", "--json")[1])["sensors"]
    assert [each["name"] for each in sensors] == list(SENSORS.names)
    assert all(each["unit"] and each["description"] for each in sensors)


@pytest.mark.parametrize("kept", ["", "    str(sensors)\n"])
def test_what_a_controller_prints_stands_beside_the_results(ars, tmp_path, kept):
    """While it is loaded and while it runs, whether or not it would compile."""
    command = f"def command(sensors, memory):\n{kept}    print('sample', sensors.time)\n    return 0.0, 0.0\n"
    (tmp_path / "law.py").write_text(f"print('loaded')\n{command}")
    arguments = ("run", "roll_plane_step", "--controller", "law.py", "--set", "duration=2 ms", "--json")
    status, out, err = ars(*arguments)
    assert status == 0
    assert "runs" in json.loads(out)
    assert "loaded" in err and "sample 0.0" in err and "sample 0.001" in err


def test_listing_does_not_load_what_it_does_not_need():
    loaded = "import sys; from ars_mujoco.cli import app as cli; cli._shipped(cli.Listing.CYCLES); print(*sys.modules)"
    modules = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numba", "mujoco", "rerun", "pint", "pyarrow"} & set(modules)


def test_a_run_writes_its_folder(ars, tmp_path):
    status, out, _ = ars("run", "small.yaml", "--out", "here")
    assert status == 0
    assert "energy_audit_error" in out
    folder = tmp_path / "here" / "verification"
    assert sorted(path.name for path in folder.iterdir()) == ["run.parquet", "run.rrd", "summary.json"]
    schema = pq.read_schema(folder / "run.parquet")
    assert schema.names[0] == "time"
    assert schema.field("front.bar.angle").metadata[b"unit"] == b"rad"


def test_the_same_command_twice_gives_the_same_columns(ars, tmp_path):
    for out in ("once", "twice"):
        assert ars("run", "small.yaml", "--out", out)[0] == 0
    once, twice = (pq.read_table(tmp_path / out / "verification" / "run.parquet") for out in ("once", "twice"))
    assert once.equals(twice)


def test_a_run_is_machine_readable(ars):
    status, out, _ = ars("run", "small.yaml", "--set", "actuator.front.pump.speed=1500 rpm", "--json")
    result = json.loads(out)
    assert status == 0
    assert result["folder"] == "runs/small"
    inputs = result["runs"]["verification"]["inputs"]
    assert inputs["actuator"]["overrides"] == ["--set actuator.front.pump.speed=1500 rpm"]
    assert inputs["actuator"]["values"]["front"]["pump"]["speed"] == pytest.approx(157.0796)


def test_check_passes_a_cycle_that_keeps_its_limits(ars):
    status, out, _ = ars("check", "small.yaml")
    assert (status, out) == (0, "pass  small\n")


def test_check_fails_a_cycle_that_does_not(ars, tmp_path):
    (tmp_path / "strict.yaml").write_text(BENCH_CYCLE.replace("<= 0.1 %", ">= 10 %"))
    status, out, _ = ars("check", "strict.yaml", "--json")
    verdict = json.loads(out)["strict"]
    assert (status, verdict["passed"], len(verdict["failures"])) == (1, False, 1)


def losses_csv(path):
    """Points of a pump of 1.8 cm^3 that loses 3 % of its flow and 5 % of its torque at 6000 rpm and 200 bar."""
    lines = ["speed (rpm),pressure (bar),displacement (cm^3/rev),flow (L/min),torque (Nm)"]
    for speed, pressure, stroke in product((1000, 3000, 6000), (0, 100, 200), (0.0, 0.5, 1.0)):
        flow = 1.8e-3 * (stroke * speed - 6000 * 0.03 * pressure / 200)
        torque = 0.18 / (2 * math.pi) * (stroke * pressure + 200 * 0.05)
        lines.append(f"{speed},{pressure},{1.8 * stroke},{flow!r},{torque!r}")
    path.write_text("\n".join(lines))


def test_fitted_losses_are_a_block_that_a_run_accepts(ars, tmp_path):
    losses_csv(tmp_path / "pump.csv")
    status, out, _ = ars("fit-losses", "pump.csv", "--orders", "1", "1", "1")
    assert status == 0
    assert "R^2" in out and "k_001" in out
    folder = tmp_path / "runs" / "fit_losses"
    names = ["fit_losses.json", "fit_losses.png", "fit_losses.svg", "losses.yaml"]
    assert sorted(path.name for path in folder.iterdir()) == names
    actuator = yaml.load(library.shipped("actuator")["pump_controlled"].read_text(), yaml.BaseLoader)
    actuator["front"]["pump"] |= yaml.load((folder / "losses.yaml").read_text(), yaml.BaseLoader)
    (tmp_path / "fitted.yaml").write_text(yaml.safe_dump(actuator))
    status, out, _ = ars("run", "small.yaml", "--actuator", "fitted.yaml", "--json")
    assert status == 0
    (run,) = json.loads(out)["runs"].values()
    assert run["metrics"]["energy_audit_error"]["value"] < 1e-3
    assert run["inputs"]["actuator"]["values"]["front"]["pump"]["flow_loss"]["coefficients"]["k_001"] == (
        pytest.approx(0.03)
    )


def test_a_fit_is_machine_readable(ars, tmp_path):
    losses_csv(tmp_path / "pump.csv")
    status, out, _ = ars("fit-losses", "pump.csv", "--orders", "0", "0", "1", "--out", "here", "--json")
    result = json.loads(out)
    assert (status, result["folder"], result["points"], result["orders"]) == (0, "here", 27, [0, 0, 1])
    assert result["flow_loss"]["coefficients"]["k_001"] == pytest.approx(0.03)
    assert result["torque_loss"]["coefficients"]["k_000"] == pytest.approx(0.05)


def test_a_run_that_leaves_the_range_of_its_losses_says_so(ars):
    narrow = "actuator.front.pump.torque_loss.validity.pressure=[0 bar, 5 bar]"
    status, out, _ = ars("run", "small.yaml", "--set", narrow)
    assert status == 0
    assert "loss_extrapolation: the losses of the front pump are extrapolated from 0.0" in out
    status, out, _ = ars("run", "small.yaml", "--set", narrow, "--json")
    (run,) = json.loads(out)["runs"].values()
    assert run["metrics"]["loss_extrapolation"]["value"] > 0.0
    assert "the front pump leaves the range of its losses" in [event["text"] for event in run["events"]]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["fit-losses", "none.csv", "--orders", "1", "1", "1"], "none.csv: cannot be read: "),
        (["run", "smal.yaml"], "no cycle 'smal.yaml'; did you mean 'small.yaml'?"),
        (
            ["run", "small.yaml", "--set", "duraton=3 s"],
            "--set duraton=3 s: duraton: unknown key; did you mean 'duration'?",
        ),
        (
            ["run", "small.yaml", "--set", "duration=3"],
            "--set duration=3: duration: '3': needs a unit: s, ms, min or h",
        ),
        (
            ["run", "small.yaml", "--set", "duration=nan s"],
            "--set duration=nan s: duration: 'nan s': not a finite number",
        ),
        (
            ["run", "small.yaml", "--vehicle", "sedan"],
            "vehicle 'sedan' is of another rig than the cycle's, bench; allowed: bench, robot_joint",
        ),
        (["run", "small.yaml", "--actuator", "passive"], "actuator 'passive' has nothing to command on the bench"),
        (
            ["compare", "small.yaml", "--actuators", "pump_controlled,pump_controlled"],
            "actuators pump_controlled, pump_",
        ),
        (["check", "small"], "no cycle 'small'"),
        (["run", "x.**"], "no cycle 'x.**'; shipped: "),
        (
            ["run", "small.yaml", "--out", "small.yaml/out"],
            "small.yaml/out/verification: cannot be written to: Not a directory",
        ),
        (
            ["run", "roll_plane_step", "--set", "vehicle.mass=1e300 kg"],
            "vehicle 'roll_plane': its statics cannot be computed: Singular matrix",
        ),
        (
            ["run", "small.yaml", "--actuator", "passive", "--set", "actuator=locked"],
            "--set actuator=locked: the actuator is also named as 'passive'; name one of them",
        ),
        (
            ["compare", "small.yaml", "--actuators", "passive,locked", "--set", "actuator=none"],
            "--set actuator=none: the actuator is also named as 'passive'; name one of them",
        ),
        (["view", "nowhere"], "no recording 'nowhere'; allowed: an .rrd file, or the folder of a run or a comparison"),
    ],
)
def test_bad_input_is_one_clear_line_and_leaves_no_result(ars, tmp_path, arguments, error):
    status, out, err = ars(*arguments)
    assert (status, out) == (1, "")
    assert err.startswith("error: " + error)
    assert "\n" not in err.strip()
    assert not list(tmp_path.rglob("run.*"))


def test_what_warns_is_one_line_and_only_once(ars, tmp_path):
    law = "import warnings\nfor _ in range(3):\n    warnings.warn('of two\\n  lines', stacklevel=_ + 1)\ncommand = 3\n"
    (tmp_path / "law.py").write_text(law)
    status, out, err = ars("run", "roll_plane_step", "--controller", "law.py")
    assert (status, out) == (1, "")
    assert err == "warning: of two lines\nerror: law.py: has no function command(sensors, memory)"


def test_numpys_warnings_are_told_like_others(ars, tmp_path):
    law = "import numpy\nnumpy.log(numpy.zeros(1))\nnumpy.ones(1) / 0\ncommand = 3\n"
    (tmp_path / "law.py").write_text(law)
    _, _, err = ars("run", "roll_plane_step", "--controller", "law.py")
    assert err.splitlines()[:-1] == [f"warning: divide by zero encountered in {where}" for where in ("log", "divide")]


def test_cycles_of_the_same_name_each_get_a_verdict(ars, tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "small.yaml").write_text(BENCH_CYCLE.replace("<= 0.1 %", ">= 10 %"))
    status, out, _ = ars("check", "small.yaml", "other/small.yaml", "--json")
    assert status == 1
    assert {name: each["passed"] for name, each in json.loads(out).items()} == {"small": True, "small-2": False}


def test_a_wrong_option_is_a_usage_error(ars):
    status, _, err = ars("run", "small.yaml", "--actuatr", "passive")
    assert status == 2
    assert "No such option" in err


def test_list_loads_nothing_that_a_simulation_needs():
    heavy = "{'mujoco', 'numba', 'numpy', 'pint', 'pyarrow', 'rerun', 'scipy'}"
    program = "import sys; from ars_mujoco.cli.app import app; app(['list'], standalone_mode=False)"
    program += f"; print({heavy} & set(sys.modules))"
    out = subprocess.run([sys.executable, "-c", program], capture_output=True, check=True, text=True).stdout
    assert "s_curve_120kmh" in out
    assert out.splitlines()[-1] == "set()"


def test_check_reports_a_cycle_that_diverges_and_goes_on(monkeypatch):
    from ars_mujoco.schema.errors import SimulationError
    from ars_mujoco.studies import study as studies

    real = studies.study

    def diverge(runs, *rest):
        if runs[0].cycle.name == "bench_step_1deg":
            raise SimulationError("the run diverged at 0.100 s", 0.1, "front.bar.angle")
        return real(runs, *rest)

    monkeypatch.setattr(studies, "study", diverge)
    result = CliRunner().invoke(cli.app, ["check", "bench_step_1deg", "bench_step_10deg"])
    assert result.exit_code == 1
    assert "FAIL  bench_step_1deg\n      the run diverged at 0.100 s" in result.output
    assert "pass  bench_step_10deg" in result.output
