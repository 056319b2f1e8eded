"""Which gains are stable, and good, over all of Table 2."""

import math
from dataclasses import replace

import control
import numpy as np
import pytest
from theory import CORNERS, LOOP

from ars_mujoco.analysis import stable_region
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.margins import margins
from ars_mujoco.analysis.parameter_box import TABLE_2
from ars_mujoco.analysis.stable_region import boundary, bounds, critical_gain, gain_for_bandwidth

RESULT = stable_region.compute(LOOP)


def system(loop):
    return actuator(loop)["angle", "stroke_command"]


def test_a_fixed_gain_is_stable_at_all_corners_under_95_8():
    assert RESULT["fixed"]["stable"] == pytest.approx(95.8, abs=0.05)


def test_without_the_bar_it_is_88_9():
    assert RESULT["without_bar"]["stable"] == pytest.approx(88.9, abs=0.05)


def test_6_db_and_45_deg_everywhere_need_a_gain_under_48_but_12_hz_needs_90():
    fixed = RESULT["fixed"]
    assert min(fixed["gain_margin"], fixed["phase_margin"]) == pytest.approx(48, abs=0.1)
    assert fixed["wanted_bandwidth"] == pytest.approx(90, abs=0.5)


def test_a_gain_that_goes_with_1_over_n_does_both():
    scheduled = RESULT["scheduled"]
    assert scheduled["wanted_bandwidth"] < LOOP.angle_loop.gain
    assert LOOP.angle_loop.gain < min(scheduled["gain_margin"], scheduled["phase_margin"])


def test_the_fastest_pump_sets_the_limit():
    worst = min(RESULT["corners"], key=lambda each: each["stable"])
    assert worst["corner"]["speed"] == TABLE_2["speed"][1]


def test_speed_is_what_moves_the_boundary_and_friction_in_the_motor_hardly_does():
    spread = {name: max(gains) / min(gains) for name, gains in RESULT["over_each"].items()}
    assert spread.pop("speed") == pytest.approx(4.0, rel=1e-6)
    assert max(spread.values()) < 1.1


@pytest.mark.parametrize("loop", CORNERS[::5])
def test_at_the_boundary_the_closed_loop_has_roots_on_the_imaginary_axis(loop):
    for gain, frequency in boundary(system(loop)):
        poles = control.feedback(gain * system(loop)).poles()
        assert np.abs(poles - 1j * frequency).min() < 1e-6 * frequency


@pytest.mark.parametrize("loop", CORNERS)
def test_the_loop_is_stable_just_under_the_boundary_and_not_over_it(loop):
    gain = critical_gain(loop)
    assert np.all(control.feedback(0.999 * gain * system(loop)).poles().real < 0)
    assert np.any(control.feedback(1.001 * gain * system(loop)).poles().real > 0)


@pytest.mark.parametrize("loop", CORNERS[::5])
def test_on_the_gamma_boundaries_the_margins_are_6_db_and_45_deg(loop):
    found = bounds(loop)
    assert margins(found["gain_margin"] * system(loop))["gain_margin"] == pytest.approx(6, abs=1e-3)
    assert margins(found["phase_margin"] * system(loop))["phase_margin"] == pytest.approx(45, abs=1e-3)


@pytest.mark.parametrize("loop", CORNERS[::5])
def test_the_gain_for_a_bandwidth_gives_that_bandwidth(loop):
    gain = gain_for_bandwidth(system(loop), 12.0)
    assert margins(gain * system(loop))["bandwidth"] == pytest.approx(12, rel=1e-4)


def test_inside_the_box_no_loop_is_worse_than_its_worst_corner():
    random = np.random.default_rng(1)
    for shares in random.uniform(size=(300, len(TABLE_2))):
        point = {
            name: low + share * (high - low) for (name, (low, high)), share in zip(TABLE_2.items(), shares, strict=True)
        }
        assert critical_gain(LOOP.at(point)) > RESULT["fixed"]["stable"]


def test_more_speed_takes_as_much_gain_away():
    slow, fast = (critical_gain(LOOP.at({"speed": speed})) for speed in (200.0, 400.0))
    assert slow == pytest.approx(2 * fast, rel=1e-9)


def test_the_bar_steadies_the_loop():
    assert critical_gain(replace(LOOP, stiffness=0.0)) < critical_gain(LOOP)


def test_a_double_lag_behind_an_integrator_turns_unstable_at_the_gain_of_routh():
    # s (s + 1) (s + 2) + K: stable under K = 6, at sqrt(2) rad/s
    classic = control.ss(control.tf([1], [1, 3, 2, 0]))
    assert boundary(classic) == [pytest.approx((6.0, math.sqrt(2.0)))]
