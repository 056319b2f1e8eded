"""Compensators: futile on the stabilizer, whose pump control is too slow for its hydraulics, not on a robot's joint."""

import math
from dataclasses import replace

import control
import numpy as np
import pytest
from bench import drive
from theory import LOOP

from ars_mujoco.analysis import compensators
from ars_mujoco.analysis.compensators import (
    at_ratio,
    behind_unit,
    compensated,
    fed_back,
    hydraulic_pair,
    lag,
    least_damping,
    most_bandwidth,
    most_damping,
    moving_and_held,
    pole_compensator,
    pressure_feedback,
    settings,
)
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.loop import loop_of
from ars_mujoco.analysis.margins import margins
from ars_mujoco.studies.inputs import read_inputs

ROBOT = loop_of(read_inputs("robot_step"))
OWN = read_inputs("robot_step")
SMOOTH = "actuator.front.motor.coulomb_friction=0 Nm"
OFF = "actuator.control.pressure_feedback.gain=0 1/bar"


def best(loop, sign=1.0, **timing):
    return most_damping(moving_and_held(loop, **timing), *settings(loop, sign))


def bandwidths(loop, **timing):
    """(without, with pressure feedback, with the second-order compensator), Hz."""
    system, (gains, corners) = behind_unit(loop, **timing), settings(loop)
    without, with_feedback = (
        most_bandwidth(loop, system, some, corners)["bandwidth"] for some in (gains[:1], gains[::2])
    )
    return without, with_feedback, compensated(loop, system)["bandwidth"]


def test_one_pump_control_meets_two_hydraulics():
    assert hydraulic_pair(LOOP) == pytest.approx((834.0, 0.0603), rel=1e-2)
    assert hydraulic_pair(ROBOT) == pytest.approx((45.2, 0.0540), rel=1e-2)
    assert lag(LOOP) == pytest.approx(228, abs=1)
    assert lag(ROBOT) == pytest.approx(18, abs=1)


@pytest.mark.parametrize("timing", [{}, {"sample_time": 1e-3}])
def test_no_pressure_feedback_damps_the_stabilizer(timing):
    assert best(LOOP, **timing)["damping"] == pytest.approx(hydraulic_pair(LOOP)[1], rel=1e-6)


@pytest.mark.parametrize(
    ("timing", "damping"),
    [
        ({}, 0.6),
        ({"sample_time": 1e-3}, 0.6),
        ({"sample_time": 10e-3}, 0.5),
        ({"sample_time": 10e-3, "delay": 10e-3}, 0.3),
    ],
)
def test_pressure_feedback_damps_the_robot_s_joint_also_where_the_unit_is_slow_and_late(timing, damping):
    assert best(ROBOT, **timing)["damping"] > damping


def test_pressure_feedback_damps_where_a_stroke_lags_less_than_a_quarter_turn():
    # a weak feedback moves the damping by the cosine of the lag; an ideal pump has none
    for ratio in (0.3, 0.6, 0.9, 1.2, 1.5, 3.0, 6.0):
        loop = at_ratio(LOOP, ratio)
        (_, gains), frequency = (settings(loop)[0][:2], hydraulic_pair(loop)[0])
        weak = pressure_feedback(0.1 * gains, 1e-3 * frequency)
        poles = fed_back(actuator(loop), weak).poles()
        pole = poles[np.argmin(np.abs(poles - 1j * frequency))]
        moved = -pole.real / abs(pole) - hydraulic_pair(loop)[1]
        assert np.sign(moved) == np.sign(math.cos(math.radians(lag(loop))))


def test_at_450_rad_s_a_pump_control_twice_as_fast_gains():
    slow = LOOP.at({"capacitance": compensators.SLOW_HYDRAULICS, "leakage": 1.2e-12})
    assert hydraulic_pair(slow)[0] == pytest.approx(450, abs=1)
    system = actuator(at_ratio(slow, 2.0 * 280.0 / 450.0))
    closed = control.ss(system.A - LOOP.gain * system.B @ system.C[:1], system.B, system.C, 0.0)
    assert least_damping(closed.poles()) == pytest.approx(0.136, abs=1e-3)
    assert most_damping([closed], *settings(slow))["damping"] == pytest.approx(0.30, abs=0.02)


