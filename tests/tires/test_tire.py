"""The whole tire on a wheel: its signs, its balance of work, lift-off, and standstill."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from wheel import Wheel

from ars_mujoco.tires.tire import tire

STATIC = 0.3135 - 4000.0 / 225e3  # height of the centre under nominal load


def rolling(speed, height=STATIC):
    """Spin of a wheel that rolls freely."""
    return speed / (0.3135 - (0.3135 - height) / 3.0)


def state(record):
    return record.u, record.v


motions = st.fixed_dictionaries(
    {
        "v": st.tuples(st.floats(-40, 40), st.floats(-10, 10), st.floats(-2, 2)),
        "w": st.tuples(*[st.floats(-2, 2)] * 3),
        "spin": st.floats(-200, 200),
        "height": st.floats(0.2, 0.32),
    }
)


def test_a_loaded_wheel_at_rest_feels_its_load_alone():
    assert Wheel().force(height=STATIC) == pytest.approx((0.0, 0.0, 4000.0, 0.0, 0.0, 0.0), abs=1e-9)


def test_a_lifted_wheel_feels_exactly_nothing_and_forgets_its_deflection():
    wheel = Wheel()
    wheel.settled(v=(20.0, 1.0, 0.0), spin=rolling(22.0))
    assert wheel.now.u != 0.0 and wheel.now.v != 0.0
    assert wheel.force(v=(20.0, 1.0, 0.0), spin=70.0, height=0.32) == (0.0,) * 6
    assert state(wheel.next) == (0.0, 0.0)
    assert wheel.out.vertical_force == 0.0


def test_moving_to_the_left_is_opposed_to_the_right_and_turned_out_of():
    wheel = Wheel()
    Fx, Fy, Fz, Tx, Ty, Tz = wheel.settled(v=(20.0, 1.0, 0.0), spin=rolling(20.0), height=STATIC)
    assert wheel.out.slip_angle == pytest.approx(math.atan(1.0 / 20.0), rel=1e-9)
    assert Fy == wheel.out.lateral_force < 0.0
    assert Tx == pytest.approx(STATIC * Fy)  # a force to the right at the patch turns the wheel's bottom to the right
    assert Tz == wheel.out.aligning_moment > 0.0
    assert Fx == pytest.approx(0.0, abs=1e-6)


def test_a_wheel_that_turns_too_fast_drives_and_is_braked_by_it():
    wheel = Wheel(rolling_resistance=0.0)
    Fx, _, _, _, Ty, _ = wheel.settled(v=(20.0, 0.0, 0.0), spin=rolling(20.4), height=STATIC)
    assert wheel.out.slip_ratio == pytest.approx(0.02, rel=1e-9)
    assert Fx == wheel.out.longitudinal_force > 0.0
    assert Ty == pytest.approx(-STATIC * Fx)


def test_rolling_resistance_brakes_the_spin():
    wheel = Wheel()
    Ty = wheel.settled(v=(20.0, 0.0, 0.0), spin=rolling(20.0), height=STATIC)[4]
    assert Ty == pytest.approx(-0.01 * 0.3135 * 4000.0, rel=1e-4)


def test_steering_to_the_left_pushes_to_the_left():
    wheel, steer = Wheel(), 0.03
    Fy = wheel.settled(v=(20.0, 0.0, 0.0), spin=rolling(20.0), axis=(-math.sin(steer), math.cos(steer), 0.0))[1]
    assert Fy > 1000.0


def test_a_slope_turns_the_load_to_its_normal():
    Fx, _, Fz, *_ = Wheel().force(height=0.28, road=(0.0, 0.1, 0.0))
    assert Fx == pytest.approx(-0.1 * Fz)


@given(
    motion=motions, steer=st.floats(-0.5, 0.5), lean=st.floats(-0.2, 0.2), slope=st.tuples(*[st.floats(-0.2, 0.2)] * 2)
)
def test_the_force_acts_where_the_wheel_meets_the_road(motion, steer, lean, slope):
    wheel = Wheel()
    axis = np.array([-math.sin(steer) * math.cos(lean), math.cos(steer) * math.cos(lean), math.sin(lean)])
    force, torque = np.split(np.array(wheel.force(**motion, axis=tuple(axis), road=(0.0, *slope))), 2)
    n = np.array([-slope[0], -slope[1], 1.0]) / math.hypot(1.0, *slope)
    forward = np.cross(axis, n) / np.linalg.norm(np.cross(axis, n))
    down = np.cross(axis, forward)
    patch = down * motion["height"] * n[2] / -np.dot(down, n)
    moment = torque - np.cross(patch, force) - wheel.out.aligning_moment * n
    assert np.cross(moment, axis) == pytest.approx(np.zeros(3), abs=1e-8)  # what is left is rolling resistance
    assert abs(moment @ axis) <= 0.01 * 0.3135 * wheel.out.vertical_force + 1e-8
    assert force @ n == pytest.approx(wheel.out.vertical_force, abs=1e-8)


@pytest.mark.parametrize("lean", [-0.2, 0.0, 0.2])
@pytest.mark.parametrize("rate", [-1.0, 0.0, 1.0])
def test_the_damper_feels_the_rate_of_the_deflection(lean, rate):
    def load(damping, angle=lean, height=0.28, **motion):
        axis = (0.0, math.cos(angle), math.sin(angle))
        return Wheel(damping=damping).force(height=height, axis=axis, **motion)[2]

    step = 1e-6
    before, after = (load(0.0, lean + s * rate, 0.28 - s * 0.3) for s in (-step, step))
    change = (after - before) / (2.0 * step) / 225e3
    damped = load(150.0, v=(0.0, 0.0, -0.3), w=(rate, 0.0, 0.0)) - load(0.0)
    assert damped == pytest.approx(150.0 * change, abs=150.0 * 0.01)  # within the carcass' deflection over the radius


def test_only_the_sum_of_spin_and_hub_rotation_about_the_axis_counts():
    turned, still = Wheel(), Wheel()
    assert turned.force(v=(20.0, 0.0, 0.0), spin=60.0, w=(0.0, 5.0, 0.0)) == still.force(v=(20.0, 0.0, 0.0), spin=65.0)


@given(motion=motions, lean=st.floats(-0.1, 0.1), u=st.floats(-0.05, 0.05), v=st.floats(-0.05, 0.05))
def test_a_mirrored_motion_gives_exactly_the_mirrored_force(motion, lean, u, v):
    left, right = Wheel(), Wheel()
    left.now.u, left.now.v, right.now.u, right.now.v = u, v, u, -v
    (vx, vy, vz), (wx, wy, wz) = motion["v"], motion["w"]
    mirrored = motion | {"v": (vx, -vy, vz), "w": (-wx, wy, -wz)}
    Fx, Fy, Fz, Tx, Ty, Tz = left.force(**motion, axis=(0.0, math.cos(lean), math.sin(lean)))
    assert right.force(**mirrored, axis=(0.0, math.cos(lean), -math.sin(lean))) == (Fx, -Fy, Fz, -Tx, Ty, -Tz)


@given(motion=motions)
def test_the_force_is_a_function_of_the_state_now_and_the_motion(motion):
    wheel = Wheel()
    wheel.now.u, wheel.now.v = 0.01, -0.02
    first, after = wheel.force(**motion), state(wheel.next)
    assert wheel.force(**motion) == first
    assert state(wheel.next) == after and state(wheel.now) == (0.01, -0.02)


@given(motion=motions)
def test_interpreted_and_compiled_agree(motion):
    wheel = Wheel()
    wheel.now.u, wheel.now.v = 0.01, -0.02
    compiled = wheel.force(**motion)
    assert wheel.force(**motion, kernel=getattr(tire, "py_func", tire)) == pytest.approx(compiled, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("side", [(0.0, 1.0), (1.0, 0.0), (1.0, 1.0)])
def test_the_force_on_a_locked_wheel_has_no_jump_through_zero_speed(side):
    speeds = np.linspace(-0.01, 0.01, 41)
    forces = np.array([Wheel().force(v=(side[0] * s, side[1] * s, 0.0), height=STATIC)[:2] for s in speeds])
    assert np.abs(np.diff(forces, axis=0)).max() < 1.1 * np.abs(forces[-1] - forces[0]).max() / 40
    assert tuple(forces[20]) == (0.0, 0.0)


def slide(slope, seconds, speed=(0.0, 0.0), mass=400.0, h=1e-3):
    """Velocities (n, 2) of a mass on a locked wheel, pushed along the road by `slope` (x, y) times its weight."""
    wheel, v, history = Wheel(), np.array(speed), []
    for _ in range(int(seconds / h)):
        Fx, Fy, *_ = wheel.force(v=(v[0], v[1], 0.0), height=STATIC)
        wheel.advance()
        v = v + h * (np.array([Fx, Fy]) / mass + 9.81 * np.array(slope))
        history.append(v)
    return np.array(history)


@pytest.mark.parametrize("slope", [(0.2, 0.0), (0.0, 0.2), (-0.3, 0.3)])
def test_a_locked_wheel_holds_on_a_slope_without_creep_or_buzz(slope):
    velocity = slide(slope, seconds=8.0)
    assert np.abs(velocity[:2000]).max() > 0.01  # it first gives way as its carcass deflects
    assert np.abs(velocity[-1000:]).max() < 1e-8
    held = velocity.sum(axis=0) * 1e-3
    assert np.abs(held).max() < 0.03


def test_a_slope_steeper_than_friction_is_not_held():
    assert slide((0.0, 1.2), seconds=2.0)[-1, 1] > 0.5


@pytest.mark.parametrize("speed", [(3.0, 0.0), (0.0, 3.0), (2.0, -1.0)])
def test_a_sliding_wheel_is_braked_by_its_friction_and_comes_to_rest(speed):
    velocity = slide((0.0, 0.0), seconds=4.0, speed=speed)
    braking = np.linalg.norm(velocity[20] - velocity[150]) / 0.130
    assert 0.85 * 10.5 < braking < 11.5  # friction times load over mass, 10.5 to 11.5 m/s^2 at the peaks
    assert np.abs(velocity[-500:]).max() < 1e-5


@pytest.mark.parametrize("speed", [0.0, 0.5, 2.0, 3.0, 5.0, 10.0, 30.0, 60.0])
def test_the_spin_of_a_free_wheel_never_gains_energy(speed, h=1e-3, inertia=0.8):
    wheel = Wheel(rolling_resistance=0.0)
    spin, slip = rolling(speed) + 1.0, []
    for _ in range(3000):
        spin += h * wheel.force(v=(speed, 0.0, 0.0), spin=spin, height=STATIC)[4] / inertia
        wheel.advance()
        slip.append(abs(spin - rolling(speed)))
    assert max(slip[1000:2000]) < 0.5
    assert max(slip[2000:]) <= max(slip[1000:2000]) + 1e-12
    assert max(slip[2000:]) < 1e-3


def test_the_tire_takes_a_bump_of_the_road_height_as_deflection():
    assert Wheel().force(height=0.31, road=(0.02, 0.0, 0.0))[2] == pytest.approx(225e3 * 0.0235)
