"""Statics of a steady turn."""

import math

import mujoco
import numpy as np
import pytest

from ars_mujoco.schema.errors import ArsError
from ars_mujoco.vehicle.sedan import GRAVITY
from ars_mujoco.vehicle.statics import Statics, bar_stiffness, roll_gradient

G = GRAVITY


@pytest.fixture
def statics(sedan, sedan_model):
    return Statics(sedan_model, sedan)


@pytest.mark.parametrize(("bars", "least", "most"), [("none", 9, 10.5), ("passive", 5.5, 6.5), ("locked", 1.8, 2.4)])
def test_the_roll_gradient_is_a_mid_size_cars(bars, least, most, sedan, sedan_model):
    assert least < roll_gradient(sedan_model, sedan, bars) < most


def test_the_loads_carry_the_weight_and_its_moment(sedan, statics):
    turn = statics.turned(0.6 * G, bar_stiffness(sedan, "passive"))
    _, across, height = statics.data.subtree_com[statics.body]
    patches = [patch_across(statics.data, wheel) for wheel, _ in statics.tires]
    assert turn.wheel_load.sum() == pytest.approx(sedan.mass * G, rel=1e-4)
    # about a line on the road: the loads, the weight and the turn's inertia
    assert turn.wheel_load @ patches == pytest.approx(sedan.mass * (G * across - 0.6 * G * height), rel=1e-4)


def patch_across(data, wheel) -> float:
    """y (m) of the contact patch: down the wheel's plane from its centre."""
    (_, y, height), axis = data.xpos[wheel], data.xmat[wheel, 1::3]
    return y + height * axis[1] * axis[2] / (1 - axis[2] ** 2)


def test_a_right_turn_mirrors_a_left_turn(sedan, sedan_model):
    stiffness = bar_stiffness(sedan, "passive")
    left, right = (Statics(sedan_model, sedan).turned(sign * 0.5 * G, stiffness) for sign in (1, -1))
    assert left.roll == pytest.approx(-right.roll, rel=1e-6)
    np.testing.assert_allclose(left.wheel_load, right.wheel_load[[1, 0, 3, 2]], rtol=1e-6)


def test_the_body_leans_out_and_the_outer_wheels_carry_more(sedan, statics):
    turn = statics.turned(0.5 * G, bar_stiffness(sedan, "none"))
    assert turn.roll > 0
    assert turn.wheel_load[1] > turn.wheel_load[0]


def test_the_sensor_feels_gravity_as_the_body_leans(sedan, statics):
    turn = statics.turned(0.5 * G, bar_stiffness(sedan, "none"))
    assert turn.reading == pytest.approx(0.5 * G * math.cos(turn.roll) + G * math.sin(turn.roll), rel=1e-3)


def test_the_front_motor_reaches_1400_nm_at_0_85_to_1_0_g_where_it_holds_the_car_flat_alone(statics):
    # by its slope at 0.5 g: 1400 Nm put 4.5 kN on a wheel that carries 4.0, so that the inner one lifts before
    torque, _ = statics.held(0.5 * G, roll=0.0, front_share=1.0).torque
    assert 0.85 < 1400 / torque * 0.5 < 1.0


def test_a_lifted_wheel_ends_the_statics(statics):
    with pytest.raises(ArsError, match="no steady turn at 1.00 g"):
        statics.held(1.0 * G, roll=0.0, front_share=1.0)


def test_the_links_keep_their_length(sedan, sedan_model):
    statics = Statics(sedan_model, sedan)
    statics.held(0.8 * G, roll=0.0, front_share=0.6)
    assert np.abs(statics.data.ten_length - sedan_model.tendon_length0).max() < 5e-5


@pytest.mark.parametrize("bars", ["none", "passive", "locked"])
def test_the_roll_planes_gradient_is_its_closed_form(bars, roll_plane, roll_plane_model):
    overturning = roll_plane.mass * G * (roll_plane.cg_height - roll_plane.roll_axis_height)
    lever = roll_plane.front.link_distance / roll_plane.front.arm
    stiffness = roll_plane.roll_stiffness + bar_stiffness(roll_plane, bars).sum() * lever**2
    expected = math.degrees(overturning / (stiffness - overturning))
    assert roll_gradient(roll_plane_model, roll_plane, bars) == pytest.approx(expected, rel=0.01)


def test_statics_run_no_callback(sedan, sedan_model):
    called = []
    mujoco.set_mjcb_control(lambda model, data: called.append(1))
    try:
        Statics(sedan_model, sedan).turned(0.3 * G, bar_stiffness(sedan, "none"))
    finally:
        mujoco.set_mjcb_control(None)
    assert not called
