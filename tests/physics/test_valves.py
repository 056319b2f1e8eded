"""The switching valves of the full circuit in a run: the fail-safe valve shut, the bypass open."""

import numpy as np
import pytest
import shipped
from detailed import ACTUATORS

BAR = 1e5
SWITCHED = 0.3  # s, by when the motor has reached its 10 deg
STROKE_TIME = 0.02  # s, of both valves


def run(**commands):
    """The step to 10 deg with valves commanded from SWITCHED on."""
    settings = [
        f"inputs.front_{valve}={{join: step, knots: [[0 s, {before}], [{SWITCHED} s, {after}]]}}"
        for valve, (before, after) in commands.items()
    ]
    recording = shipped.recording("bench_step_10deg", ACTUATORS["full"], *settings)
    return recording, recording.time > SWITCHED + 1.5 * STROKE_TIME


def test_a_valve_takes_its_stroke_time():
    recording, _ = run(bypass=(0.0, 1.0))
    opening = recording["front.valve.bypass"]
    half = np.interp(SWITCHED + 0.5 * STROKE_TIME, recording.time, opening)
    assert abs(half - 0.5) < 0.02
    assert opening[-1] > 0.999


def test_the_shut_fail_safe_valve_holds_the_motor_but_for_its_leakage():
    recording, shut = run(fail_safe=(1.0, 0.0))
    angle, dp = recording["front.bar.angle"][shut], recording["front.motor.pressure"][shut]
    assert recording["front.valve.fail_safe"][-1] < 0.05
    assert np.degrees(np.ptp(angle)) < 0.5
    # what leaks past the vane, 1.75e-13 m^3/s/Pa, and what the trapped oil gives as its pressure falls
    assert np.all(np.diff(angle) < 0.0)
    leaked = 1.75e-13 * np.trapezoid(dp, dx=1e-3)
    turned = 5.24e-4 / (2 * np.pi) * (angle[0] - angle[-1])
    assert turned < 1.2 * leaked
    assert np.abs(recording["front.energy.line"][-1] - recording["front.energy.line"][shut][0]) < 1e-2


def test_an_open_bypass_lets_the_bar_turn_the_motor_back_within_a_tenth_of_a_second():
    recording, _ = run(bypass=(0.0, 1.0))
    late, settled = recording.time > SWITCHED + 0.1, recording.time > SWITCHED + 0.15
    assert np.degrees(recording["front.bar.angle"][recording.time < SWITCHED][-1]) > 9.9
    assert np.degrees(np.abs(recording["front.bar.angle"][late])).max() < 0.1
    assert np.abs(recording["front.motor.pressure"][settled]).max() < 0.1 * BAR
    assert recording["front.energy.bypass"][-1] > 30.0  # of the 87 J in the bar


def test_a_bypass_lets_60_litres_a_minute_of_the_motor_past_at_10_bar():
    """As the bar turns the motor back, flow and pressure difference lie on the orifice's curve."""
    recording, _ = run(bypass=(0.0, 1.0))
    dp, opening = recording["front.motor.pressure"], recording["front.valve.bypass"]
    flow = opening * 1e-3 * dp / (dp * dp + BAR * BAR) ** 0.25 / (10 * BAR) ** 0.5
    lost = np.cumsum(flow * dp) * 1e-3
    assert recording["front.energy.bypass"][-1] == pytest.approx(lost[-1], rel=0.02)
