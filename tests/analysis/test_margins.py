"""Margins of the loop, and what a control unit that samples and is late costs of them."""

import math

import control
import numpy as np
import pytest
from bench import drive
from theory import LOOP

from ars_mujoco.analysis.linearization import actuator, open_loop
from ars_mujoco.analysis.margins import compute, margins, sampled, sampled_loop

ACTUATOR = actuator(LOOP)["angle", "stroke_command"]


def test_the_nominal_loop_has_10_6_db_65_deg_and_21_hz():
    found = margins(open_loop(LOOP))
    assert found["gain_margin"] == pytest.approx(10.6, abs=0.05)
    assert found["phase_margin"] == pytest.approx(65, abs=1)
    assert found["bandwidth"] == pytest.approx(21, abs=0.1)
    assert found["is_stable"]


def test_margins_are_python_control_s_own():
    gain, phase, _, _ = control.margin(open_loop(LOOP))
    found = margins(open_loop(LOOP))
    assert found["gain_margin"] == pytest.approx(20 * math.log10(gain), rel=1e-4)
    assert found["phase_margin"] == pytest.approx(phase, rel=1e-4)


@pytest.mark.parametrize("sample_time", [1e-3, 5e-3])
@pytest.mark.parametrize("delay", [0.0, 1e-3, 2.5e-3, 10e-3])
def test_a_held_step_arrives_exactly_late(sample_time, delay):
    # a step at t = 0 that comes `delay` late is the continuous step response, shifted
    steps = np.arange(60)
    _, late = control.step_response(sampled(ACTUATOR, sample_time, delay), steps * sample_time)
    for step, value in zip(steps, late, strict=True):
        since = step * sample_time - delay
        exact = control.step_response(ACTUATOR, [0.0, since])[1][-1] if since > 1e-9 else 0.0
        assert value == pytest.approx(exact, rel=1e-6, abs=1e-12)


def test_sampling_and_delay_each_cost_margin():
    rows = {(row["sample_time"], row["delay"]): row for row in compute(LOOP)["rows"]}
    for name in ("gain_margin", "phase_margin"):
        assert rows[0.0, 0.0][name] > rows[1e-3, 0.0][name] > rows[2e-3, 0.0][name] > rows[10e-3, 0.0][name]
        assert rows[1e-3, 0.0][name] > rows[1e-3, 2e-3][name] > rows[1e-3, 10e-3][name]


def test_a_short_sample_is_nearly_no_sample():
    nearly, continuous = margins(sampled_loop(LOOP, 1e-5, 0.0)), margins(open_loop(LOOP))
    assert nearly["gain_margin"] == pytest.approx(continuous["gain_margin"], abs=0.01)
    assert nearly["phase_margin"] == pytest.approx(continuous["phase_margin"], abs=0.05)


def test_a_delay_costs_the_phase_that_passes_in_it():
    # at the same crossover: 2 ms at 61.6 rad/s
    early, late = (margins(sampled_loop(LOOP, 1e-3, delay))["phase_margin"] for delay in (0.0, 2e-3))
    assert early - late == pytest.approx(math.degrees(61.6 * 2e-3), rel=0.02)


def test_a_fixed_gain_loses_margin_with_the_speed_and_a_scheduled_one_keeps_it():
    fixed, scheduled = (compute(LOOP)["over_speed"][name] for name in ("fixed", "scheduled"))
    # 6 dB for each doubling of the speed, which is the loop's gain
    assert [row["gain_margin"] for row in fixed] == pytest.approx([16.6, 10.6, 4.6], abs=0.05)
    assert [row["bandwidth"] for row in fixed] == pytest.approx([6.6, 21.0, 39.3], abs=0.1)
    assert [row["gain"] for row in scheduled] == pytest.approx([120, 60, 30])
    for row in scheduled:
        for name in ("gain_margin", "phase_margin", "bandwidth"):
            assert row[name] == pytest.approx(fixed[1][name], rel=1e-3)


@pytest.mark.parametrize(("share", "is_stable"), [(0.95, True), (1.05, False)])
def test_the_running_control_unit_loses_stability_where_its_gain_margin_ends(share, is_stable, tmp_path):
    margin = margins(sampled_loop(LOOP, 10e-3, 10e-3))["gain_margin"]
    gain = share * LOOP.gain * 10 ** (margin / 20)
    (tmp_path / "small.yaml").write_text(
        "title: Small step\ndescription: Two hundredths of a degree.\nrig: bench\nduration: 2.5 s\n"
        "manoeuvre: {kind: bar_command, command: {join: step, knots: [[0 s, 0.02 deg]]}}\n"
    )
    run = drive(
        tmp_path / "small.yaml", f"actuator.control.loop.gain={gain} 1/rad", "controller.unit.sample_time=10 ms",
        "controller.unit.delay=10 ms", "actuator.front.motor.coulomb_friction=0 Nm",
    )  # fmt: skip
    angle = np.abs(run["front.bar.angle"] - np.median(run["front.bar.angle"][run.time > 1.5]))
    early, late = (angle[(run.time > start) & (run.time < start + 0.5)].max() for start in (0.5, 2.0))
    assert (late < early) == is_stable
