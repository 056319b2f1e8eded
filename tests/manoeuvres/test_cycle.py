"""Every shipped cycle is what its standard or its source says, and a cycle that makes no sense is refused."""

import numpy as np
import pytest
from shipped import recording

from ars_mujoco.actuators.registry import system_for
from ars_mujoco.excitation.knots import value
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.schema import library
from ars_mujoco.schema.document import override, read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs

G = 9.80665


def cycle(name, *settings):
    return read(Cycle, name, "cycle", [override(each) for each in settings]).value


def problem(name, *settings):
    with pytest.raises(InputError) as error:
        cycle(name, *settings)
    (line,) = error.value.problems
    return line


@pytest.mark.parametrize("name", library.shipped("cycle"))
def test_a_shipped_cycle_finds_all_its_parts(name):
    inputs = read_inputs(name)
    assert inputs.cycle.value.expect, "a cycle states what is expected of it"
    assert inputs.vehicle.path.parent.name == inputs.cycle.value.rig


def test_the_s_curve_is_the_bench_s_curve_scaled_but_for_its_peak():
    road, bench = cycle("s_curve_120kmh").manoeuvre.lateral_acceleration, cycle("bench_s_curve").manoeuvre.command
    road, bench = np.array(road.knots), np.array(bench.knots) * [1, 0.6 * G / np.radians(12)]
    is_peak = bench[:, 1] == bench[:, 1].max()
    assert road[~is_peak] == pytest.approx(bench[~is_peak])
    assert road[is_peak] == pytest.approx(bench[is_peak], rel=0.05)  # raised, for the car to reach 0.60 g


def test_the_bench_steps_are_commanded_from_the_start():
    for degrees in (1, 10):
        command = cycle(f"bench_step_{degrees}deg").manoeuvre.command.signal()
        assert value(command, 0.0) == pytest.approx(np.radians(degrees))


def test_the_steady_circle_raises_lateral_acceleration_slowly():
    circle = cycle("steady_circle_iso4138")
    time = np.linspace(0, circle.duration, 2000)
    speed = circle.speed_signal()
    acceleration = np.array([value(speed, t) ** 2 / circle.manoeuvre.radius for t in time])
    assert acceleration[[0, -1]] / G == pytest.approx([0.05, 0.85], abs=1e-3)
    assert np.gradient(acceleration, time).max() < 0.14  # m/s^3; speed is linear between knots, 0.1 in the mean


def test_the_severe_step_rises_in_80_ms():
    force = cycle("roll_plane_step").manoeuvre.acceleration.signal()
    assert [value(force, t) for t in (0.5, 0.54, 0.58, 3.0)] == pytest.approx([0, 4, 8, 8])


def test_the_step_steer_ramp_is_as_short_as_iso_7401_asks():
    steer = cycle("step_steer_iso7401").manoeuvre
    assert steer.ramp <= 0.15
    assert steer.lateral_acceleration == pytest.approx(0.6 * G)


def test_a_bump_lies_under_the_wheels_of_one_side():
    bump = cycle("single_wheel_bump").road.bump
    assert (bump.side, bump.height, bump.length) == (1.0, 0.04, 1.0)


def test_the_bench_has_its_own_controller_by_default():
    assert cycle("bench_s_curve").controller == "verification"
    assert cycle("roll_plane_step").controller == "level"


def test_an_expectation_is_held_in_the_metrics_unit():
    (limit,) = cycle("bench_s_curve").expect["energy_audit_error"]
    assert (limit.relation, limit.bound) == ("<=", pytest.approx(0.001))


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("expect.peak_rol=>= 3 deg", "expect.peak_rol: '>= 3 deg': unknown metric; did you mean 'peak_roll'?"),
        ("expect.peak_roll=3 deg", "expect.peak_roll: '3 deg': not a limit"),
        ("expect.peak_roll=<= 3 bar", "expect.peak_roll: '<= 3 bar': wrong unit"),
        ("duration=0 s", "duration: '0 s': must be at least 0.001 s"),
        ("window=[5 s, 3 s]", "window: needs a start before its end"),
        ("window=[5 s, 25 s]", "window: needs a start before its end, both within the duration"),
        ("rig=trailer", "rig: 'trailer': unknown; allowed: bench, roll_plane, sedan"),
        ("speed=120", "speed: '120': needs a unit: m/s, km/h or mph"),
        ("manoeuvre.kind=folow", "manoeuvre.kind: 'folow': unknown; did you mean 'follow'?"),
        ("manoeuvre.lateral_acceleration.knots=[]", "manoeuvre.lateral_acceleration.knots: a signal has 1 to"),
        (
            "manoeuvre.lateral_acceleration.knots=[[1 s, 0 g], [0 s, 1 g]]",
            "manoeuvre.lateral_acceleration.knots: times of a signal must rise",
        ),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused(setting, expected):
    assert problem("s_curve_120kmh", setting).startswith(f"--set {setting}: {expected}")


@pytest.mark.parametrize("speed", ["0 km/h", "-50 km/h"])
def test_a_car_never_stands_nor_reverses(speed):
    held = f"speed={speed}"
    assert problem("s_curve_120kmh", held) == f"--set {held}: speed: '{speed}': must be greater than 0 km/h"
    changing = f"manoeuvre.speed.knots=[[0 s, 30 km/h], [5 s, {speed}]]"
    expected = f"--set {changing}: manoeuvre.speed.knots.1.1: '{speed}': must be greater than 0 km/h"
    assert problem("steady_circle_iso4138", changing) == expected
    with pytest.raises(InputError) as error:
        cycle("s_curve_120kmh", changing)
    assert expected in error.value.problems


