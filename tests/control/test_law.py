"""A user's own controller: one Python function in a file."""

import math
import warnings

import numpy as np
import pytest

from ars_mujoco.control.law import Law
from ars_mujoco.kernels.program import digest
from ars_mujoco.schema.errors import InputError, SimulationError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

HOLD = """
def command(sensors, memory):
    memory[0] += 1.0
    return 0.05, -0.02
"""
NOT_COMPILED = HOLD.replace("memory[0] += 1.0", "memory[0] += float(str(1))")


@pytest.fixture
def law(tmp_path):
    def write(text):
        path = tmp_path / "law.py"
        path.write_text(text)
        return path

    return write


def drive(path, *settings, cycle="s_curve_120kmh"):
    return simulate(simulation_of(read_inputs(cycle, controller=str(path), settings=["duration=0.5 s", *settings])))


def test_its_angles_are_what_the_bars_are_commanded(law):
    recording = drive(law(HOLD))
    assert (recording["front.bar.command"][1:] == 0.05).all()
    assert (recording["rear.bar.command"][1:] == -0.02).all()
    assert recording["front.bar.angle"][-1] == pytest.approx(0.05, rel=0.05)


def test_it_is_called_once_a_sample_and_its_memory_stays(law):
    path = law("def command(sensors, memory):\n    memory[0] += 1.0\n    return 0.001 * memory[0], sensors.time\n")
    recording = drive(path, "controller.unit.sample_time=5 ms")
    assert recording["front.bar.command"][1] == 0.001
    np.testing.assert_allclose(recording["front.bar.command"][:100:5], 0.001 * np.arange(1, 21), rtol=1e-12)
    held = recording["rear.bar.command"][:100].reshape(-1, 5)
    assert (held == held[:, :1]).all()


def test_it_reads_the_sensors_of_the_running_car(law):
    recording = drive(law("def command(sensors, memory):\n    return 1e-3 * sensors.speed, sensors.roll\n"))
    np.testing.assert_allclose(recording["front.bar.command"], 1e-3 * recording["body.speed"], rtol=1e-12)
    np.testing.assert_allclose(recording["rear.bar.command"], recording["body.roll"], rtol=1e-12, atol=1e-300)


def test_it_also_drives_the_roll_plane(law):
    assert drive(law(HOLD), cycle="roll_plane_step")["front.bar.angle"][-1] > 0.04


def test_a_function_that_does_not_compile_runs_in_python_with_a_warning_and_gives_the_same(law, tmp_path):
    native = drive(law(HOLD))
    other = tmp_path / "slow.py"
    other.write_text(NOT_COMPILED)
    with pytest.warns(UserWarning, match="does not compile, so it runs in Python and every step takes several times"):
        slow = drive(other)
    np.testing.assert_array_equal(slow.values, native.values)


def test_a_function_that_compiles_warns_of_nothing(law):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert Law(law(HOLD)).is_native


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def command(sensors, memory):\n    return (", "SyntaxError"),
        ("import no_such_package", "No module named 'no_such_package'"),
        ("def control(sensors, memory):\n    return 0.0, 0.0\n", r"has no function command\(sensors, memory\)"),
        ("command = 3", r"has no function command\(sensors, memory\)"),
    ],
)
def test_a_file_without_a_law_is_an_error_that_names_it(law, text, message):
    path = law(text)
    with pytest.raises(InputError, match=message) as error:
        drive(path)
    assert str(path) in str(error.value)


@pytest.mark.filterwarnings("ignore:.*does not compile")
@pytest.mark.parametrize(
    ("line", "reason"),
    [("raise ValueError(1)", ""), ("raise ValueError(str(sensors))", ": ValueError"), ("return 0.0", ": TypeError")],
)
def test_a_law_that_fails_while_it_runs_stops_the_run_with_its_name(law, line, reason):
    path = law(f"def command(sensors, memory):\n    if sensors.time > 0.1995:\n        {line}\n    return 0.0, 0.0\n")
    with pytest.raises(SimulationError, match=f"law.py: the controller failed at 0.2 s{reason}"):
        drive(path)


def test_a_law_that_returns_no_number_stops_the_run(law):
    path = law("def command(sensors, memory):\n    return 0.0 / (0.2 - sensors.time), float('nan')\n")
    with pytest.raises(SimulationError, match="is not finite"):
        drive(path)


def test_a_law_that_writes_past_its_memory_is_stopped(law):
    path = law("def command(sensors, memory):\n    for i in range(80):\n        memory[i] = 1.0\n    return 0.0, 0.0\n")
    with pytest.raises(SimulationError, match="the controller failed at 0 s"):
        drive(path)


@pytest.mark.filterwarnings("ignore:.*does not compile")
@pytest.mark.parametrize("result", ["0.1", "0.1, 0.2, 0.3", "None", "'left', 'right'"])
def test_a_law_that_returns_anything_but_two_numbers_is_stopped(law, result):
    with pytest.raises(SimulationError, match="the controller failed at 0 s: (Type|Value)Error"):
        drive(law(f"def command(sensors, memory):\n    return {result}\n"))


def test_a_file_that_ends_the_program_is_an_error(law):
    with pytest.raises(InputError, match="SystemExit"):
        drive(law("import sys\nsys.exit(0)\n"))


def test_a_law_is_compiled_once(law):
    own = Law(law(HOLD))
    rig = simulation_of(read_inputs("s_curve_120kmh")).rig
    assert own.callback(rig) is own.callback(rig)


def test_a_law_is_found_again_on_disk_by_what_it_says(law):
    """By a process that has not compiled it, wherever the file lies; another number in it is another law."""
    rig = simulation_of(read_inputs("roll_plane_step")).rig

    def callback(text):
        return Law(law(text)).callback(rig)

    assert callback(HOLD).address
    assert callback(HOLD).compiled.cache_hits == 1
    other = callback(HOLD.replace("-0.02", "-0.03"))
    assert digest(other.function) != digest(callback(HOLD).function) == digest(callback("# a comment" + HOLD).function)


def test_a_missing_file_is_an_error():
    with pytest.raises(InputError, match=r"no controller 'nowhere\.py'"):
        read_inputs("s_curve_120kmh", controller="nowhere.py")


def test_the_bench_takes_no_law(law):
    with pytest.raises(InputError, match="the bench's cycle commands the bar itself"):
        drive(law(HOLD), cycle="bench_s_curve")


def test_a_controllers_file_names_a_law_beside_it(law, tmp_path):
    law(HOLD)
    shipped = read_inputs("s_curve_120kmh").controller.path.read_text()
    (tmp_path / "mine.yaml").write_text(shipped + "law: law.py\n")
    inputs = read_inputs("s_curve_120kmh", controller=str(tmp_path / "mine.yaml"))
    assert inputs.controller.value.law == str(tmp_path / "law.py")
    assert math.isclose(inputs.controller.value.unit.delay, 0.01)
