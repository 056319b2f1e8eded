"""How the equations are solved: order of the substep, an independent solution, mirrored and interpreted twins."""

import subprocess
import sys
from functools import cache

import numpy as np
import pytest
from eha_reference import C_BAR, D_M, solution
from eha_runs import RATIO, bench_run, step_to

from ars_mujoco.actuators.electro_hydrostatic import system
from ars_mujoco.actuators.electro_hydrostatic.equations import Demand
from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.actuators.system import Car, Command, Moment, Torsion, Twist, Twists
from ars_mujoco.control.control_unit import BarCommand, ControlUnit
from ars_mujoco.kernels.kernel import kernel
from ars_mujoco.kernels.records import numbers
from ars_mujoco.machines.electric_machine import DRIVEN
from ars_mujoco.schema.document import read
from ars_mujoco.schema.parameters import record_dtype

STIFF = ("supply.line_resistance=0 ohm", "supply.capacitance=1e6 F", "supply.converter_power=1 MW")
STEP = 1e-3  # s


def blank(dtype):
    return np.zeros(1, dtype).view(np.recarray)[0]


def built(front: float = 5700.0, rear: float | None = 3800.0):
    """(parameters, state) of the shipped file in a car with these bars (Nm/rad), at rest."""
    p, state = blank(system.PARAMETERS), blank(system.STATE)
    file = read(actuator_schema(), "electro_hydrostatic", "actuator").value
    unit = ControlUnit(sample_time="0 s", delay="0 s")
    car = Car(Torsion(front, 0.0), None if rear is None else Torsion(rear, 0.0), unit, {}, has_road=True)
    system.fill(p, file, car, STEP)
    system.start(p, state)
    return p, state


@kernel
def through(p, now, later, demand, step, count):
    return system.step_through(p, now, later, demand, step, count)


@kernel
def advance(p, now, later, out, command, twists, moment):
    return system.advance(p, now, later, out, 0.0, command, twists, moment)


# ---- order


@cache
def moved(count: int) -> np.ndarray:
    """States and energies after 10 ms in `count` substeps, in steady motion: no limit is met, no sign changes."""
    p, now = built()
    demand = []
    for name, stiffness, sign in (("front", 5700.0, 1.0), ("rear", 3800.0, -1.0)):
        p[name].circuit.motor.coulomb_friction = 0.0
        axle = now.state[name]
        axle.speed, axle.rate, axle.angle = sign * 60.0, sign * 60.0 / RATIO, sign * 0.06
        axle.sensed = over = sign * (0.06 * stiffness + 16.5 * 60.0 / RATIO) / D_M
        axle.pump_a = axle.motor_a = 80e5 + 0.5 * over
        axle.pump_b = axle.motor_b = 80e5 - 0.5 * over
        axle.integral = sign * 0.4
        axle.current = (D_M / RATIO * over + axle.integral) / 0.12
        demand.append(Demand(BarCommand((0.0, 0.0, 0.0), sign * 0.0656 * stiffness), 0.0, (0.0, 1.0), DRIVEN))
    later = blank(system.STATE)
    through(p, now, later, tuple(demand), 0.01, count)
    return np.array([*numbers(later.state), *numbers(later.energy)])


def test_the_substep_is_of_fourth_order():
    exact = moved(6400)
    size = np.maximum(np.abs(exact), 1e-9)
    errors = [np.linalg.norm((moved(count) - exact) / size) for count in (100, 200, 400)]
    print("orders", np.log2(np.divide(errors[:-1], errors[1:])), "errors", errors)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.1)


def test_the_shipped_bar_takes_eight_substeps_a_step():
    p, _ = built()
    assert p.substeps == 8.0  # the motor's dry friction is the fastest: r_C/(w_s Theta) = 2e4 1/s


# ---- the independent solution

SMOOTH = "{join: smooth, knots: [[0 s, 0 deg], [0.3 s, 6 deg], [0.5 s, 6 deg], [0.9 s, -7 deg]]}"


def smooth(t):
    knots = ((0.0, 0.0), (0.3, 6.0), (0.5, 6.0), (0.9, -7.0))
    for (start, before), (end, after) in zip(knots, knots[1:], strict=False):
        if t < end:
            s = (t - start) / (end - start)
            return np.radians(before + (after - before) * s**3 * (10.0 - 15.0 * s + 6.0 * s * s))
    return np.radians(-7.0)


