"""The reference of the detailed plant against closed forms, another integrator, its own limits and energy."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
import radau
from radau_full import (
    CONTROLS,
    LOSSES,
    NOMINAL,
    OPEN,
    SHUT,
    Opening,
    Plant,
    compressibility,
    energy_density,
    line_drop,
    rest_state,
    rounded_root,
    solve,
)
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

BAR = 1e5
TIME = np.linspace(0, 0.6, 6001)
STAGES = tuple(CONTROLS)
CIRCUITS = ("reduced", "full")
STEPS = {degrees: radau.step(degrees) for degrees in (1, 10)}
# what the motor carries is cut off for 0.3 s, or let past it from 0.3 s on
FAIL_SAFE_SHUTS = Opening(((0.1, 1.0), (0.12, 0.0), (0.4, 0.0), (0.42, 1.0)))
BYPASS_OPENS = Opening(((0.3, 0.0), (0.32, 1.0)))


def difference(run, expected, quantity):
    """Largest difference over 0.6 s as a share of the peak."""
    values = getattr(run, quantity)(TIME)
    reference = getattr(expected, quantity)(TIME)
    return np.abs(values - reference).max() / np.abs(reference).max()


def rest(plant):
    return np.array(list(rest_state(plant.parameters, plant.stage, plant.circuit).values()))


@pytest.mark.parametrize("degrees", STEPS)
def test_the_third_order_control_on_the_reduced_circuit_is_the_verification_set(degrees):
    run = solve(NOMINAL, "third_order", "reduced", STEPS[degrees])
    verification = radau.solve(radau.VerificationSet(), STEPS[degrees]).state(TIME)
    assert np.abs(run.phi(TIME) - verification.phi).max() < 1e-7 * np.abs(verification.phi).max()
    assert np.abs(run.dp(TIME) - verification.dp).max() < 1e-7 * np.abs(verification.dp).max()


@pytest.mark.slow
@pytest.mark.parametrize("degrees", STEPS)
def test_an_explicit_method_of_order_eight_gives_the_same_run(degrees):
    run = solve(NOMINAL, "full", "full", STEPS[degrees])
    angle = np.radians(degrees)
    explicit = solve_ivp(
        lambda t, s: run.plant.derivative(t, s.tolist(), angle),
        (0, 0.1),
        rest(run.plant),
        "DOP853",
        rtol=1e-10,
        atol=1e-10 * np.array(list(run.plant.sizes.values())),
    )
    implicit = run.state(explicit.t)
    for name, expected in zip(run.plant.sizes, explicit.y, strict=True):
        assert np.abs(implicit[name] - expected).max() < 1e-6 * np.abs(expected).max(), name


@pytest.mark.slow
@pytest.mark.parametrize(("stage", "degrees"), list(product(STAGES, STEPS)))
def test_halving_the_tolerances_changes_nothing(stage, degrees):
    run = solve(NOMINAL, stage, "full", STEPS[degrees])
    finer = solve(NOMINAL, stage, "full", STEPS[degrees], rtol=run.rtol / 2)
    assert len(finer.time) > len(run.time)
    assert difference(run, finer, "phi") < 1e-6
    assert difference(run, finer, "dp") < 1e-6


@pytest.mark.parametrize("lumps", [1, 2, 3])
@pytest.mark.parametrize(("stage", "circuit"), list(product(STAGES, CIRCUITS)))
def test_nothing_moves_at_rest_but_the_leaking_chambers_of_the_cylinder(stage, circuit, lumps):
    plant = Plant(replace(NOMINAL, lumps=lumps), stage, circuit, SHUT, OPEN)
    rates = dict(zip(plant.sizes, plant.derivative(0.0, rest(plant).tolist(), 0.0), strict=True))
    for name, rate in rates.items():
        if name not in ("p_A", "p_B"):
            assert abs(rate) < 1e-6 * plant.sizes[name]
    assert rates.get("p_A", 0.0) == rates.get("p_B", 0.0)


def test_energy_is_what_compressing_against_the_tank_takes():
    for pressure in np.array([0.2, 0.5, 1, 2, 20, 200]) * BAR:
        h = 1e-3 * pressure
        slope = (energy_density(NOMINAL, pressure + h) - energy_density(NOMINAL, pressure - h)) / (2 * h)
        expected = (pressure - NOMINAL.p_t) * compressibility(NOMINAL, pressure)
        assert slope == pytest.approx(expected, rel=1e-4, abs=1e-6)
    assert energy_density(NOMINAL, NOMINAL.p_t) == 0


def test_the_lines_drop_is_laminar_then_blasius_and_has_no_jump():
    p = replace(NOMINAL, lumps=2)
    per_Re = np.pi * p.line_diameter * p.viscosity / 4
    laminar = 128 * p.density * p.viscosity * p.line_length / (2 * np.pi * p.line_diameter**4)
    assert line_drop(p, 2000 * per_Re) == pytest.approx(laminar * 2000 * per_Re)
    v = 1e5 * p.viscosity / p.line_diameter
    blasius = 0.3164 / 1e5**0.25 * p.line_length / 2 / p.line_diameter * p.density / 2 * v**2
    assert line_drop(p, -1e5 * per_Re) == pytest.approx(-blasius)
    for edge in (2300 * per_Re, 4000 * per_Re):
        assert line_drop(p, edge * (1 - 1e-9)) == pytest.approx(line_drop(p, edge * (1 + 1e-9)), rel=1e-6)


@pytest.mark.parametrize("x", [-2e-3, 0.0, 4e-3])
def test_the_moving_piston_widens_chamber_a_and_compresses_b(x):
    p = replace(NOMINAL, k_u=0, k_ext=0, k_Li=0)
    plant = Plant(p, "full", "full", SHUT, OPEN)
    state = rest_state(p) | {"x": x, "v": 0.1, "p_A": 10 * BAR, "p_B": 12 * BAR}
    rates = dict(zip(plant.sizes, plant.derivative(0.0, list(state.values()), 0.0), strict=True))
    for chamber, volume, sign in (("p_A", p.A * (5e-3 + x), -1), ("p_B", p.A * (5e-3 - x), 1)):
        compressed = (volume + p.V_dead) * compressibility(p, state[chamber]) * rates[chamber]
        assert compressed == pytest.approx(sign * p.A * 0.1)


def test_lumps_ring_at_the_frequency_of_the_wave_in_the_line_and_approach_it_with_their_square():
    p = replace(NOMINAL, r_C=0, r_v=0, k=0, k_x=0, G_c=1e-25, air=0, viscosity=1e-12, q_0=1e-12, K_p=0)
    speed = np.sqrt(p.K / p.density)
    impedance = p.density * speed / p.line_area

    def closed_line(w):  # a line shut at the pump, on each of two chambers that drive the motor
        admittance = w * p.D * p.phi_n / p.K + np.tan(w * p.line_length / speed) / impedance
        return (p.Theta * w**2 - p.c) * admittance - 2 * p.D**2 * w

    wave = brentq(closed_line, 300, 600)
    errors = []
    for lumps in (1, 2, 4, 8):
        plant = Plant(replace(p, lumps=lumps), "third_order", "full", SHUT, OPEN)
        poles = np.linalg.eigvals(plant.jacobian(0.0, rest(plant), 0.0)).imag
        errors.append(np.abs(poles - wave).min() / wave)
    assert errors[0] < 0.01
    assert errors[2] / errors[3] == pytest.approx(4, rel=0.03)


@pytest.mark.parametrize("stage", STAGES)
def test_at_rest_the_motor_carries_the_bar_and_the_pump_every_leakage_of_its_side(stage):
    run = solve(NOMINAL, stage, "full", radau.step(1, duration=8.0))
    end = np.array([8.0])
    pressures = {name: values[0] for name, values in run.pressures(end).items()}
    pump, motor = pressures["A0"] - pressures["B0"], run.dp(end)[0]
    leakage = NOMINAL.k_p * pump + NOMINAL.k_m * motor + NOMINAL.k_x * (pressures["A0"] - NOMINAL.p_t)
    assert NOMINAL.D * motor == pytest.approx(NOMINAL.c * run.phi(end)[0], rel=1e-6)
    assert NOMINAL.V_p * NOMINAL.n * run.pump_stroke(end)[0] == pytest.approx(leakage, rel=1e-6)


@pytest.mark.parametrize(
    ("parameters", "stage", "degrees", "valves"),
    [
        *[(NOMINAL, stage, degrees, {}) for stage in STAGES for degrees in (1, 10)],
        pytest.param(replace(NOMINAL, lumps=3), "full", 10, {}, marks=pytest.mark.slow),
        (replace(NOMINAL, lumps=2, b_w=3e-10), "third_order", 10, {}),
        (replace(NOMINAL, phi_n=0.12), "third_order", 10, {}),  # onto the stop
        (NOMINAL, "full", 18, {}),  # onto the relief valve
        (NOMINAL, "full", 10, {"bypass": BYPASS_OPENS}),
        (NOMINAL, "full", 10, {"fail_safe": FAIL_SAFE_SHUTS}),
    ],
)
def test_work_of_shaft_and_charge_pump_is_stored_or_lost(parameters, stage, degrees, valves):
    run = solve(parameters, stage, "full", radau.step(degrees), **valves)
    energy = run.energies()
    stored = run.stored(run.time[-1]) - run.stored(0.0)
    lost = sum(energy[name] for name in LOSSES)
    given = energy["shaft"] + energy["charge"]
    assert abs(given - stored - lost) < 1e-9 * given
    for name in set(LOSSES) - {"chambers"}:
        assert energy[name] >= 0


@pytest.mark.parametrize(
    ("circuit", "degrees", "phi", "dp"),
    # measured: 2.7e-5 and 1.0e-4, 3.1e-5 and 9.6e-5, 5.2e-5 and 2.2e-4, 3.4e-5 and 8.4e-5
    [
        ("reduced", 1, 4e-5, 1.5e-4),
        ("reduced", 10, 5e-5, 1.5e-4),
        ("full", 1, 8e-5, 3.5e-4),
        ("full", 10, 5e-5, 1.3e-4),
    ],
)
def test_the_reduced_pump_control_is_the_full_one(circuit, degrees, phi, dp):
    full, reduced = (solve(NOMINAL, stage, circuit, STEPS[degrees]) for stage in ("full", "reduced"))
    measured = difference(reduced, full, "phi"), difference(reduced, full, "dp")
    print(f"reduced pump control, {circuit} circuit, {degrees} deg: phi {measured[0]:.2e}, dp {measured[1]:.2e}")
    assert measured[0] < phi
    assert measured[1] < dp


@pytest.mark.parametrize(
    ("circuit", "degrees", "phi", "dp"),
    [
        ("reduced", 1, 0.05, 0.08),  # measured 0.032, 0.049
        ("reduced", 10, 0.007, 0.05),  # 0.0043, 0.030
        ("full", 1, 0.06, 0.13),  # 0.039, 0.082
        ("full", 10, 0.007, 0.012),  # 0.0040, 0.0075
    ],
)
def test_the_third_order_pump_control_is_a_few_percent_off(circuit, degrees, phi, dp):
    full, third_order = (solve(NOMINAL, stage, circuit, STEPS[degrees]) for stage in ("full", "third_order"))
    measured = difference(third_order, full, "phi"), difference(third_order, full, "dp")
    print(f"third-order pump control, {circuit} circuit, {degrees} deg: phi {measured[0]:.2e}, dp {measured[1]:.2e}")
    assert phi / 2 < measured[0] < phi
    assert dp / 2 < measured[1] < dp


@pytest.mark.parametrize("stage", ["full", "reduced"])
@pytest.mark.parametrize("quantity", ["phi", "dp", "pump_stroke"])
def test_the_pump_control_tends_to_third_order_with_the_inverse_of_its_supply(stage, quantity):
    def off(factor):
        p = replace(NOMINAL, m=NOMINAL.m / factor, p_S=NOMINAL.p_t + factor * 25 * BAR, air=0, k_u=0, k_ext=0, k_Li=0)
        rate = p.y_max * rounded_root((p.p_S - p.p_t) / 2, p.d_0) / (p.A * p.x_max)  # of X, with B = 1
        p = replace(p, B=p.X_rate_max / rate)
        return difference(solve(p, stage, "reduced", STEPS[1]), solve(p, "third_order", "reduced", STEPS[1]), quantity)

    # measured: 1.98 to 2.01 where the supply is four times the nominal one
    assert off(4) / off(8) == pytest.approx(2, rel=0.05)


def test_the_check_valves_hold_the_low_pressure_line_and_leave_the_capacitance_of_one_side():
    lines = solve(replace(NOMINAL, air=1e-9), "third_order", "full", STEPS[10])
    one_side, series = (
        solve(replace(NOMINAL, C_0=C), "third_order", "reduced", STEPS[10])
        for C in (NOMINAL.V_0 / NOMINAL.K, NOMINAL.V_0 / (2 * NOMINAL.K))
    )
    assert difference(lines, one_side, "phi") < 0.01
    assert difference(lines, series, "phi") > 0.08


@pytest.mark.parametrize(("stage", "circuit"), list(product(STAGES, CIRCUITS)))
def test_a_mirrored_command_gives_the_mirrored_run(stage, circuit):
    left, right = (solve(NOMINAL, stage, circuit, radau.step(degrees)) for degrees in (10, -10))
    for quantity in ("phi", "dp", "pump_stroke"):
        values = getattr(left, quantity)(TIME)
        assert np.abs(values + getattr(right, quantity)(TIME)).max() < 1e-6 * np.abs(values).max()


@pytest.mark.parametrize("lumps", [1, 2, pytest.param(3, marks=pytest.mark.slow)])
def test_no_pressure_falls_to_the_tanks(lumps):
    run = solve(replace(NOMINAL, lumps=lumps), "full", "full", STEPS[10])
    state = run.state(run.time)
    for name in (*run.pressures(run.time), "p_A", "p_B"):
        assert state[name].min() > NOMINAL.p_t


def test_a_zero_command_stays_at_rest_and_pays_the_idling_and_the_charge_pump():
    run = solve(NOMINAL, "full", "full", radau.step(0))
    energy = run.energies()
    assert np.abs(run.phi(run.time)).max() < 1e-15
    assert np.abs(run.dp(run.time)).max() < 1e-6
    assert energy["shaft"] == pytest.approx(5.157 * 0.040 * 2 * np.pi * 50 * 0.6)
    assert energy["charge"] == pytest.approx(energy["charge_relief"], rel=0.01)


def test_the_bypass_lets_the_motor_go_back():
    run = solve(NOMINAL, "full", "full", STEPS[10], bypass=BYPASS_OPENS)
    before, after = np.array([0.3]), np.array([0.4])
    assert np.degrees(run.phi(before)[0]) > 9.9
    assert abs(np.degrees(run.phi(after)[0])) < 0.1


def test_the_shut_fail_safe_valve_leaves_the_motor_only_its_leakage_and_the_pump_its_relief_valve():
    run = solve(NOMINAL, "full", "full", STEPS[10], fail_safe=FAIL_SAFE_SHUTS)
    shut = np.linspace(0.125, 0.395, 271)
    state, pressures = run.state(shut), run.pressures(shut)
    assert np.abs([state["Q_A1"], state["Q_B1"]]).max() < 1e-12
    assert np.ptp(np.degrees(run.phi(shut))) < 0.5
    through = NOMINAL.G_rel * (pressures["A0"] - pressures["gallery"] - NOMINAL.dp_rel)
    assert through[-1] == pytest.approx(NOMINAL.V_p * NOMINAL.n, rel=0.1)
    assert np.degrees(run.phi(run.time[-1:])[0]) > 9.9