def test_a_sign_turned_round_damps_the_stabilizer_s_motor_as_it_moves_and_shakes_it_as_dry_friction_holds_it():
    moving, held = moving_and_held(LOOP, sample_time=1e-3)
    found = most_damping([moving], *settings(LOOP, -1.0))
    assert found["damping"] > 0.2
    feedback = pressure_feedback(found["gain"], found["corner"], 1e-3)
    assert np.abs(fed_back(held, feedback).poles()).max() > 1.2
    assert best(LOOP, -1.0, sample_time=1e-3)["damping"] < 0.09
    assert best(LOOP, -1.0, sample_time=1e-3, delay=10e-3)["damping"] < 0.0604


def test_the_stabilizer_gains_bandwidth_by_its_bar_alone():
    # held by the bar, the motor's pressure follows its angle: the high-pass makes it a lead
    for loop, gained in ((LOOP, 1.03), (replace(LOOP, stiffness=0.0), 1.0)):
        without, with_feedback, _ = bandwidths(loop)
        assert gained < with_feedback / without < gained + 0.03


def test_the_second_order_compensator_gains_the_stabilizer_nothing():
    without, _, with_compensator = bandwidths(LOOP)
    assert 0.98 * without < with_compensator < without


def test_both_gain_the_robot_s_joint_more_than_ten_times_the_bandwidth():
    without, with_feedback, with_compensator = bandwidths(ROBOT)
    assert min(with_feedback, with_compensator) > 10.0 * without


def test_the_compensator_hides_the_poles_and_damps_nothing():
    frequency, damping = hydraulic_pair(ROBOT)
    behind = actuator(ROBOT)["angle", "stroke_command"] * pole_compensator(frequency, damping, 0.5)
    assert least_damping(control.ss(behind).poles()) == pytest.approx(damping, rel=1e-6)
    peak = abs(behind(1j * frequency)) / abs(behind(0.1j * frequency))
    assert peak < 0.2 < abs(actuator(ROBOT)["angle", "stroke_command"](1j * frequency) / behind(0.1j * frequency))


def kept_margins(system, gain, feedback):
    """Margins of the bar-angle loop with `gain` and of the pressure feedback, cut at the stroke command."""
    of_angle = control.ss([], [], [], [[gain, 0.0]], system.dt)
    return margins((of_angle + control.ss(feedback) * np.array([[0.0, 1.0]])) * system)


@pytest.mark.parametrize("loop", [LOOP, ROBOT])
@pytest.mark.parametrize("timing", [{}, {"sample_time": 1e-3, "delay": 2e-3}])
def test_the_found_loop_keeps_6_db_and_45_deg_and_no_more(loop, timing):
    system = behind_unit(loop, **timing)
    found = most_bandwidth(loop, system, *(each[::4] for each in settings(loop)))
    kept = kept_margins(system, found["loop_gain"], pressure_feedback(found["gain"], found["corner"], system.dt))
    assert kept["is_stable"]
    assert kept["gain_margin"] > 5.9
    assert kept["phase_margin"] > 44.5
    assert kept["gain_margin"] < 6.2 or kept["phase_margin"] < 46.0


def test_the_shipped_controller_of_the_robot_s_joint_keeps_the_margins():
    loop, timing = OWN.actuator.value.control, OWN.controller.value.unit.sample_time
    own = loop.pressure_feedback
    kept = kept_margins(behind_unit(ROBOT, timing), loop.loop.gain, pressure_feedback(own.gain, own.corner, timing))
    assert kept["is_stable"]
    assert kept["gain_margin"] > 6.0
    assert kept["phase_margin"] > 45.0


@pytest.mark.parametrize("timing", [{}, {"sample_time": 2e-3, "delay": 2e-3}])
def test_the_dampings_are_those_of_the_loops_that_python_control_closes(timing):
    found, systems = best(ROBOT, **timing), moving_and_held(ROBOT, **timing)
    feedback = pressure_feedback(found["gain"], found["corner"], systems[0].dt)
    closed = [least_damping(fed_back(system, feedback).poles(), system.dt) for system in systems]
    assert min(closed) == pytest.approx(found["damping"], rel=1e-6)


def linear_step(loop, gain, feedback, sample_time, count):
    """(angle, pressure) at each sample after a unit step of the command."""
    system = behind_unit(loop, sample_time, 0.0)
    inner = fed_back(system, feedback)
    closed = control.feedback(gain * inner, np.array([[1.0, 0.0]]))
    return control.step_response(closed, np.arange(count) * sample_time).y[:, 0]


