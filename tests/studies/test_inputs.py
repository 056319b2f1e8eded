"""Inputs: which file a name stands for, where a path starts, and what cannot be asked for together."""

import hashlib
from types import SimpleNamespace

import pytest

from ars_mujoco.recording.recording import Recording
from ars_mujoco.recording.summary import summary
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_compared, read_inputs
from ars_mujoco.studies.study import told_apart

CYCLE = """\
title: A push
description: A lateral force on the roll plane.
rig: roll_plane
duration: 0.1 s
actuator: mine.yaml
reference: their.yaml
manoeuvre:
  kind: lateral_force
  acceleration: {join: step, knots: [[0 s, 8 m/s^2]]}
"""
LAW = "def command(sensors, memory):\n    return 0.01, 0.01\n"


@pytest.fixture
def desk(tmp_path, monkeypatch):
    """A folder `cycles` with a cycle and its actuators, and a working directory beside it that holds a law."""
    cycles, here = tmp_path / "cycles", tmp_path / "here"
    cycles.mkdir(), here.mkdir()
    (cycles / "push.yaml").write_text(CYCLE)
    (cycles / "mine.yaml").write_text("kind: locked\n")
    (cycles / "their.yaml").write_text("kind: none\n")
    (here / "law.py").write_text(LAW)
    monkeypatch.chdir(here)
    return SimpleNamespace(cycles=cycles, here=here, cycle=str(cycles / "push.yaml"))


def problem(*arguments, **options):
    with pytest.raises(InputError) as error:
        read_compared(*arguments, **options)
    (line,) = error.value.problems
    return line


# ---- what a run is measured against


def test_what_a_cycle_names_starts_at_the_cycles_folder(desk):
    (run,), references = read_compared(desk.cycle, [None])
    assert run.actuator.path.samefile(desk.cycles / "mine.yaml")
    assert references["reference"].actuator.path.samefile(desk.cycles / "their.yaml")


def test_what_the_command_line_names_starts_at_the_working_directory(desk):
    (desk.here / "other.yaml").write_text("kind: none\n")
    (run,), references = read_compared(
        desk.cycle, [None], settings=["actuator=other.yaml", "reference=other.yaml", "controller.law=law.py"]
    )
    assert run.actuator.path.samefile(desk.here / "other.yaml")
    assert references["reference"] is run


@pytest.mark.parametrize(("role", "name"), [("locked", "locked"), ("reference", "passive")])
def test_an_own_file_named_like_a_shipped_one_does_not_take_its_place(desk, role, name):
    (desk.here / f"{name}.yaml").write_text("kind: none\n")
    (run,), references = read_compared(desk.cycle, [f"{name}.yaml"], settings=["reference=passive"])
    assert run.actuator.value.kind == "none"
    assert references[role].actuator.value.kind == name


def test_a_run_that_others_are_measured_against_is_read_once(desk):
    (passive, locked, _), references = read_compared(
        desk.cycle, ["passive", "locked", "pump_controlled"], settings=["reference=passive"]
    )
    assert references == {"reference": passive, "locked": locked}


def test_the_bench_has_nothing_to_be_measured_against():
    assert read_compared("bench_step_1deg", [None])[1] == {}


def test_an_actuator_cannot_be_there_twice(desk):
    (desk.here / "mine.yaml").symlink_to(desk.cycles / "mine.yaml")
    assert problem(desk.cycle, [None, "mine.yaml"]) == "actuators mine, mine: each can be there only once"


def test_names_are_told_apart_by_a_number():
    assert told_apart(["bar", "other", "bar", "bar"]) == ["bar", "other", "bar-2", "bar-3"]


def test_a_setting_of_the_actuator_leaves_the_bar_it_is_compared_with_alone():
    speed = "actuator.front.pump.speed=1500 rpm"
    (passive, active), references = read_compared("s_curve_120kmh", ["passive", "pump_controlled"], settings=[speed])
    assert passive.actuator.overrides == ()
    assert active.actuator.overrides == (f"--set {speed}",)
    assert references["reference"] is passive


