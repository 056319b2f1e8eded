"""A user's own controller: one Python function in a file."""

import importlib
import math
import sys
import warnings

import numpy as np
import pytest

from ars_mujoco.control import law as laws
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
PUSH = """
GIVES = "torque"

def command(sensors, memory):
    memory[0] += 1.0
    return 300.0, -200.0
"""
SWAY = """
import math

GIVES = "torque"

def command(sensors, memory):
    wave = math.sin(9.0 * sensors.time)
    return 300.0 * wave, -200.0 * wave
"""
PUSHED = "manoeuvre.acceleration={knots: [[0.1 s, 0 m/s^2], [0.3 s, 6 m/s^2]]}"
FOLLOWERS = ["pump_controlled", "electromechanical"]  # of an angle, of a torque
SLOW = r"slow.py: command\(\) does not compile, so it runs in Python: No implementation.* \(line 3\)"
NOT_COMPILED = HOLD.replace("memory[0] += 1.0", "memory[0] += float(str(1))")


@pytest.fixture
def law(tmp_path):
    def write(text):
        path = tmp_path / "law.py"
        path.write_text(text)
        return path

    return write


def drive(path, *settings, cycle="s_curve_120kmh", actuator=None):
    inputs = read_inputs(cycle, actuator, str(path), settings=["duration=0.5 s", *settings])
    return simulate(simulation_of(inputs))


def test_its_angles_are_what_the_bars_are_commanded(law):
    recording = drive(law(HOLD))
    assert (recording["front.bar.command"][1:] == 0.05).all()
    assert (recording["rear.bar.command"][1:] == -0.02).all()
    assert recording["front.bar.angle"][-1] == pytest.approx(0.05, rel=0.05)


def test_it_is_called_once_a_sample_and_its_memory_stays(law):
    path = law("def command(sensors, memory):\n    memory[0] += 1.0\n    return 1e-4 * memory[0], 0.1 * sensors.time\n")
    recording = drive(path, "controller.unit.sample_time=5 ms")
    assert recording["front.bar.command"][1] == 1e-4
    np.testing.assert_allclose(recording["front.bar.command"][:100:5], 1e-4 * np.arange(1, 21), rtol=1e-12)
    held = recording["rear.bar.command"][:100].reshape(-1, 5)
    assert (held == held[:, :1]).all()


def test_it_reads_the_sensors_of_the_running_car(law):
    recording = drive(law("def command(sensors, memory):\n    return 1e-3 * sensors.speed, sensors.roll\n"))
    np.testing.assert_allclose(recording["front.bar.command"], 1e-3 * recording["body.speed"], rtol=1e-12)
    np.testing.assert_allclose(recording["rear.bar.command"], recording["body.roll"], rtol=1e-12, atol=1e-300)


def test_it_also_drives_the_roll_plane(law):
    assert drive(law(HOLD), cycle="roll_plane_step")["front.bar.angle"][-1] > 0.04


# ---- torques

PROMPT = ("controller.unit.sample_time=1 ms", "controller.unit.delay=0 s")


@pytest.mark.parametrize("actuator", FOLLOWERS)
def test_a_law_of_torques_is_the_law_of_the_angles_at_which_the_bars_give_them(law, actuator, tmp_path):
    """phi = psi + M / c, the twists psi being those of the run by torques, whichever of both the system follows."""
    by_torques = drive(law(SWAY), *PROMPT, cycle="roll_plane_step", actuator=actuator)
    vehicle = read_inputs("roll_plane_step").vehicle.value
    torque = np.sin(9.0 * by_torques.time) * np.array([[300.0], [-200.0]])
    twist = np.array([by_torques["front.bar.twist"], by_torques["rear.bar.twist"]])
    angles = (twist.T + torque.T / [vehicle.front.stiffness, vehicle.rear.stiffness]).tolist()
    other = tmp_path / "angles.py"
    other.write_text(
        f"import numpy as np\nANGLES = np.array({angles})\n\n"
        "def command(sensors, memory):\n    i = round(sensors.time / 1e-3)\n    return ANGLES[i, 0], ANGLES[i, 1]\n"
    )
    by_angles = drive(other, *PROMPT, cycle="roll_plane_step", actuator=actuator)
    assert np.abs(by_torques["front.bar.angle"]).max() > 0.03
    peaks = np.abs(by_torques.values).max(axis=0)
    assert (np.abs(by_angles.values - by_torques.values) <= 1e-11 * peaks).all()


