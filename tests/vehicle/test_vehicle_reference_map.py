"""The reference map: angles at which the very model that runs holds its target."""

import math

import numpy as np
import pytest

from ars_mujoco.vehicle.model import build
from ars_mujoco.vehicle.reference_map import TARGET, reference_map
from ars_mujoco.vehicle.sedan import GRAVITY
from ars_mujoco.vehicle.statics import Statics, bar_stiffness

G = GRAVITY


@pytest.mark.parametrize("mass", [1450, 1900])
def test_a_car_of_any_mass_holds_its_target_by_its_own_map(mass, sedan):
    car = sedan.model_copy(update={"sprung": sedan.sprung.model_copy(update={"mass": mass, "cg_height": 0.62})})
    model = build(car)
    table, statics, stiffness = reference_map(model, car), Statics(model, car), bar_stiffness(car, "locked")
    for lateral, roll in TARGET:
        angles = (table.front_angle, table.rear_angle)
        angle = np.array([np.interp(lateral, table.lateral_acceleration, column) for column in angles])
        assert math.degrees(statics.turned(lateral, stiffness, angle).roll - roll) == pytest.approx(0, abs=1e-3)


def test_the_map_reaches_1_1_g_and_starts_at_zero(sedan, sedan_model):
    table = reference_map(sedan_model, sedan)
    assert table.lateral_acceleration[-1] == pytest.approx(1.1 * G)
    assert len(table.reading) <= 24
    assert (np.diff(table.reading) > 0).all()
    assert abs(table.front_angle[0]) + abs(table.rear_angle[0]) < 1e-6


def test_a_knot_that_falls_on_the_grid_makes_no_second_row(sedan, sedan_model):
    target = ((0.0, 0.0), (0.55 * G * (1 + 1e-12), 0.0), (0.9 * G, 0.01))
    assert (np.diff(reference_map(sedan_model, sedan, target, points=23).reading) > 0.01).all()


def test_the_share_is_that_of_the_torques(sedan, sedan_model):
    table = reference_map(sedan_model, sedan, front_share=0.7)
    np.testing.assert_allclose(0.3 * table.front_torque, 0.7 * table.rear_torque, atol=1e-6)


def test_the_motor_unwinds_beyond_0_6_g_while_its_torque_still_rises(sedan, sedan_model):
    table = reference_map(sedan_model, sedan)
    at_06, at_08 = (np.searchsorted(table.lateral_acceleration, x * G) for x in (0.6, 0.8))
    assert table.front_angle[at_08] < table.front_angle[at_06]
    assert table.front_torque[at_08] > table.front_torque[at_06]


def test_the_roll_plane_holds_its_target_by_its_own_map(roll_plane, roll_plane_model):
    table = reference_map(roll_plane_model, roll_plane)
    at = np.searchsorted(table.lateral_acceleration, 0.8 * G)
    angle = np.array([table.front_angle[at], table.rear_angle[at]])
    turn = Statics(roll_plane_model, roll_plane).turned(0.8 * G, bar_stiffness(roll_plane, "locked"), angle)
    assert math.degrees(turn.roll) == pytest.approx(1.3, abs=1e-3)