# ---- a law


def recorded(law, **options):
    return read_inputs("roll_plane_step", controller=str(law), **options).record()


def hash_of(inputs):
    return summary(Recording("", {}, inputs=inputs, time=[]))["inputs_sha256"]


def test_a_law_is_recorded_with_its_path_and_hash(desk):
    law = {"path": "law.py", "sha256": hashlib.sha256(LAW.encode()).hexdigest()}
    assert recorded("law.py")["controller"]["law"] == law
    by_setting = read_inputs("roll_plane_step", settings=["controller.law=law.py"])
    assert by_setting.record()["controller"]["law"] == law
    assert by_setting.controller.value.law == "law.py"


@pytest.mark.parametrize("named_in", ["the option", "a controller's file"])
def test_two_laws_give_two_hashes(desk, named_in):
    controller = desk.here / "law.py"
    if named_in == "a controller's file":
        controller = desk.here / "mine.yaml"
        controller.write_text(read_inputs("roll_plane_step").controller.path.read_text() + "law: law.py\n")
    once = recorded(controller)
    assert hash_of(recorded(controller)) == hash_of(once)
    (desk.here / "law.py").write_text(LAW.replace("0.01", "0.02"))
    assert hash_of(recorded(controller)) != hash_of(once)


@pytest.mark.parametrize("actuator", ["passive", "locked", "none"])
def test_a_bar_that_takes_no_command_runs_without_the_law(desk, actuator):
    plain = read_inputs("roll_plane_step", actuator, "law.py")
    assert (plain.law, plain.controller.value.law) == (None, None)
    assert "law" not in plain.record()["controller"]


def test_a_law_in_a_file_that_is_not_there_is_refused_even_where_it_would_not_run(desk):
    settings = ["controller.law=lost.py"]
    expected = "no law 'lost.py'; a law is a Python file, *.py"
    assert problem("roll_plane_step", ["passive"], settings=settings) == expected


# ---- what cannot be asked for together


@pytest.mark.parametrize("part", ["actuator", "controller", "vehicle"])
def test_a_part_is_named_once(desk, part):
    with pytest.raises(InputError) as error:
        read_inputs(desk.cycle, **{part: "this"}, settings=[f"{part}=that"])
    assert str(error.value) == f"--set {part}=that: the {part} is also named as 'this'; name one of them"


def test_what_is_compared_is_not_named_by_a_setting(desk):
    line = problem(desk.cycle, ["passive", "locked"], settings=["actuator=none"])
    assert line == "--set actuator=none: the actuator is also named as 'passive'; name one of them"


def test_a_kind_is_not_set_for_the_run_bears_the_files_name(desk):
    line = problem(desk.cycle, ["passive"], settings=["actuator.kind=locked"])
    assert line == "--set actuator.kind=locked: the kind is the file's; name another actuator instead"


@pytest.mark.parametrize(
    "key", ["target=[[0 g, 0 deg], [1 g, 0 deg]]", "trim.rate=1 1/s", "fade.begin=1 km/h", "front_share=0.5"]
)
def test_a_law_leaves_no_target_to_set(desk, key):
    setting = f"controller.reference.{key}"
    line = problem("roll_plane_step", [None], "law.py", settings=[setting])
    assert line.startswith(f"--set {setting}: the law 'law.py' takes the place of the target, its fade, its trim")


def test_the_accelerometer_that_a_law_reads_can_be_set(desk):
    inputs = read_inputs(
        "roll_plane_step", controller="law.py", settings=["controller.reference.accelerometer.cutoff=5 Hz"]
    )
    assert inputs.law and inputs.controller.overrides


def test_a_law_is_named_once(desk):
    line = problem("roll_plane_step", [None], "law.py", settings=["controller.law=other.py"])
    assert line == "--set controller.law=other.py: the controller 'law.py' is a law itself; name one of them"
