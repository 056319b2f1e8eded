"""The running bench rig against the independent reference: every sample, every power, every energy."""

import numpy as np
import pytest
from bench import STIFFNESS, circuit, drive
from radau import CORNERS, LOSSES, S_CURVE, STEP_1_DEG, STEP_10_DEG, Command, VerificationSet, derivative, solve, step

from ars_mujoco.actuators.pump_controlled.third_order_circuit import rates

NOMINAL = VerificationSet()
REAR = VerificationSet(V_L=4.7e-4, C_0=9.8e-14)
REVERSAL = Command(((0.0, 0.0), (0.02, 0.09), (0.3, 0.09), (0.32, -0.09), (0.6, -0.09)))  # the valve opens fully
STEPS = [("bench_step_1deg", STEP_1_DEG), ("bench_step_10deg", STEP_10_DEG)]
CASES = [
    *[(*each, NOMINAL) for each in (*STEPS, ("bench_s_curve", S_CURVE))],
    *[(*each, corner) for corner in CORNERS for each in STEPS],
]
STATES = {"front.bar.angle": "phi", "front.motor.pressure": "dp", "front.motor.rate": "w", "front.pump.stroke": "X"}
POWERS = {
    "front.pump.shaft_power": "shaft",
    "front.pump.loss_power": "pump_torque_loss",
    "front.pump.leakage_power": "pump_leakage",
    "front.motor.output_power": "motor",
    "front.motor.leakage_power": "motor_leakage",
    "front.motor.friction_power": "friction",
}


def settings(parameters: VerificationSet) -> list[str]:
    """What `parameters` changes of the shipped actuator, as the command line takes it."""
    values = {
        "pump.speed": f"{parameters.n} rev/s",
        "pump.leakage": f"{parameters.pump_leakage_share * parameters.k} m^3/s/Pa",
        "motor.leakage": f"{(1 - parameters.pump_leakage_share) * parameters.k} m^3/s/Pa",
        "motor.inertia": f"{parameters.Theta} kg*m^2",
        "motor.coulomb_friction": f"{parameters.r_C} Nm",
        "line.volume": f"{parameters.V_L} m^3",
        "line.capacitance": f"{parameters.C_0} m^3/Pa",
    }
    return [f"actuator.front.{key}={value}" for key, value in values.items()]


def error(values, reference) -> float:
    """Largest difference of all samples over the reference's peak."""
    return np.abs(values - reference).max() / np.abs(reference).max()


@pytest.fixture(scope="module", params=CASES, ids=lambda case: f"{case[0]} {case[2].Theta} {case[2].C_0} {case[2].n:g}")
def runs(request):
    """(recording of the rig, reference solution) of one case."""
    cycle, command, parameters = request.param
    return drive(cycle, *settings(parameters)), solve(parameters, command)


@pytest.mark.parametrize(("channel", "name"), STATES.items())
def test_states_are_within_a_thousandth_of_their_peak_at_every_sample(runs, channel, name):
    recording, reference = runs
    apart = error(recording[channel], getattr(reference.state(recording.time), name))
    print(f"{recording.title}, {reference.parameters}: {name} {100 * apart:.5f} %")
    assert apart < 1e-3


@pytest.mark.parametrize(("channel", "name"), POWERS.items())
def test_powers_are_within_a_thousandth_of_their_peak_at_every_sample(runs, channel, name):
    recording, reference = runs
    assert error(recording[channel], reference.power(recording.time)[name]) < 1e-3


@pytest.mark.parametrize("name", ["shaft", "motor", "recovered", "throughput", *LOSSES])
def test_energies_are_within_a_ten_thousandth_of_the_throughput(runs, name):
    recording, reference = runs
    expected = np.interp(recording.time, reference.time, reference.energy[name])[-1]
    difference = recording[f"front.energy.{name}"][-1] - expected
    assert abs(difference) < 1e-4 * reference.energy["throughput"][-1]


def test_the_bar_torque_is_the_mean_over_the_coming_step(runs):
    recording, reference = runs
    times = recording.time[:-1, None] + 1e-3 * np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    angles = reference.state(times.ravel()).phi.reshape(times.shape)
    torque = STIFFNESS * angles @ np.array([7, 32, 12, 32, 7]) / 90  # Boole's rule
    assert error(recording["front.bar.torque"][:-1], torque) < 1e-3


def commanding(command: Command, duration: float = 0.6) -> list[str]:
    knots = ", ".join(f"[{t!r} s, {angle!r} rad]" for t, angle in command.knots)
    return [f"manoeuvre.command={{join: smooth, knots: [{knots}]}}", f"duration={duration} s"]


@pytest.mark.parametrize(
    ("parameters", "command"), [(REAR, STEP_1_DEG), (REAR, STEP_10_DEG), (NOMINAL, REVERSAL), (NOMINAL, step(14.4))]
)
def test_other_circuits_and_commands_agree_as_well(parameters, command):
    recording = drive("bench_step_1deg", *settings(parameters), *commanding(command))
    state = solve(parameters, command).state(recording.time)
    assert error(recording["front.bar.angle"], state.phi) < 1e-3
    assert error(recording["front.motor.pressure"], state.dp) < 1e-3


def test_the_running_rates_are_those_of_the_reference_at_any_state():
    random, shipped = np.random.default_rng(2), circuit()
    scale = np.array([1.1, 150.0, 1.3, 250e5, 0.7, 2.0])
    for now in random.uniform(-1, 1, (1000, 6)) * scale:
        command = now[4] + random.uniform(-0.05, 0.05)
        stroke = min(max(NOMINAL.K_p * (command - now[4]), -1.0), 1.0)
        running, _ = rates(shipped, STIFFNESS, tuple(now), stroke, 0.0)
        assert running == pytest.approx(derivative(NOMINAL, now.tolist(), command), rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("start", [0.3, 2.0, 10.0, 20.0])
def test_a_command_given_later_gives_the_same_run_later(start):
    command = f"manoeuvre.command.knots=[[0 s, 0 deg], [{start} s, 1 deg]]"
    late = drive("bench_step_1deg", command, f"duration={start + 0.6} s")
    prompt, first = drive("bench_step_1deg"), round(start / 1e-3)
    for name in ("front.bar.angle", "front.motor.pressure"):
        assert error(late[name][first:], prompt[name]) < 1e-3


@pytest.mark.parametrize("leakage", [4e-13, 1.2e-12, 2e-12])
@pytest.mark.parametrize(("rpm", "schedule", "gain"), [(3000, 0, 60.0), (1500, 0, 60.0), (1500, 1, 120.0)])
def test_leakage_leaves_the_steady_state_error_of_the_closed_form(leakage, rpm, schedule, gain):
    parameters = VerificationSet(k=leakage, n=rpm / 60)
    a = leakage * STIFFNESS / parameters.D**2
    K_v = gain * parameters.V_p * parameters.n / parameters.D
    recording = drive(
        "bench_step_1deg", "duration=3 s", f"actuator.control.loop.schedule={schedule}", *settings(parameters)
    )
    assert 1.0 - np.degrees(recording["front.bar.angle"][-1]) == pytest.approx(a / (a + K_v), rel=1e-5)