def test_a_step_steer_turns():
    line = problem("step_steer_iso7401", "manoeuvre.lateral_acceleration=0 g")
    assert line.endswith("manoeuvre.lateral_acceleration: '0 g': must not be 0: positive turns left, negative right")
    assert cycle("step_steer_iso7401", "manoeuvre.lateral_acceleration=-0.5 g").manoeuvre.lateral_acceleration < 0


def test_a_manoeuvre_of_another_rig_is_refused():
    assert problem("bench_s_curve", "rig=sedan").endswith(
        "'bar_command' is a manoeuvre of the rig bench, not sedan; allowed: follow, circle, step_steer, straight"
    )


@pytest.mark.parametrize("name", ["steady_circle_iso4138", "bench_s_curve"])
def test_a_speed_is_stated_once_and_only_where_there_is_one(name):
    assert "speed" in problem(name, "speed=50 km/h")


def test_a_vehicle_of_another_rig_is_refused_in_one_line():
    with pytest.raises(InputError) as error:
        read_inputs("s_curve_120kmh", vehicle="bench")
    assert error.value.problems == (
        "vehicle 'bench' is of another rig than the cycle's, sedan; allowed: sedan, or a file",
    )


def test_settings_reach_through_a_name_into_its_file():
    inputs = read_inputs("s_curve_120kmh", settings=["actuator.front.pump.speed=1500 rpm", "duration=2 s"])
    assert inputs.actuator.value.front.pump.speed == pytest.approx(50 * np.pi)
    assert inputs.cycle.value.duration == 2.0


def test_the_problems_of_all_files_are_told_at_once():
    settings = ["actuator.front.pmp.speed=1 rpm", "vehicle.sprung.mass=-3 kg"]
    with pytest.raises(InputError) as error:
        read_inputs("s_curve_120kmh", controller="cascde", settings=settings)
    actuator, controller, vehicle = error.value.problems
    assert actuator.startswith(f"--set {settings[0]}: front.pmp: unknown key; did you mean 'pump'?")
    assert controller.startswith("no controller 'cascde'; did you mean 'cascade'?")
    assert vehicle == f"--set {settings[1]}: sprung.mass: '-3 kg': must be greater than 0 kg"


# ---- what an actuator takes besides its commands

OPEN = "{knots: [[0 s, 1]]}"


def inputs_problem(actuator, *settings):
    with pytest.raises(InputError) as error:
        read_inputs("s_curve_120kmh", actuator, settings=settings)
    (line,) = error.value.problems
    return line


def test_a_cycle_of_before_is_told_where_its_valves_went(tmp_path):
    setting = f"valves.front_bypass={OPEN}"
    assert problem("bench_fail_safe", setting) == f"--set {setting}: valves: has moved: inputs"
    old = tmp_path / "old.yaml"
    text = library.shipped("cycle")["bench_fail_safe"].read_text()
    old.write_text(text.replace("\ninputs:", "\nvalves:"))
    line = problem(str(old))
    assert line.startswith(f"{old}:") and line.endswith("valves: has moved: inputs")


@pytest.mark.parametrize("name", ["bench_fail_safe", "single_wheel_bump_decoupled"])
def test_a_shipped_cycle_commands_what_its_actuator_takes(name):
    inputs = read_inputs(name)
    assert inputs.cycle.value.inputs.model_fields_set <= set(system_for(inputs.actuator.value).INPUTS)
    assert inputs.cycle.value.inputs.model_fields_set


def test_an_input_that_is_not_commanded_rests(tmp_path):
    inputs = read_inputs("s_curve_120kmh", "pump_controlled_full", settings=[f"inputs.front_bypass={OPEN}"])
    held = {name: value(knots.signal(), 1.0) for name, knots in inputs.cycle.value.inputs}
    assert held == {"front_bypass": 1.0, "front_fail_safe": 1.0, "rear_bypass": 0.0, "rear_fail_safe": 1.0}


def test_inputs_are_those_of_the_actuator():
    setting = "inputs.front_bypas={knots: [[0 s, 1]]}"
    assert inputs_problem("pump_controlled_full", setting) == (
        f"--set {setting}: inputs.front_bypas: unknown key; did you mean 'front_bypass'?; "
        "allowed: front_bypass, front_fail_safe, rear_bypass, rear_fail_safe"
    )
    beyond = "inputs.front_bypass={knots: [[0 s, 2]]}"
    assert inputs_problem("pump_controlled_full", beyond).endswith("'2': must be at most 1")


def test_an_active_actuator_without_inputs_refuses_them():
    line = inputs_problem("pump_controlled", f"inputs.front_bypass={OPEN}")
    assert line == "inputs: the actuator 'pump_controlled' takes none"


@pytest.mark.parametrize("actuator", ["passive", "locked", "none"])
def test_a_bar_that_takes_no_command_runs_a_cycle_with_inputs_as_one_without(actuator):
    settings = ("duration=0.05 s",)
    bump = recording("single_wheel_bump_decoupled", actuator, *settings)
    np.testing.assert_array_equal(bump.values, recording("single_wheel_bump", actuator, *settings).values)
