"""The bench as a tool: its ends moved by any input, its motor commanded, held or free, against closed forms."""

import math
from pathlib import Path

import numpy as np
import pytest
import yaml
from bench import STIFFNESS, bench, circuit, drive
from scipy.integrate import solve_ivp

from ars_mujoco.analysis.frequency_response import measured
from ars_mujoco.analysis.loop import loop_of
from ars_mujoco.excitation.excitation import ExcitationOf, value
from ars_mujoco.hydraulics.vane_motor import friction_torque
from ars_mujoco.metrics.energy import energy_audit_error
from ars_mujoco.metrics.metric import Run
from ars_mujoco.rigs.bench import parabola
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs

ARM = 0.15  # m
STEP = 1e-3  # s
FRICTION = {"coulomb_friction": "Nm", "viscous_friction": "Nms/rad"}
ENDS = {
    "step": "{join: step, knots: [[0 s, 0 mm], [0.1 s, 20 mm], [0.3004 s, -15 mm]]}",
    "knots": "{join: linear, knots: [[0 s, 0 mm], [0.0305 s, 20 mm], [0.3 s, -20 mm], [0.4 s, 0 mm]]}",
    "sine": "{sine: {amplitude: 20 mm, frequency: 5 Hz}}",
    "sweep": "{sweep: {amplitude: 10 mm, first_frequency: 1 Hz, last_frequency: 20 Hz, duration: 0.5 s}}",
    "recorded": "{recorded: travel.csv}",
}
COMMANDS = {
    "step": "{join: step, knots: [[0 s, 0 deg], [0.1004 s, 5 deg], [0.3 s, -5 deg]]}",
    "sine": "{sine: {amplitude: 3 deg, frequency: 5 Hz, phase: 45 deg}}",
    "sweep": "{sweep: {amplitude: 3 deg, first_frequency: 1 Hz, last_frequency: 20 Hz, duration: 0.5 s}}",
    "recorded": "{recorded: angle.csv}",
}


@pytest.fixture(autouse=True)
def tables(tmp_path, monkeypatch):
    """A rough travel and a rough angle in the working directory, uneven in time."""
    monkeypatch.chdir(tmp_path)
    random = np.random.default_rng(3)
    for name, quantity, largest in (("travel", "travel (mm)", 20.0), ("angle", "angle (deg)", 4.0)):
        times, values = np.cumsum(random.uniform(0.001, 0.01, 100)), largest * random.uniform(-1, 1, 100)
        rows = [
            f"{t:.6f},{value:.6f}" for t, value in zip(times, np.convolve(values, np.ones(9) / 9, "same"), strict=True)
        ]
        Path(f"{name}.csv").write_text("\n".join([f"time (s),{quantity}", *rows]))


def moved(motor, ends, *settings, duration=0.6):
    """A run with the ends moved and the motor held or free."""
    return drive(
        "bench_ends_free", f"manoeuvre.motor={motor}", f"manoeuvre.ends={ends}", f"duration={duration} s", *settings
    )


def mean(values):
    """Mean of each step's two ends (n - 1,)."""
    return 0.5 * (values[:-1] + values[1:])


def audit_error(recording):
    return energy_audit_error(Run(recording, (0.0, recording.time[-1]))).value


# ---- held


@pytest.mark.parametrize("form", ENDS)
def test_a_held_motor_is_a_torsion_bar(form):
    run = moved("held", ENDS[form])
    twist, torque = run["front.bar.twist"], run["front.bar.torque"]
    assert np.ptp(twist) > 0.05
    assert twist == pytest.approx(np.arcsin(run["ends.travel"] / ARM), abs=1e-15)
    turned = np.convolve(np.abs(np.diff(twist)), np.ones(3), "same")  # in a step and the two beside it
    assert np.all(np.abs(torque[:-1] / STIFFNESS + mean(twist)) <= turned / 3 + 1e-12)
    assert not {"front.bar.angle", "front.energy.shaft"} & set(run.channels)  # there is no actuator


@pytest.mark.parametrize("form", ENDS)
def test_the_work_on_a_held_bar_is_stored_in_it(form):
    run = moved("held", ENDS[form])
    stored = 0.5 * STIFFNESS * run["front.bar.twist"] ** 2
    assert run["front.energy.bar"] == pytest.approx(stored, abs=1e-9)
    assert run["front.energy.work"] == pytest.approx(stored[0] - stored, abs=1e-9)