CASES = {
    "smooth, angle": (SMOOTH, smooth, 1.2, ("control.follow=angle",), (0.3, 0.5, 0.9)),
    "step of 1000 Nm": (step_to(1000.0), lambda t: 1000.0 / C_BAR, 0.6, (), ()),
    "step over the relief valve": (step_to(1700.0), lambda t: 1700.0 / C_BAR, 0.6, (), ()),
}


@pytest.mark.parametrize("case", CASES)
def test_it_agrees_with_an_independent_solution(case):
    command, function, seconds, settings, pieces = CASES[case]
    run = bench_run(command, seconds, *settings, *STIFF)
    y = solution(function, seconds, run.time, pieces=pieces)
    pairs = {
        "front.motor.pressure_a": y[0], "front.motor.pressure_b": y[1], "front.accumulator.pressure": y[2],
        "front.pump.speed": y[3], "front.bar.angle": y[4], "front.motor.rate": y[5], "front.machine.current": y[8],
        "front.energy.electrical": y[9], "front.energy.friction": y[11],
    }  # fmt: skip
    errors = {name: np.abs(run[name] - values).max() / np.abs(values).max() for name, values in pairs.items()}
    leaked = run["front.energy.pump_leakage"] + run["front.energy.motor_leakage"]
    errors["leakage"] = np.abs(leaked - y[10]).max() / y[10][-1]
    print(case, {name: f"{error:.1e}" for name, error in errors.items()})
    assert max(errors.values()) < 1e-3
    assert D_M * np.abs(y[0] - y[1]).max() > 500.0


# ---- mirrored and interpreted


def test_a_mirrored_run_is_the_mirrored_run():
    def run(sign):
        command = f"{{join: smooth, knots: [[0 s, 0 deg], [0.2 s, {sign * 8} deg], [0.5 s, {-sign * 3} deg]]}}"
        return bench_run(command, 0.8, ends=f"{{sine: {{amplitude: {sign * 15} mm, frequency: 3 Hz}}}}")

    left, right = run(1), run(-1)
    for name in ("bar.angle", "bar.torque", "motor.pressure", "pump.speed", "machine.torque"):
        np.testing.assert_allclose(left[f"front.{name}"], -right[f"front.{name}"], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(left["front.motor.pressure_a"], right["front.motor.pressure_b"], rtol=1e-9)
    np.testing.assert_allclose(left["front.energy.electrical"], right["front.energy.electrical"], rtol=1e-9)


def after_steps(count: int) -> list[float]:
    """Every number of state and outputs after `count` steps of 1 ms of both axles."""
    p, now = built()
    later, out = blank(system.STATE), blank(record_dtype(system.Output))
    inputs = np.array([0.0, 1.0, 1.0, 0.0, 1.0, 1.0])
    torques = (0.0, 0.0)
    for i in range(count):
        twists = Twists(Twist(1e-3 * i, 1.0, 1e-3 * i), Twist(-1e-3 * i, -1.0, -1e-3 * i))
        command = Command(BarCommand((0.1, 0.0, 0.0), 600.0), BarCommand((-0.1, 0.2, 0.0), -300.0), inputs)
        torques = advance(p, now, later, out, command, twists, Moment(1e-3 * i, STEP, 30.0, 0.0))
        now, later = later, now
    return [*numbers(now), *numbers(out), *torques]


def test_interpreted_it_is_the_same(monkeypatch):
    native = after_steps(30)
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    monkeypatch.setenv("PYTHONPATH", ":".join(sys.path))
    program = "from test_electro_hydrostatic_numerics import *; print([float(x) for x in after_steps(30)])"
    printed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    np.testing.assert_allclose(eval(printed, {"nan": np.nan}), native, rtol=1e-10, atol=1e-12)


def test_at_rest_it_stays_at_rest():
    p, now = built()
    later, out = blank(system.STATE), blank(record_dtype(system.Output))
    inputs = np.array([0.0, 1.0, 1.0, 0.0, 1.0, 1.0])
    still, idle = Twist(0.0, 0.0, 0.0), BarCommand((0.0, 0.0, 0.0), 0.0)
    torques = advance(
        p, now, later, out, Command(idle, idle, inputs), Twists(still, still), Moment(0.0, STEP, 0.0, 0.0)
    )
    assert torques == (0.0, 0.0)
    assert numbers(later.state.front) == numbers(now.state.front)
