"""Fig. 11."""

import numpy as np
import pytest
from theory import LOOP, cascade_polynomial, same_poles

from ars_mujoco.analysis import root_locus

RESULT = root_locus.compute(LOOP)


def test_every_locus_runs_through_the_roots_of_the_cascade():
    for i in range(0, len(RESULT["gain"]), 60):
        poles = np.array(RESULT["loci"][i]) @ [1, 1j]
        assert same_poles(poles, cascade_polynomial(LOOP, RESULT["gain"][i]))


def test_the_branches_from_the_slowest_poles_meet_on_the_real_axis():
    poles = np.sort(np.array(RESULT["loci"]) @ [1, 1j], axis=1)
    gaps = np.abs(np.diff(poles, axis=1)).min(axis=1)
    assert gaps.min() < 1e-3
    assert -150 < poles[gaps.argmin()][np.abs(poles[gaps.argmin()].imag) < 1e-3].real.mean() < -120


def test_the_critical_gain_puts_a_pair_on_the_imaginary_axis():
    poles = np.array(RESULT["critical"]["poles"])
    assert np.sum(np.abs(poles[:, 0]) < 1e-4) == 2
    assert np.all(poles[:, 0] < 1e-4)


def test_the_servo_pump_s_poles_are_slower_than_the_hydraulic_ones():
    sizes = np.sort(np.hypot(*np.transpose(RESULT["open_loop"])))
    assert sizes[1:4] == pytest.approx([280, 297.5, 297.5], rel=1e-3)
    assert sizes[4:] == pytest.approx(834, rel=1e-3)


def test_the_gain_hardly_moves_the_hydraulic_poles():
    own = np.array(RESULT["own"]["poles"])
    assert np.hypot(*own.T).max() == pytest.approx(835, abs=1)