@pytest.mark.parametrize("frequency", [5.0, 60.0])
def test_the_mean_torque_of_each_step_is_that_of_a_sine(frequency):
    omega, travel = 2 * np.pi * frequency, 1e-4
    run = moved("held", f"{{sine: {{amplitude: 0.1 mm, frequency: {frequency} Hz}}}}")
    mean_twist = -np.diff(np.cos(omega * run.time)) / (omega * STEP) * travel / ARM
    apart = np.abs(run["front.bar.torque"][:-1] + STIFFNESS * mean_twist).max() / (STIFFNESS * travel / ARM)
    assert apart < (omega * STEP) ** 4 / 2880 + 1e-6  # Simpson's rule


# ---- free


@pytest.mark.parametrize("form", ["knots", "sine", "sweep"])
def test_a_free_motor_follows_newtons_law(form):
    motor, ends = circuit().motor, ExcitationOf("m")(**yaml.load(ENDS[form], yaml.BaseLoader))
    excitation, samples = ends.record(), ends.samples()

    def rate(t, state):
        angle, speed = state
        torque = STIFFNESS * (angle - np.arcsin(value(excitation, samples, t) / ARM))
        return speed, -(torque + friction_torque(motor, speed)) / motor.inertia

    run = moved("free", ENDS[form])
    exact = solve_ivp(
        rate, (0.0, 0.6), (0.0, 0.0), "Radau", run.time.clip(max=0.6), rtol=1e-9, atol=1e-10, max_step=2e-3
    )
    for channel, expected in zip(("front.bar.angle", "front.motor.rate"), exact.y, strict=True):
        apart = np.abs(run[channel] - expected).max() / np.abs(expected).max()
        print(f"{form}: {channel} {100 * apart:.3f} %")
        assert apart < 5e-3


def test_a_free_motor_without_friction_swings_as_an_undamped_oscillator():
    frictionless = [f"actuator.front.motor.{name}=0 {unit}" for name, unit in FRICTION.items()]
    run = moved("free", "{sine: {amplitude: 1 mm, frequency: 5 Hz}}", *frictionless)
    natural, driven = np.sqrt(STIFFNESS / 0.175), 2 * np.pi * 5.0
    ratio = driven / natural
    swing = 1e-3 / ARM / (1 - ratio**2) * (np.sin(driven * run.time) - ratio * np.sin(natural * run.time))
    assert np.abs(run["front.bar.angle"] - swing).max() < 1e-3 * np.abs(swing).max()


def test_a_free_motor_moved_slowly_passes_on_its_friction_alone():
    run, motor = moved("free", "{sine: {amplitude: 40 mm, frequency: 0.2 Hz}}", duration=5), circuit().motor
    friction = mean(np.array([friction_torque(motor, rate) for rate in run["front.motor.rate"]]))
    inertia = motor.inertia * np.diff(run["front.motor.rate"]) / STEP
    settled, torque = run.time[:-1] > 0.2, run["front.bar.torque"][:-1]
    assert torque[settled] == pytest.approx(-(friction + inertia)[settled], abs=0.5)
    assert np.abs(inertia[settled]).max() < 3.0 < 35.0 < np.abs(torque[settled]).max() < 35.0 + 16.5 * 0.4
    assert not np.any(run["front.motor.pressure"]) and not np.any(run["front.pump.stroke"])
    assert not np.any(run["front.bar.command"])


# ---- commanded


def test_a_motor_that_is_commanded_to_stay_bears_the_torque_of_the_twist():
    run = drive("bench_recorded")
    angle, twist = run["front.bar.angle"], run["front.bar.twist"]
    torque = STIFFNESS * (mean(angle) - mean(twist))
    assert run["front.bar.torque"][:-1] == pytest.approx(torque, abs=1e-3 * np.abs(torque).max())
    print(f"the angle strays by {np.degrees(np.abs(angle).max()):.2f} of {np.degrees(np.abs(twist).max()):.2f} deg")
    assert np.abs(angle).max() < 0.2 * np.abs(twist).max()


@pytest.mark.parametrize("frequency", [2.0, 8.0])
def test_the_response_to_a_sine_is_that_of_the_analysis(frequency):
    run = drive("bench_sine", f"manoeuvre.command.sine.frequency={frequency} Hz")
    late = (run.time >= 1.0) & (run.time < 2.999)  # whole periods
    turning = np.exp(-2j * np.pi * frequency * run.time[late])
    response = 2j * np.mean(run["front.bar.angle"][late] * turning) / np.radians(1.0)
    (expected,) = measured(loop_of(read_inputs("bench_sine")), np.radians(1.0), np.array([frequency]))
    assert abs(response / expected - 1.0) < 2e-3


