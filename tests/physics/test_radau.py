"""The reference of the verification set against closed forms, another integrator and the published analysis of it."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from radau import (
    ATOL,
    CORNERS,
    LOSSES,
    S_CURVE,
    STEP_1_DEG,
    STEP_10_DEG,
    Command,
    State,
    VerificationSet,
    derivative,
    jacobian,
    powers,
    solve,
    step,
)
from scipy.integrate import solve_ivp

NOMINAL = VerificationSet()
AT_REST = [0.0] * 6
BAR = 1e5


@pytest.mark.parametrize("parameters", [NOMINAL, CORNERS[0], CORNERS[3]])
@pytest.mark.parametrize("command", [STEP_1_DEG, STEP_10_DEG])
def test_an_explicit_method_of_order_eight_gives_the_same_run(parameters, command):
    (end, angle) = command.knots[-1]
    explicit = solve_ivp(
        lambda t, s: derivative(parameters, s.tolist(), angle), (0, end), AT_REST, "DOP853", rtol=1e-11, atol=ATOL
    )
    implicit = solve(parameters, command).state(explicit.t)
    for name in ("phi", "dp"):
        expected = explicit.y[State._fields.index(name)]
        assert np.abs(getattr(implicit, name) - expected).max() < 2e-8 * np.abs(expected).max()


def test_the_jacobian_is_that_of_the_derivative():
    random = np.random.default_rng(1)
    scale = np.array([0.3, 30.0, 0.9, 250 * BAR, 0.2, 0.03])
    parameters = replace(NOMINAL, r_H=15.0)
    for state in random.uniform(-1, 1, (200, 6)) * scale:
        phi_c = state[4] + random.uniform(-0.03, 0.03)
        steps = 1e-6 * scale
        rates = [[derivative(parameters, each.tolist(), phi_c) for each in state + h * np.diag(steps)] for h in (1, -1)]
        differences = (np.subtract(*rates) / (2 * steps[:, None])).T
        analytic = jacobian(parameters, state.tolist(), phi_c)
        size = np.abs(analytic) @ steps
        assert np.all(np.abs(analytic - differences) * steps < 1e-5 * size[:, None] + 1e-9 * steps[:, None])


@pytest.mark.parametrize(("leakage", "percent"), [(4e-13, 0.5), (1.2e-12, 1.5), (2e-12, 2.5)])
def test_the_outer_loop_rests_at_the_error_its_gain_and_the_leakage_give(leakage, percent):
    parameters = replace(NOMINAL, k=leakage)
    a = leakage * parameters.c / parameters.D**2
    gain = parameters.K_p * parameters.V_p * parameters.n / parameters.D  # K_v
    run = solve(parameters, step(1, duration=2.0))
    error = 1 - np.degrees(run.state(np.array([2.0])).phi[0])
    assert error == pytest.approx(a / (a + gain), rel=1e-6)
    assert 100 * error == pytest.approx(percent, abs=0.05)


def test_at_rest_the_motor_carries_the_bar_and_the_pump_its_leakage():
    end = solve(NOMINAL, step(1, duration=2.0)).state(np.array([2.0]))
    assert NOMINAL.D * end.dp[0] == pytest.approx(NOMINAL.c * end.phi[0], rel=1e-6)
    assert NOMINAL.V_p * NOMINAL.n * end.X[0] == pytest.approx(NOMINAL.k * end.dp[0], rel=1e-6)


def test_friction_at_rest_is_a_viscous_one_of_3516_and_a_pole_at_minus_20060():
    poles = np.linalg.eigvals(jacobian(NOMINAL, AT_REST, 0.0))
    assert poles.real.min() == pytest.approx(-20060, rel=1e-3)


def test_without_coulomb_friction_the_oil_and_the_motor_ring_at_834_rad_s():
    poles = np.linalg.eigvals(jacobian(replace(NOMINAL, r_C=0.0, K_p=0.0), AT_REST, 0.0))
    assert np.abs(poles - 1j * 834).min() == pytest.approx(50, abs=5)
    assert np.abs(poles[np.abs(poles).argmax()]) == pytest.approx(834, rel=2e-3)


def test_the_inner_loop_has_the_poles_of_its_stated_bandwidth():
    poles = np.linalg.eigvals(jacobian(NOMINAL, AT_REST, 0.0)[:3, :3])
    assert sorted(poles, key=lambda s: s.imag) == pytest.approx([-157 - 253j, -280, -157 + 253j], abs=1)


@pytest.mark.parametrize(("stiffness", "critical"), [(5700.0, 95.8), (0.0, 88.9)])
def test_the_fixed_gain_turns_unstable_at_6000_rpm_where_the_notes_say(stiffness, critical):
    def growth(gain):
        box = product((4e-14, 8e-14), (0.1, 0.25), (6.5, 26.5), (4e-13, 2e-12))
        corners = [
            VerificationSet(C_0=C_0, Theta=Theta, r_v=r_v, k=k, c=stiffness, K_p=gain, n=100.0, r_C=0.0)
            for C_0, Theta, r_v, k in box
        ]
        return max(np.linalg.eigvals(jacobian(p, AT_REST, 0.0)).real.max() for p in corners)

    assert growth(0.999 * critical) < 0 < growth(1.001 * critical)


@pytest.mark.parametrize(
    ("parameters", "command"),
    [(NOMINAL, S_CURVE), *product([NOMINAL, CORNERS[0], CORNERS[3]], [STEP_1_DEG, STEP_10_DEG, step(18)])],
)
def test_shaft_work_is_stored_or_lost(parameters, command):
    run = solve(parameters, command)
    stored = sum(energy[0] for energy in run.stored(run.time[-1:]).values())
    lost = sum(run.energy[name][-1] for name in LOSSES)
    assert abs(run.energy["shaft"][-1] - stored - lost) < 1e-9 * run.energy["throughput"][-1]


def test_the_relief_valve_holds_a_command_beyond_its_pressure():
    run = solve(NOMINAL, step(18))
    assert run.energy["relief"][-1] > 1.0
    assert np.abs(run.state(run.time).dp[-1]) < 215 * BAR


def test_the_s_curve_costs_the_shaft_3200_joule_mostly_pump_loss_and_returns_under_1_percent():
    energy = {name: values[-1] for name, values in solve(NOMINAL, S_CURVE).energy.items()}
    assert energy["shaft"] == pytest.approx(3200, abs=50)
    assert energy["pump_torque_loss"] > energy["shaft"] / 2
    assert 0 < energy["recovered"] < 0.01 * energy["shaft"]


def test_the_pump_loses_torque_in_all_four_quadrants():
    state = State(y=0, y_rate=0, X=np.array([0.5, 0.5, -0.5, -0.5]), dp=np.array([1, -1, 1, -1]) * 90 * BAR, phi=0, w=0)
    loss = powers(NOMINAL, state)["pump_torque_loss"]
    assert loss == pytest.approx([5.157 * (0.020 + 0.020 + 0.0125 + 0.0075) * 2 * np.pi * 50] * 4)


def test_a_mirrored_command_gives_the_mirrored_run():
    left, right = solve(NOMINAL, STEP_10_DEG), solve(NOMINAL, step(-10))
    time = np.linspace(0, 0.6, 601)
    assert np.array_equal(left.state(time), np.negative(right.state(time)))


def test_a_zero_command_stays_at_rest_and_pays_the_idling_pump():
    run = solve(NOMINAL, Command(((0.0, 0.0), (1.0, 0.0))))
    assert not np.any(run.state(run.time))
    assert run.energy["shaft"][-1] == pytest.approx(5.157 * 0.040 * 2 * np.pi * 50)