@pytest.mark.parametrize("actuator", FOLLOWERS)
def test_the_bars_give_the_torques_that_a_law_asks_for(law, actuator):
    """While the body is pushed to the side, and rolls: the angles that it takes are not known before."""
    push = "manoeuvre.acceleration={knots: [[0.5 s, 0 m/s^2], [0.6 s, 2 m/s^2]]}"
    recording = drive(law(PUSH), push, "duration=3 s", cycle="roll_plane_step", actuator=actuator)
    assert np.ptp(recording["front.bar.twist"]) > 0.1
    assert recording["front.bar.torque"][-1] == pytest.approx(300.0, rel=0.02)  # the pump's loop is proportional
    assert recording["rear.bar.torque"][-1] == pytest.approx(-200.0, rel=0.02)


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_a_law_of_torques_gives_the_same_in_python(law, tmp_path):
    native = drive(law(PUSH), cycle="roll_plane_step")
    slow = tmp_path / "slow.py"
    slow.write_text(PUSH.replace("+= 1.0", "+= float(str(1))"))
    np.testing.assert_array_equal(drive(slow, cycle="roll_plane_step").values, native.values)


def test_a_law_that_says_nothing_gives_angles(law):
    said = drive(law("GIVES = 'angle'\n" + HOLD), cycle="roll_plane_step")
    np.testing.assert_array_equal(said.values, drive(law(HOLD), cycle="roll_plane_step").values)


@pytest.mark.parametrize("gives", ["'roll'", "3", "None", "['torque']"])
def test_a_law_that_gives_anything_else_is_refused(law, gives):
    path = law(f"GIVES = {gives}\n{HOLD}")
    with pytest.raises(InputError) as error:
        drive(path)
    assert str(error.value) == f"{path}: GIVES is {gives}; allowed: angle, torque"


# ---- what goes wrong


def test_a_function_that_does_not_compile_runs_in_python_with_a_warning_and_gives_the_same(law, tmp_path):
    native = drive(law(HOLD))
    other = tmp_path / "slow.py"
    other.write_text(NOT_COMPILED)
    with pytest.warns(
        UserWarning,
        match=SLOW,
    ):
        slow = drive(other)
    np.testing.assert_array_equal(slow.values, native.values)


@pytest.mark.parametrize("jitted", ["", "import numba\n@numba.njit\n"])
def test_a_function_that_prints_runs_in_python(law, jitted):
    """Compiled code that prints, itself or in a function that it calls, may keep the interpreter's lock for good."""
    path = law(
        f"{jitted}def say(x):\n    print(x)\n\n"
        "def command(sensors, memory):\n    say(sensors.time)\n    return 0.0, 0.0\n"
    )
    with pytest.warns(
        UserWarning, match="does not compile, so it runs in Python: (it prints|Untyped global name 'say')"
    ):
        assert not Law(path).is_native


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
@pytest.mark.filterwarnings("ignore:.*does not compile")
@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("raise ValueError(1)", "ValueError: 1 (law.py, line 3)"),
        ("raise ValueError(f'of {sensors.time:g} s')", "ValueError: of 0.2 s (law.py, line 3)"),
        ("raise SystemExit(3)", "SystemExit: 3 (law.py, line 3)"),
        ("memory[32] = 0.0", "IndexError: index 32 is out of bounds for axis 0 with size 32 (law.py, line 3)"),
        ("return None", "command() returned None; it must return two numbers, the front bar's and the rear bar's"),
        ("return sensors.nothing", "AttributeError: 'Readings' object has no attribute 'nothing' (law.py, line 3)"),
    ],
)
def test_a_law_that_fails_while_it_runs_stops_the_run_with_its_name_reason_and_line(law, line, reason):
    """Whether it is compiled or not."""
    path = law(f"def command(sensors, memory):\n    if sensors.time > 0.1995:\n        {line}\n    return 0.0, 0.0\n")
    with pytest.raises(SimulationError) as error:
        drive(path, cycle="roll_plane_step")
    assert str(error.value) == f"{path}: the controller failed at 0.2 s: {reason}"


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_a_fault_beside_the_law_is_told_with_its_place(law, tmp_path):
    (tmp_path / "gains.py").write_text("def gain():\n    return 1 / 0\n")
    path = law("from gains import gain\n\ndef command(sensors, memory):\n    return gain(), 0.0\n")
    with pytest.raises(SimulationError, match=r"at 0 s: ZeroDivisionError: division by zero \(gains.py, line 2\)"):
        drive(path)