def test_the_parabola_of_a_sine_of_60_hz_is_within_half_a_thousandth():
    frequency = 60.0
    command = ExcitationOf("rad")(sine={"amplitude": "1 rad", "frequency": f"{frequency} Hz"})
    excitation, samples = command.record(), command.samples()
    error, within = 0.0, np.linspace(0.0, STEP, 21)
    for start in np.linspace(0.1, 0.1 + 1 / frequency, 97):
        c0, c1, c2 = parabola(excitation, samples, start, STEP)
        sine = np.sin(2 * np.pi * frequency * (start + within))
        error = max(error, np.abs(c0 + within * (c1 + within * c2) - sine).max())
    bound = (2 * np.pi * frequency * STEP) ** 3 / (72 * np.sqrt(3))  # of the parabola through three even points
    print(f"{error:.2e} of the amplitude")
    assert 0.9 * bound < error < 1.1 * bound < 5e-4


def test_a_step_between_two_physics_steps_lies_between_steps_at_them():
    early, between, late = (
        drive("bench_step_1deg", f"manoeuvre.command.knots=[[0 s, 0 deg], [{start} s, 1 deg]]", "duration=0.3 s")
        for start in (0.1, 0.1005, 0.101)
    )
    rising = early["front.bar.angle"] < np.radians(0.9)
    angles = [run["front.bar.angle"][rising] for run in (late, between, early)]
    assert np.all(np.diff(angles, axis=0) >= -1e-6)
    assert between["front.bar.angle"][-1] == pytest.approx(early["front.bar.angle"][-1], rel=1e-4)


def test_a_recorded_sine_drives_the_bench_like_the_sine():
    times = np.arange(0.0, 1.0005, 0.002)
    rows = [f"{t!r},{math.sin(2 * np.pi * 5 * t)!r}" for t in times.tolist()]
    Path("sine.csv").write_text("\n".join(["time (s),angle (deg)", *rows]))
    forms = "{recorded: sine.csv}", "{sine: {amplitude: 1 deg, frequency: 5 Hz}}"
    recorded, exact = (drive("bench_sine", f"manoeuvre.command={form}", "duration=1 s") for form in forms)
    interpolation = np.radians(1.0) * 0.002**2 / 8 * (2 * np.pi * 5) ** 2
    assert np.abs(recorded["front.bar.command"] - exact["front.bar.command"]).max() < 1.01 * interpolation
    assert np.abs(recorded["front.bar.angle"] - exact["front.bar.angle"]).max() < 2 * interpolation


# ---- energy


@pytest.mark.parametrize("form", ENDS)
@pytest.mark.parametrize("motor", ["commanded", "free"])
def test_no_energy_goes_astray_however_the_ends_move(motor, form):
    settings = ["manoeuvre.command.knots=[[0 s, 0 deg]]"] if motor == "commanded" else []
    run = moved(motor, ENDS[form], *settings)
    print(f"{motor}, {form}: {100 * audit_error(run):.5f} %")
    assert audit_error(run) < 1e-3


@pytest.mark.parametrize("form", COMMANDS)
def test_no_energy_goes_astray_whatever_is_commanded(form):
    run = drive("bench_sine", f"manoeuvre.command={COMMANDS[form]}", f"manoeuvre.ends={ENDS['sine']}", "duration=0.6 s")
    print(f"{form}: {100 * audit_error(run):.5f} %")
    assert audit_error(run) < 1e-3


# ---- refusals


@pytest.mark.parametrize(
    "ends",
    [
        "{sine: {amplitude: 100 mm, offset: 50 mm, frequency: 1 Hz}}",
        "{sweep: {amplitude: -150 mm, first_frequency: 1 Hz, last_frequency: 2 Hz, duration: 1 s}}",
        "{knots: [[0 s, 0 m], [1 s, -0.15 m]]}",
        "{recorded: far.csv}",
    ],
)
def test_ends_further_apart_than_the_arm_is_long_are_refused(ends):
    Path("far.csv").write_text("time (s),travel (mm)\n0,0\n1,-150\n")
    with pytest.raises(InputError) as error:
        bench("bench_ends_free", f"manoeuvre.ends={ends}")
    assert str(error.value) == "manoeuvre.ends: a travel of 0.15 m is too far; allowed: less than the arm's 0.15 m"
