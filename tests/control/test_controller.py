"""A controller's file: a target that makes no map is refused, the shipped ones are read as written."""

import math

import pytest

from ars_mujoco.control.controller import Controller
from ars_mujoco.control.target import target_roll
from ars_mujoco.schema import library
from ars_mujoco.schema.document import override, read
from ars_mujoco.schema.errors import InputError

G = 9.80665


def controller(target: str) -> Controller:
    return read(Controller, "cascade", "controller", [override(f"reference.target={target}")]).value


def problem(target: str) -> str:
    with pytest.raises(InputError) as error:
        controller(target)
    (line,) = error.value.problems
    start = f"--set reference.target={target}: reference.target: "
    assert line.startswith(start)
    return line[len(start) :]


def knots(count: int) -> str:
    return "[" + ", ".join(f"[{0.04 * i:.2f} g, {0.01 * i:.2f} deg]" for i in range(count)) + "]"


@pytest.mark.parametrize("name", library.shipped("controller"))
def test_a_shipped_controller_is_read(name):
    read(Controller, name, "controller")


@pytest.mark.parametrize("key", ["loop", "pressure_feedback", "compensator"])
def test_a_controller_of_before_is_told_where_the_pumps_loops_went(key, tmp_path):
    told = (
        f"{key}: has moved: an actuator has its own loops; in its file, control.{key}, or --set actuator.control.{key}"
    )
    setting = f"{key}.gain=42 1/rad"
    with pytest.raises(InputError) as error:
        read(Controller, "cascade", "controller", [override(setting)])
    assert error.value.problems == (f"--set {setting}: {told}",)
    mine = tmp_path / "mine.yaml"
    mine.write_text(f"{library.shipped('controller')['cascade'].read_text()}{key}:\n  gain: 42 1/rad\n")
    with pytest.raises(InputError) as error:
        read(Controller, str(mine), "controller")
    (line,) = error.value.problems
    assert line.startswith(f"{mine}:") and line.endswith(told)


@pytest.mark.parametrize("count", [2, 23])
def test_a_target_has_2_to_23_knots(count):
    assert len(controller(knots(count)).reference.target) == count


@pytest.mark.parametrize("count", [1, 24, 30])
def test_a_target_of_fewer_or_more_knots_is_refused(count):
    assert problem(knots(count)) == f"a target has 2 to 23 knots, not {count}"


def test_an_empty_target_is_refused():
    assert problem("[]") == "a target has 2 to 23 knots, not 0"


@pytest.mark.parametrize("first", ["0.3 g, 0 deg", "0 g, 0.5 deg"])
def test_a_target_starts_level_and_straight_ahead(first):
    assert problem(f"[[{first}], [0.6 g, 0.3 deg]]").startswith("a target starts at [0 g, 0 deg]")


@pytest.mark.parametrize("second", ["0.8 g", "0.6 g"])
def test_the_lateral_accelerations_of_a_target_rise(second):
    line = problem(f"[[0 g, 0 deg], [{second}, 1.3 deg], [0.6 g, 0.3 deg]]")
    before = {"0.8 g": "7.84532", "0.6 g": "5.88399"}[second]
    assert line == f"lateral accelerations of a target must rise: 5.88399 m/s^2 comes after {before} m/s^2"


def test_all_that_is_wrong_with_a_target_is_told_at_once():
    assert problem("[[0.3 g, 0 deg], [0.3 g, 0 deg]]").count(";") == 1


@pytest.mark.parametrize(
    ("g", "degrees"), [(0.0, 0.0), (0.3, 0.0), (0.45, 0.15), (0.6, 0.3), (0.7, 0.8), (0.8, 1.3), (1.0, 2.3)]
)
def test_a_target_is_linear_between_its_knots_and_goes_on_beyond_them(g, degrees):
    target = read(Controller, "cascade", "controller").value.reference.target
    assert math.degrees(target_roll(target, g * G)) == pytest.approx(degrees, abs=1e-12)
