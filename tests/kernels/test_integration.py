"""Integration: any number of states by classical Runge-Kutta, and what is summed up along with them."""

import math
import subprocess
import sys

import numpy as np
import pytest
from scipy.linalg import expm

from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.kernels.records import along, divided, numbers, share, store, zeros
from ars_mujoco.kernels.substeps import derivatives, differences, fewest_substeps, linearized, scales, slopes
from ars_mujoco.schema.channels import channel
from ars_mujoco.schema.parameters import Parameters, record_dtype

OSCILLATOR = np.dtype([("motion", [("position", "f8"), ("rate", "f8")])])
ENERGY = np.dtype([("spring", "f8"), ("damper", "f8")])
PART = np.dtype([("state", OSCILLATOR), ("energy", ENERGY)])
OMEGA, DAMPING = 3.0, 0.4  # rad/s, 1/s


@inlined
def rates(p, demand, t, state):
    """A damped oscillator of unit mass under a force that grows with the time; powers of spring and damper."""
    x, v = state
    force = demand * t
    return (v, force - OMEGA * OMEGA * x - DAMPING * v), (OMEGA * OMEGA * x * v, DAMPING * v * v), (force,)


advance = integrated(rates)


@kernel
def drive(now, later, demand, step, count):
    return advance(0.0, now, later, demand, step, count)


def record(dtype):
    return np.zeros(1, dtype).view(np.recarray)[0]


def moved(count: int, demand: float = 0.0, step: float = 1.0):
    now, later = record(PART), record(PART)
    now.state.motion.position = 1.0
    torques = drive(now, later, demand, step, count)
    return later, torques


def exact(t: float) -> np.ndarray:
    return expm(t * np.array([[0.0, 1.0], [-(OMEGA**2), -DAMPING]]))[:, 0]


def test_it_is_of_fourth_order():
    errors = [np.linalg.norm(numbers(moved(count)[0].state) - exact(1.0)) for count in (10, 20, 40, 80)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.15)


def test_so_are_the_energies_and_they_close():
    errors = []
    for count in (40, 80, 160):
        later, _ = moved(count)
        kinetic = 0.5 * later.state.motion.rate**2
        errors.append(abs(later.energy.spring - (0.5 * OMEGA**2 * (later.state.motion.position**2 - 1.0))))
        assert later.energy.damper + kinetic + later.energy.spring == pytest.approx(0.0, abs=errors[-1] * 10)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.2)