@pytest.mark.filterwarnings("ignore:.*does not compile")
@pytest.mark.parametrize("in_python", ["", "    str(sensors)\n"])
@pytest.mark.parametrize(
    ("result", "told"),
    [
        ("math.inf * sensors.time, math.inf", "nan for the front bar's angle and inf for the rear bar's angle at 0 s"),
        ("1e-8 * 1e308 ** (sensors.time > 0.0995), 0.0", "1e+300 for the front bar's angle at 0.1 s"),
        ("0.0, -math.inf", "-inf for the rear bar's angle at 0 s"),
    ],
)
def test_a_law_that_returns_what_is_not_finite_stops_the_run(law, in_python, result, told):
    """Compiled or not; an infinite command would be held at the actuator's limit and look like a good one."""
    path = law(f"import math\ndef command(sensors, memory):\n{in_python}    return {result}\n")
    with pytest.raises(SimulationError) as error:
        drive(path, cycle="roll_plane_step")
    assert str(error.value) == f"{path}: the controller returned {told}; allowed: up to 100 rad"


def test_a_torque_that_no_bar_can_give_stops_the_run(law):
    path = law("GIVES = 'torque'\ndef command(sensors, memory):\n    return 0.0, -2e6\n")
    with pytest.raises(
        SimulationError, match="returned -2e\\+06 for the rear bar's torque at 0 s; allowed: up to 1e\\+06 Nm"
    ):
        drive(path, cycle="roll_plane_step")


def test_degrees_in_place_of_radians_get_a_remark(law):
    """In a turn to 6 m/s^2 the bars are asked for 5 deg; as radians that is 286."""
    path = law("def command(sensors, memory):\n    return 0.825 * sensors.lateral_acceleration, 0.0\n")
    with pytest.warns(
        UserWarning, match="law.py: the controller asks for bar angles over 57 deg; .* does it give degrees"
    ):
        drive(path, "duration=1 s", PUSHED, cycle="roll_plane_step")


def test_a_law_within_reason_gets_none(law):
    path = law("def command(sensors, memory):\n    return 0.0144 * sensors.lateral_acceleration, 0.0\n")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        drive(path, "duration=1 s", PUSHED, cycle="roll_plane_step")