@pytest.mark.parametrize(
    ("cycle", "loop", "gain", "feedback"),
    [("robot_step", ROBOT, 0.9, (5e-9, 12.0)), ("bench_step_1deg", LOOP, 60.0, (7e-7, 500.0))],
)
def test_the_running_code_does_what_the_linear_theory_says(cycle, loop, gain, feedback):
    run = drive(
        cycle, "manoeuvre.command.knots=[[0 s, 0.05 deg]]", SMOOTH, "duration=0.6 s",
        "controller.unit.sample_time=1 ms", f"actuator.control.loop.gain={gain} 1/rad",
        f"actuator.control.pressure_feedback.gain={feedback[0]} 1/Pa",
        f"actuator.control.pressure_feedback.corner={feedback[1]} rad/s",
    )  # fmt: skip
    wanted = np.radians(0.05) * linear_step(loop, gain, pressure_feedback(*feedback, 1e-3), 1e-3, len(run.time))
    for name, expected in zip(("front.bar.angle", "front.motor.pressure"), wanted, strict=True):
        np.testing.assert_allclose(run[name], expected, atol=5e-3 * np.abs(expected).max())


def decay(run) -> float:
    """Damping ratio that the robot's pressure rings down with, by the logarithmic decrement of its turns."""
    pressure = run["front.motor.pressure"]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(pressure)))) + 1
    swings = np.abs(np.diff(pressure[turns]))[2:8]
    decrement = -np.polyfit(np.arange(len(swings)), np.log(swings), 1)[0] / math.pi
    return decrement / math.hypot(1.0, decrement)


@pytest.mark.parametrize("gain", [0.0, 2e-9])
def test_the_ringing_dies_away_as_predicted(gain):
    run = drive(
        "robot_step", "manoeuvre.command.knots=[[0 s, 0.05 deg]]", SMOOTH, "duration=1 s",
        "actuator.control.loop.gain=0.2 1/rad", f"actuator.control.pressure_feedback.gain={gain} 1/Pa",
    )  # fmt: skip
    inner = fed_back(behind_unit(ROBOT, 1e-3), pressure_feedback(gain, 12.0, 1e-3))
    poles = control.feedback(0.2 * inner, np.array([[1.0, 0.0]])).poles()
    assert decay(run) == pytest.approx(least_damping(poles, 1e-3), rel=0.03)


def test_the_robot_s_joint_settles_with_its_feedback_and_swings_on_without():
    calm, wild = drive("robot_step"), drive("robot_step", OFF)
    late = calm.time > 1.0
    assert np.degrees(calm["front.bar.angle"].max()) < 5.05
    assert np.ptp(np.degrees(calm["front.bar.angle"][late])) < 0.05
    assert np.ptp(np.degrees(wild["front.bar.angle"][late])) > 1.0


def test_the_stabilizer_settles_without_feedback_and_not_with_its_sign_turned_round():
    found = most_damping([behind_unit(LOOP, 1e-3)], *settings(LOOP, -1.0))
    feedback = (
        f"actuator.control.pressure_feedback.gain={found['gain']} 1/Pa",
        f"actuator.control.pressure_feedback.corner={found['corner']} rad/s",
    )
    calm, wild = (drive("bench_step_1deg", "controller.unit.sample_time=1 ms", *more) for more in ((), feedback))
    late = calm.time > 0.4
    assert np.ptp(np.degrees(calm["front.bar.angle"][late])) < 0.01
    assert np.ptp(np.degrees(wild["front.bar.angle"][late])) > 0.3


def test_the_result_has_both_actuators_and_every_timing(monkeypatch):
    monkeypatch.setattr(compensators, "GAINS", compensators.GAINS[::8])
    monkeypatch.setattr(compensators, "CORNERS", compensators.CORNERS[::4])
    monkeypatch.setattr(compensators, "RATIOS", compensators.RATIOS[::6])
    result = compensators.compute(LOOP)
    for found in result["actuators"].values():
        assert len(found["rows"]) == 9
    too_slow = [row["sample_time"] for row in result["actuators"]["this"]["rows"] if row["compensator"] is None]
    assert set(too_slow) == {5e-3, 10e-3}
    assert result["all_corners"][0]["as_drawn"]["damping"] == pytest.approx(
        result["all_corners"][0]["without"]["damping"], rel=1e-6
    )
    assert len(compensators.headline(result)) == 15
