"""Rest and the motions about it."""

import math

import mujoco
import numpy as np
import pytest

from ars_mujoco.schema.errors import ArsError
from ars_mujoco.vehicle import rest


@pytest.fixture
def modes(resting, stand):
    """(frequencies Hz ascending, shapes as columns) of the undamped motions about rest, links' rows included."""
    model, data = resting
    values, shapes = np.linalg.eig(-rest._jacobian(model, data, stand))
    order = np.argsort(values.real)
    return np.sqrt(np.maximum(values.real[order], 0)) / (2 * math.pi), np.abs(shapes[:, order])


def test_nothing_accelerates_in_the_keyframe(resting, stand):
    model, data = resting
    mujoco.mj_resetDataKeyframe(model, data, 0)
    stand(model, data)
    assert np.abs(data.qacc).max() < 1e-6


def test_the_design_pose_is_rest_to_a_hundredth_of_a_millimetre(resting):
    assert abs(resting[0].key_qpos[0, 2]) < 1e-5


def test_rest_is_found_from_a_pose_far_from_it(sedan_model, stand):
    data = mujoco.MjData(sedan_model)
    data.qpos[2] = 0.05
    assert rest.solve(sedan_model, data, stand) < 1e-6


def test_the_loads_are_those_of_the_weight(resting, stand):
    stand(*resting)
    np.testing.assert_allclose(stand.loads, [4039, 4039, 3897, 3897], rtol=0.01)


def test_the_car_stays_at_rest(resting, stand):
    model, data = resting
    mujoco.mj_resetDataKeyframe(model, data, 0)
    for _ in range(300):
        stand(model, data)
        mujoco.mj_step(model, data)
    assert np.abs(data.qpos - model.key_qpos[0]).max() < 1e-6
    assert not data.warning.number.any()


def test_the_body_heaves_at_1_1_to_1_6_hz(modes):
    frequencies, shapes = modes
    heave = np.argmax(shapes[2] * (frequencies > 0.1))
    assert 1.1 < frequencies[heave] < 1.6


def test_the_wheels_hop_at_9_to_15_hz(modes):
    frequencies, _ = modes
    assert np.count_nonzero((frequencies > 9) & (frequencies < 15)) == 4


def test_a_car_that_nothing_holds_has_no_rest(sedan_model):
    with pytest.raises(ArsError, match="no rest found"):
        rest.solve(sedan_model, mujoco.MjData(sedan_model))
