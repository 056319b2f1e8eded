"""The circuit's modes: rotor on the bar, oil on the motor; against closed forms and against Hopsan's solution of it."""

import gzip
import json
import math
from pathlib import Path

import numpy as np
import pytest
from eha_runs import C_H, D_P, STIFFNESS, D
from records import filled
from scipy.integrate import solve_ivp

from ars_mujoco.actuators.electro_hydrostatic.circuit import circuit_rates
from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.kernels.substeps import differences
from ars_mujoco.schema.document import read

J, THETA, DAMPING, LEAKAGE = 4e-4, 0.175, 16.5, 4e-13
MEAN = 150e5  # Pa, at which no check valve and no relief valve opens
SPEED, ANGLE, RATE = 7, 8, 9
NUDGES = np.array([1e2] * 5 + [1e-4, 1e-4, 1e-4, 1e-7, 1e-7])
REFERENCE = Path(__file__).parents[4] / "shared/data/reference/circuits"
with_reference = pytest.mark.skipif(not REFERENCE.is_dir(), reason=f"the reference solution is not at {REFERENCE}")


def linear_circuit(leaks: bool = False) -> np.record:
    """The shipped front circuit without dry friction and pump losses."""
    circuit = filled(read(actuator_schema(), "electro_hydrostatic", "actuator").value.front)
    circuit.pump.torque_loss.norm = circuit.motor.coulomb_friction = 0.0
    if not leaks:
        circuit.pump.leakage = circuit.motor.leakage = 0.0
    return circuit


def at_rest() -> np.ndarray:
    return np.array([MEAN] * 4 + [5e5, 0.0, 1.0, 0.0, 0.0, 0.0])


def slopes(circuit) -> np.ndarray:
    """(10, 10) slopes (1/s) of the running code."""
    shut = (0.0, 1.0)
    return differences(lambda x: circuit_rates(circuit, STIFFNESS, 0.0, 0.0, shut, tuple(x))[0], at_rest(), NUDGES)


def swings(circuit) -> list[complex]:
    """Its eigenvalues that oscillate, the slow one first."""
    found = np.linalg.eigvals(slopes(circuit))
    return sorted(found[found.imag > 1.0], key=abs)


def closed_form(leakage: float) -> list[complex]:
    """The same of J w' = -D_p dp, C dp' = D_p w - k dp - D rate, Theta rate' = D dp - r rate - c phi, written out."""
    found = np.linalg.eigvals(
        np.array(
            [
                [0.0, -D_P / J, 0.0, 0.0],
                [D_P / C_H, -leakage / C_H, 0.0, -D / C_H],
                [0.0, 0.0, 0.0, 1.0],
                [0.0, D / THETA, -STIFFNESS / THETA, -DAMPING / THETA],
            ]
        )
    )
    return sorted(found[found.imag > 1.0], key=abs)


@pytest.mark.parametrize("leaks", [False, True])
def test_its_modes_are_those_of_four_equations(leaks):
    expected = closed_form(LEAKAGE if leaks else 0.0)
    assert swings(linear_circuit(leaks)) == pytest.approx(expected, rel=1e-5)


def test_undamped_the_rotor_swings_on_the_bar_and_the_motor_on_the_oil():
    circuit = linear_circuit()
    circuit.motor.viscous_friction = 0.0
    slow, fast = swings(circuit)
    assert slow.imag == pytest.approx(D_P / math.sqrt(J * (C_H + D**2 / STIFFNESS)), rel=3e-3)
    assert fast.imag == pytest.approx(math.sqrt(D**2 / (THETA * C_H) + STIFFNESS / THETA), rel=3e-3)
    assert abs(slow.real) < 1e-6 * slow.imag
    assert abs(fast.real) < 1e-6 * fast.imag


def test_with_the_low_side_held_one_side_alone_is_compressed():
    circuit, x = linear_circuit(), at_rest()
    x[:4] = [50e5, 4e5, 50e5, 4e5]  # a check valve is open
    x[SPEED] = 100.0
    derivatives, *_ = circuit_rates(circuit, STIFFNESS, 0.0, 0.0, (0.0, 1.0), tuple(x))
    assert derivatives[0] == pytest.approx(D_P * 100.0 / (2.0 * C_H), rel=1e-9)