# ---- a module like any other, and a new one for every run


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_a_law_with_state_of_its_own_is_the_law_with_memory(law, tmp_path):
    """The car's set-up drives it in two turns before, and each run begins anew."""
    law("""
class Integrator:
    sum = 0.0

    def __call__(self, sensors, memory):
        self.sum += sensors.lateral_acceleration * sensors.step
        return 0.012 * sensors.lateral_acceleration + 0.004 * self.sum, 0.008 * sensors.lateral_acceleration

command = Integrator()
""")
    other = tmp_path / "memory.py"
    other.write_text("""
def command(sensors, memory):
    memory[0] += sensors.lateral_acceleration * sensors.step
    return 0.012 * sensors.lateral_acceleration + 0.004 * memory[0], 0.008 * sensors.lateral_acceleration
""")
    own, kept = (
        simulation_of(read_inputs("step_steer_iso7401", controller=str(path), settings=["duration=1.5 s"]))
        for path in (tmp_path / "law.py", other)
    )
    assert (own.law.is_native, kept.law.is_native) == (False, True)
    values = simulate(kept).values
    for _ in range(2):
        np.testing.assert_array_equal(simulate(own).values, values)


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_modules_beside_it_dataclasses_and_globals_work_and_begin_anew(law, tmp_path):
    (tmp_path / "counting.py").write_text("calls = 0\n")
    path = law("""
from __future__ import annotations
from dataclasses import dataclass, field
import counting

@dataclass
class Gains:
    front: float = 1e-3
    past: list[float] = field(default_factory=list)

gains, total = Gains(), 0

def command(sensors, memory):
    import counting as again
    global total
    total += 1
    again.calls += 1
    gains.past.append(sensors.time)
    assert total == counting.calls == len(gains.past)
    return gains.front * total, 0.0
""")
    for _ in range(2):
        recording = drive(path, cycle="roll_plane_step")
        assert recording["front.bar.command"][9] == pytest.approx(1e-2)
    assert "counting" not in sys.modules and str(tmp_path) not in sys.path


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_a_module_that_the_program_has_loaded_itself_is_not_the_laws(law, tmp_path, monkeypatch):
    (tmp_path / "shared_gain.py").write_text("gain = 1e-3\n")
    monkeypatch.syspath_prepend(tmp_path)
    module = importlib.import_module("shared_gain")
    module.gain = 7.0
    path = law("import shared_gain\n\ndef command(sensors, memory):\n    return shared_gain.gain * len(str(1)), 0.0\n")
    assert drive(path, cycle="roll_plane_step")["front.bar.command"][5] == 1e-3
    assert sys.modules.pop("shared_gain") is module


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_what_a_law_keeps_of_its_sensors_stays_as_it_was(law):
    path = law("""
past = []

def command(sensors, memory):
    past.append(sensors)
    return past[-1].time - past[max(len(past) - 11, 0)].time, 0.0
""")
    assert drive(path, cycle="roll_plane_step")["front.bar.command"][100] == pytest.approx(0.01)


def test_it_runs_as_it_was_read_whatever_becomes_of_its_file(law):
    path = law("def command(sensors, memory):\n    str(sensors)\n    return 0.05, 0.0\n")
    with pytest.warns(UserWarning, match="does not compile"):
        simulation = simulation_of(read_inputs("roll_plane_step", controller=str(path), settings=["duration=0.1 s"]))
    law("def command(sensors, memory):\n    str(sensors)\n    return 0.01, 0.0\n")
    assert simulate(simulation)["front.bar.command"][-1] == 0.05


@pytest.mark.filterwarnings("ignore:.*does not compile")
def test_an_interruption_by_the_keyboard_goes_through(law):
    path = law("def command(sensors, memory):\n    str(sensors)\n    raise KeyboardInterrupt\n")
    with pytest.raises(KeyboardInterrupt):
        drive(path, cycle="roll_plane_step")


@pytest.mark.filterwarnings("ignore:.*does not compile")
@pytest.mark.parametrize("result", ["0.1", "0.1, 0.2, 0.3", "None", "'left', 'right'", "'0.1', '0.2'", "[[0.1, 0.2]]"])
def test_a_law_that_returns_anything_but_two_numbers_is_stopped(law, result):
    with pytest.raises(SimulationError, match=r"the controller failed at 0 s: command\(\) returned .* two numbers"):
        drive(law(f"def command(sensors, memory):\n    return {result}\n"))


def test_a_law_that_takes_other_arguments_is_refused(law):
    with pytest.raises(InputError, match=r"law.py: command\(\) cannot be called as command\(sensors, memory\)"):
        drive(law("def command(sensors):\n    return 0.0, 0.0\n"))


def test_a_file_that_ends_the_program_is_an_error(law):
    with pytest.raises(InputError, match="SystemExit"):
        drive(law("import sys\nsys.exit(0)\n"))


def test_a_law_is_compiled_once(law):
    own = Law(law(HOLD))
    rig = simulation_of(read_inputs("s_curve_120kmh")).rig
    assert own.sampling(rig) is own.sampling(rig)


def test_a_law_is_found_again_on_disk_by_what_it_says(law):
    """By a process that has not compiled it, wherever the file lies; another number in it is another law."""
    rig = simulation_of(read_inputs("roll_plane_step")).rig

    def callback(text):
        return Law(law(text)).sampling(rig)

    def forget():
        laws._by_program.clear()

    forget()
    assert callback(HOLD).address
    forget()
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