def test_under_a_force_that_grows_with_the_time_it_is_of_fourth_order_too():
    matrix = np.array([[0.0, 1.0, 0.0, 0.0], [-(OMEGA**2), -DAMPING, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [0.0] * 4])
    final = expm(matrix) @ [1.0, 0.0, 0.0, 6.0]  # position and rate, force and its growth
    errors = [np.linalg.norm(numbers(moved(count, demand=6.0)[0].state) - final[:2]) for count in (10, 20, 40, 80)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(4.0, abs=0.15)


def test_a_demand_over_time_is_taken_at_the_times_of_the_stages():
    _, (mean,) = moved(7, demand=6.0)
    assert mean == pytest.approx(3.0, rel=1e-14)


@pytest.mark.parametrize("length", range(1, 14))
def test_tuples_of_any_length_are_taken_number_by_number(length):
    state, slope = tuple(np.linspace(1.0, 2.0, length)), tuple(np.linspace(-1.0, 3.0, length))

    @kernel
    def compiled(state, slope):
        return along(state, slope, 0.5), divided(state, 3), zeros(state)

    ahead, thirds, nothing = compiled(state, slope)
    assert ahead == along(state, slope, 0.5) == pytest.approx(np.add(state, np.multiply(0.5, slope)))
    assert thirds == tuple(x / 3 for x in state)
    assert nothing == (0.0,) * length


def test_a_record_is_read_and_written_block_by_block():
    dtype = np.dtype([("a", "f8"), ("b", [("c", "f8"), ("d", [("e", "f8"), ("f", "f8")])]), ("g", "f8")])
    values = (1.0, 2.0, 3.0, 4.0, 5.0)

    @kernel
    def copied(source, target):
        store(target, numbers(source))

    source, target, twin = record(dtype), record(dtype), record(dtype)
    store(source, values)
    copied(source, target)
    copied.py_func(source, twin)
    assert numbers(target) == numbers(twin) == values
    assert target.b.d.f == 4.0


def test_what_two_records_share_is_copied_and_nothing_else():
    wide, narrow = np.dtype([("a", "f8"), ("b", "f8"), ("c", "f8")]), np.dtype([("c", "f8"), ("a", "f8"), ("d", "f8")])

    @kernel
    def shared(target, source):
        share(target, source)

    for function in (shared, share):
        source, target = record(wide), record(narrow)
        source.a, source.b, source.c, target.d = 1.0, 2.0, 3.0, 4.0
        function(target, source)
        assert (target.a, target.c, target.d) == (1.0, 3.0, 4.0)


@inlined
def stopped(p, state):
    return min(state[0], 0.0), state[1]


@inlined
def given_and_taken(powers):
    return abs(powers[0]), max(-powers[0], 0.0)


held_back = integrated(rates, stopped, given_and_taken)


@kernel
def drive_to_the_stop(now, later, demand, step, count):
    return held_back(0.0, now, later, demand, step, count)


def test_a_state_that_is_settled_stands_there_after_each_substep():
    now, halfway, later, at_once = record(PART), record(PART), record(PART), record(PART)
    now.state.motion.position, now.state.motion.rate = -0.1, 1.0
    drive_to_the_stop(now, halfway, 0.0, 0.15, 1)
    drive_to_the_stop(halfway, later, 0.0, 0.15, 1)
    drive_to_the_stop(now, at_once, 0.0, 0.3, 2)
    assert halfway.state.motion.position == 0.0
    assert numbers(at_once.state) == numbers(later.state)


def test_what_is_counted_comes_from_the_means_of_the_substeps():
    now, counted, plain = record(PART), record(PART), record(PART)
    now.state.motion.position = -1.0
    drive_to_the_stop(now, counted, 0.0, 0.4, 20)  # which it does not reach, so the spring only gives
    drive(now, plain, 0.0, 0.4, 20)
    assert plain.energy.spring < 0.0
    assert numbers(counted.energy) == (-plain.energy.spring, -plain.energy.spring)


def results() -> list[float]:
    later, torques = moved(9, demand=1.7)
    stopped_at = record(PART)
    more = drive_to_the_stop(later, stopped_at, 1.7, 1.0, 7)
    return [*numbers(later), *torques, *numbers(stopped_at), *more]


def test_interpreted_it_is_the_same_to_the_last_bit(monkeypatch):
    program = "from test_integration import *; print(results())"
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    monkeypatch.setenv("PYTHONPATH", ":".join(sys.path))
    printed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert eval(printed, {"np": np}) == results()


# ---- substeps


@pytest.mark.parametrize("rate", [1.5e4, 2e4, 6e4])
def test_what_decays_gets_substeps_within_the_stable_limit(rate):
    count = fewest_substeps([np.array([[-rate]])], 1e-3)
    assert rate * 1e-3 / count <= 0.92 * 2.7853 < rate * 1e-3 / (count - 1)


def test_an_oscillation_is_resolved_and_what_grows_asks_for_nothing():
    omega = 9e3
    assert fewest_substeps([np.array([[0.0, omega], [-omega, 0.0]])], 1e-3) == math.ceil(omega * 1e-3 / 0.92)
    assert fewest_substeps([np.array([[1e9]]), np.array([[-1.0]])], 1e-3) == 4


def test_differences_are_the_slopes_of_the_equations():
    slopes = differences(lambda state: rates(0.0, 0.0, 0.0, tuple(state))[0], np.zeros(2), np.array([1e-4, 1e-3]))
    assert slopes == pytest.approx(np.array([[0.0, 1.0], [-(OMEGA**2), -DAMPING]]), abs=1e-9)


class Motion(Parameters):
    position: float = channel("m", "position", scale=1e-4)
    rate: float = channel("m/s", "its rate", scale=1e-3)


class Nested(Parameters):
    first: Motion
    lag: float = channel("1", "a lag", scale=2.0)
    last: Motion


def test_nudges_stand_in_the_order_of_the_record_blocks_included():
    assert scales(Nested).tolist() == [1e-4, 1e-3, 2.0, 1e-4, 1e-3]
    assert len(scales(Nested)) == len(numbers(record(record_dtype(Nested))))


@inlined
def steered(p, demand, t, state):
    """The oscillator under a force that is the demand."""
    x, v = state
    return (v, demand - p * x - DAMPING * v), (0.0,), (0.0,)


def test_linearized_it_is_the_matrices_of_the_oscillator_and_the_state_is_left():
    at = record(record_dtype(Motion))
    at.position, at.rate = 0.3, -0.7
    evaluate = derivatives(steered)
    a, b = linearized(evaluate, OMEGA**2, lambda force: 2.0 * force, at, scales(Motion), 1e-3)
    assert a == pytest.approx(np.array([[0.0, 1.0], [-(OMEGA**2), -DAMPING]]), abs=1e-9)
    assert b == pytest.approx(np.array([[0.0], [2.0]]), abs=1e-9)
    assert slopes(evaluate, OMEGA**2, 0.0, at, scales(Motion)) == pytest.approx(a, abs=1e-9)
    assert numbers(at) == (0.3, -0.7)