# ---- against the independent solution


def summary(case: str) -> dict:
    return json.loads((REFERENCE / "d_summary.json").read_text())[case]


def solved(circuit, seconds: float, torque, twist, times) -> np.ndarray:
    """(10, n) states under a torque (Nm) over (time, speed) on the shaft and a twist (rad) over time."""

    def rate(t, x):
        return circuit_rates(circuit, STIFFNESS, twist(t), torque(t, x[SPEED]), (0.0, 1.0), tuple(x))[0]

    scale = np.array([1.0] * 5 + [1e-9, 1e-9, 1e-7, 1e-10, 1e-8])
    run = solve_ivp(rate, (0.0, seconds), at_rest(), "DOP853", times, rtol=1e-9, atol=scale, max_step=2e-3)
    return run.y


@with_reference
@pytest.mark.parametrize(("case", "leaks"), [("d1", False), ("d3", True)])
def test_its_modes_are_those_of_the_reference(case, leaks):
    slow, fast = swings(linear_circuit(leaks))
    slow_decay, slow_rate, fast_decay, fast_rate = summary(case)["fit"]
    assert slow.imag == pytest.approx(slow_rate, rel=1e-3)
    assert fast.imag == pytest.approx(fast_rate, rel=1e-3)
    assert slow.real == pytest.approx(slow_decay, rel=1e-2)
    assert fast.real == pytest.approx(fast_decay, rel=1e-2)


@with_reference
def test_a_step_of_torque_swings_as_the_reference_does():
    with gzip.open(REFERENCE / "d1.csv.gz", "rt") as file:
        expected = np.genfromtxt(file, delimiter=",", names=True)
    x = solved(linear_circuit(), expected["t"][-1], lambda t, w: float(t >= 0.1), lambda t: 0.0, expected["t"])
    for values, name in ((x[ANGLE], "phi"), (x[0] - x[1], "dp"), (x[SPEED], "w_rotor")):
        reference = expected["p_a"] - expected["p_b"] if name == "dp" else expected[name]
        assert np.abs(values - reference).max() < 2e-3 * np.abs(reference).max(), name
    assert math.degrees(x[ANGLE].max()) == pytest.approx(summary("d1")["peak_phi_deg"], rel=1e-3)


@with_reference
def test_a_turned_end_presses_as_the_reference_does():
    times = np.linspace(0.0, 0.6, 60001)
    turned = math.radians(1.0)

    def twist(t):
        return turned * min(max((t - 0.1) / 1e-3, 0.0), 1.0)

    x = solved(linear_circuit(), 0.6, lambda t, w: 0.0, twist, times)
    over, expected = 1e-5 * (x[0] - x[1]), summary("d2")
    bar = STIFFNESS * (x[ANGLE] - np.array([twist(t) for t in times]))
    assert np.abs(bar).max() == pytest.approx(expected["M_peak"], rel=5e-3)
    assert sorted(np.abs([over.min(), over.max()])) == pytest.approx(
        sorted(np.abs([expected["min_dp_bar"], expected["max_dp_bar"]])), rel=5e-3
    )


@with_reference
@pytest.mark.parametrize(("case", "leaks"), [("d4", False), ("d5", True)])
def test_shorted_it_lets_go_as_slowly_as_the_reference(case, leaks):
    def voltage(t):
        return 12.0 * min(max(min((t - 0.1) / 2e-3, (0.402 - t) / 2e-3), 0.0), 1.0)

    def torque(t, w):
        return 0.12 * (voltage(t) - 0.12 * w) / 0.045

    times = np.linspace(0.0, 3.0, 3001)
    x = solved(linear_circuit(leaks), 3.0, torque, lambda t: 0.0, times)
    late = times >= 0.6
    tau = -1.0 / np.polyfit(times[late], np.log(x[ANGLE][late]), 1)[0]
    assert tau == pytest.approx(summary(case)["tau"], rel=1e-2)
    assert math.degrees(x[ANGLE].max()) == pytest.approx(summary(case)["phi_peak"], rel=1e-3)
