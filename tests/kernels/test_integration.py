"""Integration: any number of states by classical Runge-Kutta, and what is summed up along with them."""

import math
import subprocess
import sys

import numpy as np
import pytest
from scipy.linalg import expm

from ars_mujoco.kernels.integration import integrated
from ars_mujoco.kernels.kernel import inlined, kernel
from ars_mujoco.kernels.records import along, numbers, share, store, weighted, zeros
from ars_mujoco.kernels.substeps import differences, fewest_substeps

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


def test_a_demand_over_time_is_taken_at_the_times_of_the_stages():
    _, (mean,) = moved(7, demand=6.0)
    assert mean == pytest.approx(3.0, rel=1e-14)


@pytest.mark.parametrize("length", [1, 2, 5, 13])
def test_tuples_of_any_length_are_taken_number_by_number(length):
    state, slope = tuple(np.linspace(1.0, 2.0, length)), tuple(np.linspace(-1.0, 3.0, length))

    @kernel
    def compiled(state, slope):
        return along(state, slope, 0.5), weighted(state, slope, slope, slope, slope, 0.5), zeros(state)

    ahead, by_stages, nothing = compiled(state, slope)
    assert ahead == along(state, slope, 0.5) == pytest.approx(np.add(state, np.multiply(0.5, slope)))
    assert by_stages == weighted(state, slope, slope, slope, slope, 0.5) == pytest.approx(ahead)
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


def test_interpreted_it_is_the_same_to_the_last_bit(monkeypatch):
    later, torques = moved(9, demand=1.7)
    program = (
        "from test_integration import *; later, torques = moved(9, demand=1.7); print([*numbers(later), *torques])"
    )
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    monkeypatch.setenv("PYTHONPATH", ":".join(sys.path))
    printed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    assert eval(printed, {"np": np}) == [*numbers(later), *torques]


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
