"""A bench's input is one of its forms, as a cycle's file states it."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.excitation.excitation import ExcitationOf, value
from ars_mujoco.manoeuvres.cycle import Cycle
from ars_mujoco.schema import library
from ars_mujoco.schema.document import override, read
from ars_mujoco.schema.errors import InputError

FORMS = {
    "knots": {"join": "linear", "knots": [("0 s", "0 mm"), ("1 s", "-30 mm"), ("2 s", "10 mm")]},
    "sine": {"sine": {"amplitude": "20 mm", "frequency": "2 Hz", "offset": "-10 mm"}},
    "sweep": {"sweep": {"amplitude": "-30 mm", "first_frequency": "1 Hz", "last_frequency": "9 Hz", "duration": "2 s"}},
    "recorded": {"recorded": "travel.csv"},
}


@pytest.fixture
def form(request, tmp_path, monkeypatch):
    """An Excitation of the form that is asked for."""
    monkeypatch.chdir(tmp_path)
    Path("travel.csv").write_text("time (s),travel (mm)\n0,0\n0.5,-30\n1.2,7\n")
    return ExcitationOf("m")(**FORMS[request.param])


def manoeuvre(*settings, cycle="bench_sine"):
    return read(Cycle, cycle, "cycle", [override(each) for each in settings]).value.manoeuvre


def problem(*settings, cycle="bench_sine"):
    with pytest.raises(InputError) as error:
        manoeuvre(*settings, cycle=cycle)
    (line,) = error.value.problems
    return line


@pytest.mark.parametrize("form", FORMS, indirect=True)
def test_the_peak_is_the_largest_that_is_reached(form):
    record = form.record()
    reached = max(abs(value(record, form.samples(), t)) for t in np.linspace(0.0, 2.0, 2001))
    assert reached == pytest.approx(form.peak(), rel=1e-3)
    assert form.peak() == pytest.approx(0.03)


@pytest.mark.parametrize("form", FORMS, indirect=True)
def test_an_input_is_in_si_and_begins_at_its_start(form):
    record = form.record()
    assert value(record, form.samples(), 0.0) == pytest.approx(-0.01 if form.sine else 0.0)
    assert value(record, form.samples(), -1.0) == value(record, form.samples(), 0.0)


@given(t=st.floats(0.0, 3.0), name=st.sampled_from(["knots", "sine", "sweep"]))
def test_interpreted_and_compiled_agree(t, name):
    form = ExcitationOf("m")(**FORMS[name])
    record, samples = form.record(), form.samples()
    assert getattr(value, "py_func", value)(record, samples, t) == pytest.approx(
        value(record, samples, t), rel=1e-12, abs=1e-12
    )


def test_a_step_is_knots_joined_by_a_step():
    command = manoeuvre(cycle="bench_step_1deg").command
    assert [value(command.record(), command.samples(), t) for t in (0.0, 0.3, 9.0)] == pytest.approx(
        [np.radians(1.0)] * 3
    )


SINE = "manoeuvre.command.sine"


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        (f"{SINE}.amplitude=2", f"{SINE}.amplitude: '2': needs a unit: rad, deg or rev"),
        (f"{SINE}.amplitude=2 mm", f"{SINE}.amplitude: '2 mm': wrong unit; allowed: rad, deg or rev"),
        (f"{SINE}.frequency=0 Hz", f"{SINE}.frequency: '0 Hz': must be greater than 0 Hz"),
        (f"{SINE}.frequency=1 kHz", f"{SINE}.frequency: '1 kHz': must be at most 0.1 kHz"),
        (f"{SINE}.frequency=6 rad/s", f"{SINE}.frequency: '6 rad/s': wrong unit; allowed: 1/s or Hz"),
        (f"{SINE}.freqency=1 Hz", f"{SINE}.freqency: unknown key; did you mean 'frequency'?; allowed: amplitude, "),
        (f"{SINE}.periods=0", f"{SINE}.periods: '0': must be greater than 0"),
        ("manoeuvre.command={sine: {frequency: 1 Hz}}", f"{SINE}.amplitude: is missing; a value in rad, deg or rev"),
        ("manoeuvre.command={sine: 1 deg}", f"{SINE}: '1 deg': needs a block of keys"),
        ("manoeuvre.command={}", "manoeuvre.command: needs one of knots, sine, sweep, recorded"),
        ("manoeuvre.command={knots: []}", "manoeuvre.command.knots: a signal has 1 to 32 knots, not 0"),
        (
            "manoeuvre.command.sin.amplitude=1 deg",
            "manoeuvre.command.sin: unknown key; did you mean 'sine'?; allowed: ",
        ),
        ("manoeuvre.motor=locked", "manoeuvre.motor: 'locked': unknown; allowed: commanded, held, free"),
        ("manoeuvre.ends={recorded: no.csv}", "manoeuvre.ends.recorded: 'no.csv': cannot be read: No such file"),
    ],
)
def test_an_input_that_makes_no_sense_is_refused_in_one_line(setting, expected):
    assert problem(setting).startswith(f"--set {setting}: {expected}")


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("manoeuvre.command.join=linear", "join is for knots; a sine has none"),
        ("manoeuvre.command.knots=[[0 s, 1 deg]]", "needs one of knots, sine, sweep, recorded, not knots and sine"),
        ("manoeuvre.motor=free", "a motor that is free takes no command; allowed with motor: commanded"),
        ("manoeuvre.motor=held", "a motor that is held takes no command; allowed with motor: commanded"),
    ],
)
def test_what_would_be_ignored_is_refused_in_one_line(setting, expected):
    assert problem(setting).endswith(f"bench_sine.yaml:7: manoeuvre.command: {expected}")


@pytest.mark.parametrize(
    ("setting", "expected"),
    [
        ("first_frequency=0 Hz", "first_frequency: '0 Hz': a logarithmic sweep never reaches 0 Hz; allowed: more, or"),
        ("last_frequency=0.5 Hz", "last_frequency: '0.5 Hz': must differ from the first frequency"),
        ("spacing=octaves", "spacing: 'octaves': unknown; allowed: linear, logarithmic"),
        ("duration=0 s", "duration: '0 s': must be greater than 0 s"),
    ],
)
def test_a_sweep_that_makes_no_sense_is_refused_in_one_line(setting, expected):
    setting = f"manoeuvre.command.sweep.{setting}"
    line = problem(setting, cycle="bench_sweep")
    assert line.startswith(f"--set {setting}: manoeuvre.command.sweep.{expected}")


def test_a_commanded_motor_needs_a_command():
    line = problem("manoeuvre.motor=commanded", cycle="bench_ends_free")
    assert line.endswith("manoeuvre: a commanded motor needs a command; without one, motor: held or free")


def test_a_recorded_input_lies_beside_the_cycle_that_names_it_and_a_settings_where_the_command_is_given(
    tmp_path, monkeypatch
):
    there, here = tmp_path / "there", tmp_path / "here"
    for folder, travel in ((there, 1), (here, 2)):
        folder.mkdir()
        (folder / "travel.csv").write_text(f"time (s),travel (mm)\n0,{travel}\n")
    shipped = library.find("cycle", "bench_recorded").read_text()
    (there / "mine.yaml").write_text(shipped.replace("bench_recorded.csv", "travel.csv"))
    monkeypatch.chdir(here)
    assert manoeuvre(cycle="../there/mine.yaml").ends.recorded.values == pytest.approx([1e-3])
    for setting in ("manoeuvre.ends={recorded: travel.csv}", "manoeuvre.ends.recorded=travel.csv"):
        assert manoeuvre(setting, cycle="../there/mine.yaml").ends.recorded.values == pytest.approx([2e-3])


def test_a_cycle_names_the_line_of_a_file_that_is_wrong(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("travel.csv").write_text("time (s),travel (deg)\n0,0\n")
    Path("mine.yaml").write_text(
        "title: mine\ndescription: mine\nrig: bench\nduration: 1 s\nmanoeuvre:\n  kind: bar_command\n  motor: held\n"
        "  ends:\n    recorded: travel.csv\n"
    )
    assert problem(cycle="mine.yaml") == (
        "mine.yaml:9: manoeuvre.ends.recorded: 'travel.csv': line 1: 'travel (deg)': wrong unit; "
        "allowed: m, cm, mm, km, in or ft"
    )


def test_a_run_keeps_the_name_and_the_hash_of_a_recorded_input_not_its_samples():
    ends = manoeuvre(cycle="bench_recorded").model_dump(mode="json")["ends"]
    assert ends["recorded"].keys() == {"file", "sha256"}
    assert ends["recorded"]["file"] == "bench_recorded.csv"
