"""Sines and sweeps are their closed forms: value, frequency at every moment, and where they begin and end."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from ars_mujoco.excitation.oscillation import OSCILLATION, SineOf, SweepOf, oscillating

SPACINGS = ("linear", "logarithmic")
FIRST, LAST, DURATION, START = 0.5, 20.0, 10.0, 1.0  # Hz, Hz, s, s


def oscillation(parameters):
    """The OSCILLATION record of a Sine or a Sweep."""
    record = np.zeros(1, OSCILLATION).view(np.recarray)
    record[0] = parameters.oscillation()
    return record[0]


def sine(**changed):
    given = {"amplitude": "2 mm", "frequency": "5 Hz", "phase": "30 deg", "offset": "-1 mm", "start": "0.5 s"} | changed
    return oscillation(SineOf("m")(**given))


def sweep(spacing, **changed):
    frequencies = {"first_frequency": f"{FIRST} Hz", "last_frequency": f"{LAST} Hz"}
    given = {"amplitude": "1 rad", "duration": f"{DURATION} s", "start": f"{START} s"} | frequencies | changed
    return oscillation(SweepOf("rad")(spacing=spacing, **given))


def crossing(spacing, half_turns):
    """Time (s) at which a sweep has made that many half turns: its phase solved for time."""
    if spacing == "logarithmic":
        growth = math.log(LAST / FIRST) / DURATION
        return START + math.log1p(0.5 * half_turns * growth / FIRST) / growth
    rise = (LAST - FIRST) / DURATION
    return START + (math.sqrt(FIRST**2 + rise * half_turns) - FIRST) / rise


def frequency(spacing, time):
    """Frequency (Hz) of a sweep at `time` (s)."""
    share = (time - START) / DURATION
    return FIRST * (LAST / FIRST) ** share if spacing == "logarithmic" else FIRST + share * (LAST - FIRST)


@given(t=st.floats(0.5, 100.0))
def test_a_sine_is_a_sine(t):
    expected = -1e-3 + 2e-3 * math.sin(2 * math.pi * 5.0 * (t - 0.5) + math.pi / 6)
    assert oscillating(sine(), t) == pytest.approx(expected, abs=1e-14)


@pytest.mark.parametrize("t", [0.0, 0.3, 0.499])
def test_a_sine_is_held_before_its_start(t):
    assert oscillating(sine(), t) == oscillating(sine(), 0.5) == pytest.approx(-1e-3 + 2e-3 * 0.5)


def test_a_sine_of_whole_periods_ends_where_it_began():
    p = sine(periods="3")
    assert [oscillating(p, t) for t in (1.1, 1.2, 50.0)] == pytest.approx([oscillating(p, 0.5)] * 3, abs=1e-15)
    assert oscillating(p, 1.05) != pytest.approx(oscillating(p, 0.5), abs=1e-4)


def test_the_root_mean_square_of_a_sine_is_its_amplitude_over_the_root_of_two():
    p, times = sine(offset="0 mm"), 0.5 + np.arange(1000) / 1000 / 5.0
    values = np.array([oscillating(p, t) for t in times])
    assert np.sqrt(np.mean(values**2)) == pytest.approx(2e-3 / math.sqrt(2.0), rel=1e-12)


@pytest.mark.parametrize("spacing", SPACINGS)
def test_a_sweep_crosses_zero_where_its_phase_says(spacing):
    p, half_turns = sweep(spacing), 0
    while (t := crossing(spacing, half_turns)) < START + DURATION:
        assert oscillating(p, t) == pytest.approx(0.0, abs=1e-9)
        assert oscillating(p, crossing(spacing, half_turns + 0.5)) == pytest.approx((-1.0) ** half_turns, abs=1e-12)
        half_turns += 1
    turns = {"linear": 0.5 * (FIRST + LAST), "logarithmic": (LAST - FIRST) / math.log(LAST / FIRST)}[spacing] * DURATION
    assert half_turns == math.ceil(2 * turns)


@pytest.mark.parametrize("spacing", SPACINGS)
def test_the_slope_of_a_sweep_at_zero_is_its_frequency_there(spacing):
    p = sweep(spacing)
    for turn in (0.5, 1, 7, 20, 40):
        t = crossing(spacing, 2 * turn)
        slope = (oscillating(p, t + 1e-6) - oscillating(p, t - 1e-6)) / 2e-6
        assert abs(slope) / (2 * math.pi) == pytest.approx(frequency(spacing, t), rel=1e-6)


@pytest.mark.parametrize("spacing", SPACINGS)
def test_a_sweep_is_held_before_and_after(spacing):
    p = sweep(spacing)
    assert oscillating(p, 0.0) == oscillating(p, START) == 0.0
    assert oscillating(p, 100.0) == oscillating(p, START + DURATION)
    assert oscillating(p, START + DURATION - 1e-9) == pytest.approx(oscillating(p, 100.0), abs=1e-6)


def test_a_sweep_downwards_is_one_upwards_in_reverse():
    up, down = (
        sweep("linear", first_frequency=f"{first} Hz", last_frequency=f"{last} Hz", duration="4 s", start="0 s")
        for first, last in ((0, 5), (5, 0))
    )
    for t in np.linspace(0.0, 4.0, 50):
        assert oscillating(up, t) == pytest.approx(-oscillating(down, 4.0 - t), abs=1e-12)  # 10 turns in all


def test_a_negative_amplitude_is_the_mirror_image_to_the_last_bit():
    there, back = sweep("logarithmic"), sweep("logarithmic", amplitude="-1 rad")
    assert all(oscillating(there, t) == -oscillating(back, t) for t in np.linspace(0.0, 12.0, 500))


@pytest.mark.parametrize("end", ["first_frequency", "last_frequency"])
def test_a_logarithmic_sweep_never_reaches_0_hz(end):
    sweep("linear", **{end: "0 Hz"})
    with pytest.raises(ValidationError, match="never reaches 0 Hz; allowed: more, or spacing: linear"):
        sweep("logarithmic", **{end: "0 Hz"})


@given(t=st.floats(0.0, 12.0), spacing=st.sampled_from(SPACINGS))
def test_interpreted_and_compiled_agree(t, spacing):
    p = sweep(spacing)
    assert getattr(oscillating, "py_func", oscillating)(p, t) == pytest.approx(oscillating(p, t), rel=1e-12, abs=1e-12)
