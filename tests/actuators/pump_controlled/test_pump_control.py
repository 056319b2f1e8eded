"""The stages of pump control: slopes, the linearly implicit step, and closed forms of valve, cylinder and spring."""

import math

import numpy as np
import pytest
from detailed import STAGES, axle
from scipy import signal

from ars_mujoco.actuators.pump_controlled.pump_control import (
    _drift,
    _eliminate,
    _solve,
    advance_pump_control,
    control_power,
    cylinder_rates,
    stroke_speed,
)
from ars_mujoco.hydraulics.control_cylinder import common_capacitance
from ars_mujoco.hydraulics.metering_edge import largest_stroke_rate

BAR = 1e5
SPOOL, SPOOL_RATE, P_A, P_B, STROKE, SPEED = range(6)
SIZES = np.array([1.0, 100.0, 25 * BAR, 25 * BAR, 1.1, 1.0])  # strokes a little past the stop
NUDGES = np.array([1e-6, 1e-4, 10.0, 10.0, 1e-8, 1e-8])
WITH_CYLINDER = pytest.mark.parametrize("stage", STAGES[1:])
LOSSLESS = dict.fromkeys(("coulomb_friction", "viscous_friction", "internal_leakage", "external_leakage"), 0.0)
H = 1.25e-4  # s, a shipped substep


def parameters(stage, **blocks):
    """The Axle record of a stage, with blocks of its circuit changed: control_cylinder={"mass": 1.0}."""
    record, _ = axle("reduced", stage)
    for block, changes in blocks.items():
        for name, value in changes.items():
            record.circuit[block][name] = value
    return record


def states(count):
    """Random states of the pump control, some beyond a stop, with a stroke command and a pump pressure."""
    random = np.random.default_rng(1)
    for _ in range(count):
        state = random.uniform(-1, 1, 6) * SIZES
        state[P_A], state[P_B] = np.abs(state[[P_A, P_B]]) + 0.1 * BAR
        yield state, random.uniform(-1, 1), random.uniform(-200, 200) * BAR


def rates(record, state, command, pressure):
    return np.array(cylinder_rates(record.circuit, record.detail, tuple(state), command, pressure)[0])


def matrix(found):
    """The (6, 6) slopes that `cylinder_rates` returns in pieces."""
    _, valve, a, b, piston = found
    slopes = np.zeros((6, 6))
    slopes[SPOOL, SPOOL_RATE] = 1.0
    slopes[SPOOL_RATE, [SPOOL, SPOOL_RATE, STROKE]] = valve
    slopes[P_A, [SPOOL, P_A, P_B, STROKE, SPEED]] = a
    slopes[P_B, [SPOOL, P_A, P_B, STROKE, SPEED]] = b
    slopes[STROKE, SPEED] = 1 / 5e-3
    slopes[SPEED, [P_A, P_B, STROKE, SPEED]] = piston
    return slopes


def advanced(record, state, seconds, step=H, command=0.0, pressure=0.0):
    """All states (n + 1, 6) of a run at a held stroke command and pump pressure."""
    course = [tuple(state)]
    for _ in range(round(seconds / step)):
        now = course[-1]
        course.append(
            advance_pump_control(
                record.circuit, record.detail, now, (command, command, 0.0), (pressure, pressure, 0.0), step
            )
        )
    return np.array(course)


def charged(stage, spool=0.0, load=0.0, stroke=0.0, speed=0.0):
    """The state at half the supply's pressure, with a load pressure."""
    pressures = (13.5 * BAR + 0.5 * load, 13.5 * BAR - 0.5 * load) if stage == "full" else (load, 0.0)
    return spool, 0.0, *pressures, stroke, speed


@WITH_CYLINDER
def test_slopes_are_those_of_the_rates_at_any_state(stage):
    record = parameters(stage, control_cylinder={"static_friction": 7.0, "static_decay": 40.0})
    for state, command, pressure in states(300):
        found = cylinder_rates(record.circuit, record.detail, tuple(state), command, pressure)
        measured = np.column_stack(
            [
                (rates(record, state + nudge, command, pressure) - rates(record, state - nudge, command, pressure))
                / (2 * nudge.sum())
                for nudge in np.diag(NUDGES)
            ]
        )
        # each row and column in the size of its state
        assert matrix(found) * SIZES == pytest.approx(measured * SIZES, rel=1e-4, abs=1e-6 * np.abs(found[0]).max())


