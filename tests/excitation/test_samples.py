"""A recorded input is its file's samples joined by straight lines, and a file that is none is refused."""

import hashlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ars_mujoco.excitation.samples import MOST, SAMPLES, read_samples, sampled
from ars_mujoco.schema.document import Written

TIMES, VALUES = [0.5, 1.0, 1.25, 4.0], [3.0, -1.0, 5.0, 4.0]


def record(times, values):
    """A SAMPLES record."""
    p = np.zeros(1, SAMPLES).view(np.recarray)[0]
    p.count, p.times[: len(times)], p.values[: len(times)] = len(times), times, values
    return p


@pytest.fixture
def read(tmp_path, monkeypatch):
    """Read a text as the samples of a travel."""
    monkeypatch.chdir(tmp_path)

    def read_text(text):
        (tmp_path / "travel.csv").write_bytes(text.encode())
        return read_samples("travel.csv", "m")

    return read_text


@given(t=st.floats(0.0, 5.0))
def test_between_samples_lies_a_straight_line_and_beyond_them_nothing_changes(t):
    assert sampled(record(TIMES, VALUES), t) == pytest.approx(np.interp(t, TIMES, VALUES), abs=1e-14)


def test_a_sample_is_met_to_the_last_bit():
    p = record(TIMES, VALUES)
    assert [sampled(p, t) for t in TIMES] == VALUES


def test_as_many_samples_as_there_is_room_for():
    times = np.arange(MOST) / 1000.0
    p = record(times, times**2)
    for t in (0.0, 1.2345, 9.9985):
        assert sampled(p, t) == pytest.approx(np.interp(t, times, times**2), abs=1e-14)


def test_a_sampled_sine_is_off_by_the_interpolation_alone():
    omega, step = 2 * np.pi * 3.0, 0.01
    times = np.arange(201) * step
    p = record(times, np.sin(omega * times))
    fine = np.linspace(0.0, 2.0, 20001)
    error = np.abs([sampled(p, t) for t in fine] - np.sin(omega * fine)).max()
    bound = step**2 / 8 * omega**2
    assert 0.95 * bound < error < bound


@given(t=st.floats(0.0, 5.0))
def test_interpreted_and_compiled_agree(t):
    p = record(TIMES, VALUES)
    assert getattr(sampled, "py_func", sampled)(p, t) == pytest.approx(sampled(p, t), rel=1e-12, abs=1e-12)


def test_a_file_is_read_in_si_with_its_hash(read):
    text = "time (ms),travel of the ends (mm)\n0,0\n 10 , 1.5\n25,-2e1\n"
    samples = read(text)
    assert samples.times == pytest.approx([0.0, 0.01, 0.025])
    assert samples.values == pytest.approx([0.0, 0.0015, -0.02])
    assert (samples.file, samples.sha256) == ("travel.csv", hashlib.sha256(text.encode()).hexdigest())


def test_a_spreadsheets_file_is_read_too(read):
    assert read('\ufeff"time (s)","travel (m)"\r\n0,0\r\n1,0.01\r\n\r\n').values == pytest.approx([0.0, 0.01])


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("", "is empty"),
        ("0,0\n1,1\n", "line 1: needs two columns, each with its name and unit"),
        ("time (s),travel\n0,0\n", "line 1: needs two columns, each with its name and unit"),
        ("time (s),travel (mm),load (N)\n", "line 1: needs two columns"),
        ("time (s),travel ()\n0,0\n", "line 1: 'travel ()': needs a unit: m, cm, mm, km, in or ft"),
        ("time (s),travel (deg)\n0,0\n", "line 1: 'travel (deg)': wrong unit; allowed: m, cm, mm, km, in or ft"),
        ("travel (mm),time (s)\n0,0\n", "line 1: 'travel (mm)': wrong unit; allowed: s, ms, min or h"),
        ("time (s),travel (mmm)\n0,0\n", "line 1: 'travel (mmm)': unknown unit 'mmm'; did you mean 'mm'?"),
        ("time (s),travel (mm)\n", f"holds 0 samples; allowed: 1 to {MOST}"),
        ("time (s),travel (mm)\n0,0\n1\n", "line 3 has 1 cell, the header 2"),
        (
            "time (s),travel (mm)\n0,0\n1,2,3\n",
            "line 3 has 3 cells, the header 2; with decimal commas a table needs another delimiter",
        ),
        ("time (s),travel (mm)\n0,0\n1,nan\n", "line 3: travel: 'nan': not a finite number"),
        ("time (s),travel (mm)\n0,0\n1,\n", "line 3: travel: '': not a finite number"),
        (
            "time (s),travel (mm)\n0,0\n1,2 mm\n",
            "line 3: travel: '2 mm': not a bare number; the unit stands in the header",
        ),
        ("time (s),travel (mm)\n0,0\n1,1\n1,2\n", "line 4: '1': times must rise from line to line"),
        ("time (s),travel (mm)\n0,0\n2,1\n\n1,2\n", "line 5: '1': times must rise from line to line"),
    ],
)
def test_what_is_no_recorded_input_is_refused(read, text, problem):
    with pytest.raises(ValueError) as error:
        read(text)
    assert str(error.value).startswith(problem)


LOG = "t,vEgo,steer\n0,33,1\n0.1,33,2\n"


def test_of_a_table_with_other_columns_one_is_named(tmp_path):
    (tmp_path / "log.csv").write_text(LOG)
    wanted = {"file": Written("log.csv", tmp_path), "column": "Steer", "units": {"t": "s", "steer": "mm"}}
    samples = read_samples(wanted, "m")
    assert (samples.file, samples.times.tolist()) == ("log.csv", [0.0, 0.1])
    assert samples.values == pytest.approx([1e-3, 2e-3])
    backwards = read_samples(wanted | {"column": "t", "time": "steer", "units": {"t": "mm", "steer": "s"}}, "m")
    assert backwards.times.tolist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"column": "ster"}, "line 1: no column 'ster'; did you mean 'steer'?"),
        ({"units": {"t": "s"}}, "line 1: 'steer': needs a unit: m, cm, mm, km, in or ft"),
        ({"units": {"time": "s"}}, "line 1: no column 'time'"),
        ({"colum": "steer"}, "needs a file's name, or a block of file, column, and where needed time and units"),
    ],
)
def test_a_column_that_is_not_there_is_refused(tmp_path, change, problem):
    (tmp_path / "log.csv").write_text(LOG)
    with pytest.raises(ValueError) as error:
        read_samples({"file": Written("log.csv", tmp_path), "column": "steer"} | change, "m")
    assert str(error.value) == problem


def test_more_samples_than_there_is_room_for_are_refused(read):
    rows = "\n".join(f"{i},0" for i in range(MOST + 1))
    with pytest.raises(ValueError, match=f"^holds {MOST + 1} samples; allowed: 1 to {MOST}$"):
        read(f"time (s),travel (mm)\n{rows}\n")


def test_a_missing_file_and_a_folder_are_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="^cannot be read: No such file or directory$"):
        read_samples("travel.csv", "m")
    with pytest.raises(ValueError, match="^cannot be read: Is a directory$"):
        read_samples(".", "m")
