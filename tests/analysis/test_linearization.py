"""The running code linearized is the paper's linear model."""

import math

import control
import numpy as np
import pytest
from theory import CORNERS, LOOP, cascade_polynomial, full_flow, leakage, plant_polynomial, pump_polynomial, same_poles

from ars_mujoco.analysis.linearization import (
    actuator,
    closed_loop,
    hydraulic_matrix,
    open_loop,
    plant,
    state_matrices,
)


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_pressure_and_rate_have_the_matrix_of_eq_43(loop):
    motor, C = loop.circuit.motor, loop.circuit.line.capacitance
    paper = [
        [-leakage(loop) / C, -motor.displacement / C],
        [motor.displacement / motor.inertia, -motor.viscous_friction / motor.inertia],
    ]
    np.testing.assert_allclose(hydraulic_matrix(loop), paper, rtol=1e-9)


def test_the_stroke_acts_on_the_pressure_as_in_eq_43():
    A, _ = state_matrices(LOOP)
    np.testing.assert_allclose(A[3:, 2], [full_flow(LOOP) / LOOP.circuit.line.capacitance, 0.0, 0.0], rtol=1e-9)


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_the_plant_has_the_paper_s_poles_and_the_bar_s(loop):
    system = plant(loop)
    assert same_poles(system.poles(), plant_polynomial(loop))
    rest = control.dcgain(system)[:, 0]
    assert rest[0] == pytest.approx(loop.circuit.motor.displacement / (leakage(loop) * loop.stiffness), rel=1e-9)
    assert rest[1] == pytest.approx(1.0 / leakage(loop), rel=1e-9)


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_the_actuator_has_the_poles_of_pump_control_and_plant(loop):
    assert same_poles(actuator(loop).poles(), np.polymul(pump_polynomial(loop), plant_polynomial(loop)))


@pytest.mark.parametrize("loop", [LOOP, *CORNERS])
def test_the_closed_loop_has_the_roots_of_the_cascade_polynomial(loop):
    assert same_poles(closed_loop(loop).poles(), cascade_polynomial(loop, loop.gain))


def test_closing_the_open_loop_gives_the_closed_loop():
    omega = np.geomspace(1, 1000, 30)
    by_hand = control.feedback(open_loop(LOOP))(1j * omega)
    np.testing.assert_allclose(closed_loop(LOOP)["angle", "command"](1j * omega), by_hand, rtol=1e-9)


def test_the_inner_loop_has_its_3_db_point_at_280_rad_s():
    pump = pump_polynomial(LOOP)
    assert abs(pump[-1] / np.polyval(pump, 280j)) == pytest.approx(math.sqrt(0.5), rel=1e-6)


def test_a_scheduled_gain_makes_the_loop_the_same_at_every_speed():
    slow, fast = (LOOP.scheduled(1.0).at({"speed": speed}) for speed in (160.0, 620.0))
    np.testing.assert_allclose(open_loop(slow)(300j), open_loop(fast)(300j), rtol=1e-9)


def test_dry_friction_is_left_out_unless_asked_for():
    stiff, smooth = (np.linalg.eigvals(state_matrices(LOOP, dry)[0]).real.min() for dry in (True, False))
    assert stiff == pytest.approx(-20060, rel=1e-3)
    assert smooth == pytest.approx(-280, rel=1e-6)
    assert LOOP.circuit.motor.coulomb_friction == 35.0


def test_a_point_of_the_box_keeps_how_leakage_is_split_between_pump_and_motor():
    moved = LOOP.at({"leakage": 2e-12})
    assert leakage(moved) == pytest.approx(2e-12)
    assert moved.circuit.pump.leakage / leakage(moved) == pytest.approx(0.5625)
    tight = moved.at({"leakage": 0.0})
    assert leakage(tight.at({"leakage": 1e-12})) == pytest.approx(1e-12)
