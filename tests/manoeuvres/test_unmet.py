"""What a run never meets is told: inputs of another time, changes after its end, a bump off its way, idle settings."""

import math
import warnings

import pytest

from ars_mujoco.schema import library
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_compared, read_inputs

RECORDED = library.shipped("cycle")["bench_recorded"].read_text()


@pytest.fixture
def recorded(tmp_path):
    """The inputs of the recorded cycle of 4 s, its ends moved at these times (s)."""

    def read(*times, unit="s"):
        rows = [f"{time!r},{0.001 * math.sin(time)!r}" for time in times]
        (tmp_path / "bench_recorded.csv").write_text("\n".join([f"time ({unit}),travel (m)", *rows]))
        (tmp_path / "mine.yaml").write_text(RECORDED)
        return read_inputs(str(tmp_path / "mine.yaml"))

    return read


@pytest.mark.parametrize("name", library.shipped("cycle"))
def test_a_shipped_cycle_meets_all_that_it_asks_for(name):
    assert read_inputs(name).remarks == ()


@pytest.mark.parametrize(
    ("times", "span"),
    [
        ((153.27, 153.28), "153.27 s to 153.28 s"),
        ((1731500000.0, 1731500000.5), "1731500000 s to 1731500000.5 s"),
        ((-2.0, -1.0), "-2 s to -1 s"),
        ((4.0, 5.0), "4 s to 5 s"),
    ],
)
def test_a_recorded_input_of_another_time_is_refused(recorded, times, span):
    with pytest.raises(InputError) as error:
        recorded(*times)
    told = f"manoeuvre.ends.recorded: 'bench_recorded.csv' covers {span}, nothing of the run from 0 s to 4 s: its times"
    assert str(error.value).startswith(told)


def test_a_recorded_input_of_little_of_the_run_is_told(recorded):
    told = (
        "manoeuvre.ends.recorded: 'bench_recorded.csv' covers {} s of the run's 4 s; its first and its last value are"
    )
    for inputs, covered in (
        (recorded(0.0, 0.29, 0.58, unit="ms"), "0.00058"),
        (recorded(1.0, 2.0, 9.0), "3"),  # it begins late
        (recorded(0.0, 1.9), "1.9"),
    ):
        (remark,) = inputs.remarks
        assert remark.startswith(told.format(covered))
    assert recorded(0.0, 1.0, 3.5).remarks == recorded(0.1, 5.0).remarks == recorded(0.0).remarks == ()


@pytest.mark.parametrize(
    ("cycle", "setting", "remark"),
    [
        ("s_curve_120kmh", "duration=4 s",
         "manoeuvre.lateral_acceleration.knots: goes on to 18 s, and the run ends at 4 s"),
        ("step_steer_iso7401", "manoeuvre.start=6 s", "manoeuvre: begins at 6 s, and the run ends at 5 s"),
        ("bench_sine", "manoeuvre.command.sine.start=5 s",
         "manoeuvre.command.sine: begins at 5 s, and the run ends at 3 s"),
        ("bench_sweep", "duration=5 s", "manoeuvre.command.sweep: goes on to 10 s, and the run ends at 5 s"),
        ("bench_step_1deg", "manoeuvre.command.knots=[[0 s, 0 deg], [1 s, 1 deg]]",
         "manoeuvre.command.knots: begins at 1 s, and the run ends at 0.6 s"),
        ("bench_fail_safe", "inputs.front_fail_safe.knots=[[0 s, 0], [3 s, 0], [4 s, 1]]",
         "inputs.front_fail_safe.knots: begins at 4 s, and the run ends at 3 s"),
        ("single_wheel_bump", "road.bump.position=500 m",
         "road.bump: begins 500 m ahead, and the front wheels come to 45.82 m"),
        ("single_wheel_bump", "road.bump.position=44 m",
         "road.bump: begins 44 m ahead, and the rear wheels come to 43.02 m only"),
        ("single_wheel_bump", "road.bump.position=-5 m",
         "road.bump: ends at -4 m, behind the rear wheels, which start at -1.43 m"),
        ("bench_step_1deg", "duration=0.6 s", "--set duration=0.6 s: changes nothing"),
        ("bench_step_1deg", "reference=none",
         "--set reference=none: changes nothing: on the bench nothing is compared"),
    ],
)  # fmt: skip
def test_what_lies_off_the_run_is_told(cycle, setting, remark):
    assert read_inputs(cycle, settings=[setting]).remarks == (remark,)


def test_a_setting_that_a_passive_bar_does_not_hear_is_told():
    setting = "controller.unit.delay=3 ms"
    (remark,) = read_inputs("s_curve_120kmh", "passive", settings=[setting]).remarks
    assert remark == f"--set {setting}: changes nothing: a bar that is torsion_bar obeys no controller"
    assert read_inputs("s_curve_120kmh", settings=[setting]).remarks == ()


def test_a_study_warns_of_its_own_runs_and_not_of_those_that_it_is_measured_against():
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        read_compared("s_curve_120kmh", [None], settings=["controller.unit.delay=3 ms", "duration=17 s"])
    assert [str(each.message).split(":")[0] for each in told] == ["manoeuvre.lateral_acceleration.knots"]


def test_an_input_that_is_misspelt_is_refused_for_a_passive_bar_too():
    misspelt = "inputs.front_bypas.knots=[[0 s, 1]]"
    for actuator in (None, "passive"):
        with pytest.raises(InputError, match="inputs.front_bypas: unknown key; did you mean 'front_bypass'?"):
            read_inputs("single_wheel_bump_decoupled", actuator, settings=[misspelt])
    with pytest.raises(InputError, match="inputs: none of the run's actuators takes any"):
        read_compared("s_curve_120kmh", ["passive"], settings=[misspelt])
    assert read_inputs("single_wheel_bump_decoupled", "passive").remarks == ()
