"""The control unit: delays exact to the step, values held from sample to sample, and timings that it refuses."""

import mujoco
import numpy as np
import pytest
from bench import bench, drive
from records import filled

from ars_mujoco.bridge.callback import installed
from ars_mujoco.bridge.world import view
from ars_mujoco.control.control_unit import (
    COMMAND_LINE,
    DELAY_LINE,
    SLOTS,
    BarCommand,
    ControlUnit,
    arrive_late,
    arrive_now,
    by_angle,
    by_torque,
    check_timing,
    delayed,
    samples_now,
)
from ars_mujoco.schema.errors import InputError

STEP = 1e-3


def unit(sample_time="0 s", delay="0 s"):
    return ControlUnit(sample_time=sample_time, delay=delay)


@pytest.mark.parametrize("steps", [0, 1, 10, SLOTS - 1])
def test_an_output_leaves_the_delay_line_exactly_its_delay_later(steps):
    record, line = filled(unit(delay=f"{steps} ms")), np.zeros(1, DELAY_LINE).view(np.recarray)[0]
    pushed = np.arange(1.0, 201.0)
    left = np.array([delayed(record, line, value, -2.0 * value, STEP) for value in pushed])
    assert np.array_equal(left[steps:, 0], pushed[: 200 - steps])
    assert np.array_equal(left[:, 1], -2.0 * left[:, 0])
    assert not np.any(left[:steps])


def arrived(steps, asked):
    """What arrives of BarCommands (front, rear), given one pair a step to a unit of that delay."""
    record, lines, found = filled(unit(delay=f"{steps} ms")), np.zeros(2, COMMAND_LINE).view(np.recarray), []
    for front, rear in asked:
        lines.values[1] = np.nan  # what the step after holds counts for nothing
        found.append(arrive_late(record, lines[0], lines[1], front, rear, STEP))
        lines[0] = lines[1]
    return found


def asked(count):
    """Pairs of parabolas and torques, of which no two numbers are alike."""
    pairs = np.arange(1.0, 8 * count + 1).reshape(count, 2, 4)
    return [tuple(BarCommand(tuple(each[:3]), each[3]) for each in pair) for pair in pairs.tolist()]


@pytest.mark.parametrize("steps", [1, 10, SLOTS - 1])
def test_commands_arrive_exactly_their_delay_later_by_what_they_begin_with(steps):
    commands = asked(200)
    found = arrived(steps, commands)
    for late, command in zip(found[steps:], commands[: 200 - steps], strict=True):
        assert late == tuple(BarCommand((each.angle[0], 0.0, 0.0), each.torque) for each in command)
    assert found[:steps] == [(BarCommand((0.0, 0.0, 0.0), 0.0),) * 2] * steps


def test_without_a_delay_the_whole_parabola_arrives():
    commands = asked(5)
    assert arrived(0, commands) == commands


def test_what_runs_in_the_unit_gets_its_commands_at_once_whatever_the_delay():
    ((front, rear),) = asked(1)
    assert arrive_now(filled(unit(delay="7 ms")), None, None, front, rear, STEP) == (front, rear)


def test_a_commands_delay_is_kept_in_the_step_after_alone():
    """So that a second call in the same step, as mj_forward makes it, finds the same."""
    record, (now, later) = filled(unit(delay="3 ms")), np.zeros(2, COMMAND_LINE).view(np.recarray)
    ((front, rear),) = asked(1)
    assert arrive_late(record, now, later, front, rear, STEP) == arrive_late(record, now, later, front, rear, STEP)
    assert now.head == 0.0 and not now.values.any()
    assert later.head == 1.0


@pytest.mark.parametrize("twist", [-0.1, 0.0, 0.03])
def test_an_angle_and_the_torque_of_the_bars_torsion_are_one_command(twist):
    stiffness, angle = 5700.0, (0.05, 1.0, 2.0)
    command = by_angle(stiffness, angle, twist)
    assert command.angle == angle
    assert command.torque == pytest.approx(stiffness * (0.05 - twist), rel=1e-15)
    back = by_torque(stiffness, command.torque, twist)
    assert back.torque == command.torque
    assert back.angle == pytest.approx((0.05, 0.0, 0.0), rel=1e-14)


def sample_steps(sample_time, count):
    """The steps in which a unit samples, at the times as MuJoCo adds them up."""
    record, times = filled(unit(sample_time)), np.cumsum(np.full(count, STEP)) - STEP
    return [i for i, time in enumerate(times) if samples_now(record, time, STEP)]


def test_a_unit_samples_at_multiples_of_its_sample_time_however_long_it_runs():
    assert sample_steps("5 ms", 30_000) == list(range(0, 30_000, 5))


@pytest.mark.parametrize("sample_time", ["0 s", "1 ms"])
def test_a_continuous_unit_and_one_as_fast_as_the_step_compute_always(sample_time):
    assert sample_steps(sample_time, 20) == list(range(20))


def test_a_late_command_gives_the_same_run_exactly_the_delay_later():
    prompt, late = drive("bench_step_1deg"), drive("bench_step_1deg", "controller.unit.delay=7 ms")
    for name in ("front.bar.angle", "front.motor.pressure", "front.pump.stroke"):
        assert late[name][7:] == pytest.approx(prompt[name][:-7], rel=1e-9)
        assert not np.any(late[name][:8])


@pytest.mark.parametrize("delay", [0, 1, 7])
def test_a_sampling_units_stroke_command_comes_the_delay_later(delay):
    late = drive("bench_step_1deg", "controller.unit.sample_time=2 ms", f"controller.unit.delay={delay} ms")
    assert np.flatnonzero(late["front.pump.stroke"])[0] == delay + 1


def test_a_sampling_unit_holds_its_stroke_command_between_samples():
    simulation = bench("bench_step_1deg", "controller.unit.sample_time=5 ms")
    data, strokes, angles = simulation.start(), [], []
    with installed(simulation.rig, simulation.model, data):
        for _ in range(100):
            mujoco.mj_step(simulation.model, data)
            world = view(data, simulation.rig.WORLD)
            strokes.append(float(world.later.system.front_stroke))
            angles.append(float(world.now.system.front.circuit.angle))
    wanted = np.clip(60.0 * (np.radians(1.0) - np.array(angles)), -1, 1)
    assert strokes == pytest.approx(np.repeat(wanted[::5], 5), abs=1e-12)
    assert len(set(strokes)) > 10


@pytest.mark.parametrize("timing", [{"sample_time": "2 ms", "delay": "10 ms"}, {"delay": f"{SLOTS - 1} ms"}, {}])
def test_whole_steps_are_accepted(timing):
    check_timing(unit(**timing), STEP)


@pytest.mark.parametrize(
    ("timing", "message"),
    [
        ({"sample_time": "1.5 ms"}, "unit.sample_time: 0.0015 s is not a whole multiple of the time step 0.001 s"),
        ({"delay": "0.2 ms"}, "unit.delay: 0.0002 s is not a whole multiple of the time step 0.001 s"),
        ({"delay": f"{SLOTS} ms"}, "unit.delay: 0.064 s is too long; allowed: less than 0.064 s"),
    ],
)
def test_other_times_are_refused(timing, message):
    with pytest.raises(InputError, match=message.replace(".", r"\.")):
        check_timing(unit(**timing), STEP)
