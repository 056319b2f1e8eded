"""Rotations by quaternions against MuJoCo's own."""

import mujoco
import numpy as np
import pytest

from ars_mujoco.recording.rerun.rotation import about_z, matrices, product, roll_of, yaw_of


@pytest.fixture
def quats():
    random = np.random.default_rng(7).normal(size=(20, 4))
    return random / np.linalg.norm(random, axis=1, keepdims=True)


def test_matrices_are_mujocos(quats):
    for quat, matrix in zip(quats, matrices(quats), strict=True):
        expected = np.empty(9)
        mujoco.mju_quat2Mat(expected, quat)
        np.testing.assert_allclose(matrix.ravel(), expected, atol=1e-14)


def test_a_product_turns_by_the_second_then_the_first(quats):
    np.testing.assert_allclose(
        matrices(product(quats, quats[::-1])), matrices(quats) @ matrices(quats[::-1]), atol=1e-14
    )


def test_roll_is_positive_right_side_down():
    half = np.radians(10) / 2
    quat = product(about_z(np.array(1.0)), np.array((np.cos(half), np.sin(half), 0, 0)))
    assert np.degrees(roll_of(quat)) == pytest.approx(10)
    assert yaw_of(quat) == pytest.approx(1.0)
    right_side = np.array((0, -1, 0))
    assert (matrices(quat) @ right_side)[2] < 0