def test_at_random_states_the_valve_saturates_and_the_stops_are_met():
    drawn = [state for state, *_ in states(300)]
    assert sum(abs(state[STROKE]) > 1.0 for state in drawn) > 10
    slopes = [
        matrix(cylinder_rates(record.circuit, record.detail, tuple(state), 0.5, 0.0))[SPOOL_RATE, SPOOL]
        for record in [parameters("full")]
        for state in drawn
    ]
    assert 0 < sum(slope == 0.0 for slope in slopes) < len(slopes)


@WITH_CYLINDER
def test_the_drift_is_the_change_of_the_rates_with_time_alone(stage):
    record = parameters(stage)
    for state, command, pressure in states(50):
        by_time = 30.0, 2e9  # 1/s and Pa/s, of command and pressure
        found = cylinder_rates(record.circuit, record.detail, tuple(state), command, pressure)
        drift = _drift(record.circuit, found, (command, command, by_time[0]), (pressure, pressure, by_time[1]))
        ahead, behind = (
            rates(record, state, command + t * by_time[0], pressure + t * by_time[1]) for t in (1e-7, -1e-7)
        )
        assert drift == pytest.approx((ahead - behind) / 2e-7, rel=1e-5, abs=1e-2)


@WITH_CYLINDER
def test_elimination_by_hand_solves_the_whole_matrix(stage):
    record, random = parameters(stage), np.random.default_rng(2)
    for state, command, pressure in states(100):
        found = cylinder_rates(record.circuit, record.detail, tuple(state), command, pressure)
        for h in (H, 1e-6):
            right = random.uniform(-1, 1, 6) * SIZES / h
            solved = _solve(_eliminate(record.circuit, found, 2.0 / h), tuple(right))
            expected = np.linalg.solve(2.0 / h * np.eye(6) - matrix(found), right)
            assert solved / SIZES == pytest.approx(expected / SIZES, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("stage", STAGES)
def test_the_valve_answers_a_step_as_its_second_order_lag(stage):
    """Eq. 19: w^2 / (s^2 + 2 d w s + w^2), on a swash plate that does not move."""
    record = parameters(
        stage, swash_plate={"max_rate": 1e-9}, swash_plate_loop={"gain": 1e-9}, control_cylinder={"mass": 1e9}
    )
    found = advanced(record, charged(stage), 0.02, 5e-5, command=0.2)
    w, d = 420.0, math.sqrt(0.5)
    _, expected = signal.step(([w * w], [1, 2 * d * w, w * w]), T=5e-5 * np.arange(len(found)))
    assert found[:, SPOOL] == pytest.approx(0.2 * expected, abs=1e-6)


@WITH_CYLINDER
@pytest.mark.parametrize("side", [1, -1])
def test_a_wide_open_valve_without_load_turns_the_plate_at_248_strokes_a_second(stage, side):
    """B y_max sqrt((p_S - p_t)/2) / (A x_max)."""
    record = parameters(
        stage,
        servo_valve={"frequency": 1e-6},  # the spool stays
        metering_edge={"laminar_pressure": 1e2, "leakage": 0.0},
        control_cylinder=LOSSLESS | {"centring_stiffness": 0.0},
    )
    end = advanced(record, charged(stage, spool=side, stroke=-0.6 * side), 4e-3, 5e-5)[-1]
    expected = largest_stroke_rate(record.circuit.metering_edge, record.circuit.control_cylinder)
    assert expected == pytest.approx(248.3, abs=0.1)
    assert stroke_speed(record.circuit, record.detail, tuple(end)) == pytest.approx(side * expected, rel=1e-5)


@WITH_CYLINDER
def test_a_trapped_cylinder_rings_at_the_hydraulic_eigenfrequency(stage):
    """sqrt(A^2/(C_H m)); the paper gives 400 Hz to 12.6 kHz for pump controls."""
    record = parameters(
        stage,
        servo_valve={"frequency": 1e-6},
        metering_edge={"leakage": 0.0},
        control_cylinder=LOSSLESS | {"centring_stiffness": 0.0},
    )
    step = 2e-7
    found = advanced(record, charged(stage, speed=0.01), 2e-3, step)[:, SPEED]
    crossings = np.flatnonzero(np.sign(found[1:]) != np.sign(found[:-1]))
    at = step * (crossings + found[crossings] / (found[crossings] - found[crossings + 1]))
    frequency = 0.5 / np.diff(at).mean()
    capacitance = common_capacitance(record.circuit.control_cylinder, record.detail.fluid, 0.0, 13.5 * BAR)
    expected = math.sqrt(1.54e-4**2 / (capacitance * 0.15)) / (2 * math.pi)
    print(f"{stage}: {frequency:.1f} Hz, closed form {expected:.1f} Hz")
    assert frequency == pytest.approx(expected, rel=2e-3)
    assert 400 < frequency < 12_600


@WITH_CYLINDER
def test_with_the_supply_off_the_spring_centres_the_plate_through_the_leakage(stage):
    """A x' = -k c x / A with the leakage k between the chambers: exp(-t/tau), tau = A^2/(k c)."""
    record = parameters(
        stage,
        servo_valve={"frequency": 1e-6},
        metering_edge={"supply_pressure": 13.5 * BAR, "return_pressure": 13.5 * BAR, "leakage": 0.0},
        control_cylinder=LOSSLESS | {"internal_leakage": 1e-11},
    )
    load = 1e4 * 5e-3 * 0.5 / 1.54e-4  # of the spring at half the stroke
    start = charged(stage, load=load, stroke=0.5)
    found = advanced(record, start, 0.1)[:, STROKE]
    lag = 1.54e-4**2 / (1e-11 * 1e4)
    assert found == pytest.approx(0.5 * np.exp(-H * np.arange(len(found)) / lag), rel=1e-3)


@WITH_CYLINDER
def test_the_swash_plate_force_of_a_loaded_pump_is_carried_by_the_cylinder(stage):
    """A (p_A - p_B) = F_0 dp/dp_0 once the plate stands in the middle; the loop leaves the valve a little open."""
    record = parameters(stage, control_cylinder={"coulomb_friction": 0.0})
    end = advanced(record, charged(stage), 0.2, pressure=180 * BAR)[-1]
    load = end[P_A] - end[P_B] if stage == "full" else end[P_A]
    assert 1.54e-4 * load == pytest.approx(110 + 1e4 * 5e-3 * end[STROKE], rel=1e-4)
    assert -0.01 < end[STROKE] < 0.0


@WITH_CYLINDER
@pytest.mark.parametrize("rate", [1.0, 0.1])
def test_a_piston_that_meets_its_stop_empties_no_chamber_below_zero(stage, rate):
    """However long the substep is: the valve shut, the piston fast, its chambers at rest."""
    record = parameters(stage)
    start = charged(stage, spool=0.05, load=4 * BAR, stroke=0.999, speed=rate)
    for step in (H, 2 * H, 4 * H):
        found = advanced(record, start, 4e-3, step, command=1.0)
        assert np.all(found[:, STROKE] < 1.02)
        if stage == "full":
            assert np.all(found[:, [P_A, P_B]] > 0.0)
    fine = advanced(record, start, 4e-3, H / 100, command=1.0)[-1]
    assert advanced(record, start, 4e-3, H, command=1.0)[-1] / SIZES == pytest.approx(fine / SIZES, abs=2e-3)


@pytest.mark.parametrize(("stage", "order", "count"), [("third_order", 4, 50), ("reduced", 3, 800), ("full", 3, 800)])
def test_a_step_is_of_its_order_while_command_and_pressure_move(stage, order, count):
    record = parameters(stage, control_cylinder={"coulomb_friction": 0.0})
    duration, slope, bend = 4e-3, (5.0, 4e9), (-300.0, 3e11)  # of the command (1/s, 1/s^2) and the pressure (Pa)

    def moving(t, first, second):
        return first * t + second * t * t

    ends = []
    for steps in (count, 2 * count, 4 * count, 8 * count):
        state, h = charged(stage), duration / steps
        for i in range(steps):
            command, pressure = (
                (moving(i * h, a, b), moving((i + 1) * h, a, b), a + 2 * b * i * h)
                for a, b in zip(slope, bend, strict=True)
            )
            state = advance_pump_control(record.circuit, record.detail, state, command, pressure, h)
        ends.append(state)
    gains = np.linalg.norm(np.diff(ends, axis=0) / SIZES, axis=1)  # of halving the steps
    found = np.log2(gains[:-1] / gains[1:])
    print(f"{stage}: gains {gains}, orders {found}")
    assert found == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize("stage", STAGES)
def test_the_control_supply_always_gives_power(stage):
    record = parameters(stage)
    for state, *_ in states(300):
        state[[P_A, P_B]] = np.minimum(state[[P_A, P_B]], 26 * BAR)
        assert control_power(record.circuit, record.detail, tuple(state)) >= 0.0
