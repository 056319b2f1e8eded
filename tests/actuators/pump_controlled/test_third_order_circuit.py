"""The reduced circuit as a whole: closed forms of its parts at work together, and its energy at every instant."""

import math
from itertools import product

import numpy as np
import pytest
from bench import AT_REST, STIFFNESS, axle, circuit, linearized, one_sided
from hypothesis import given
from hypothesis import strategies as st
from records import blank

from ars_mujoco.actuators.pump_controlled.axle import AxleState
from ars_mujoco.actuators.pump_controlled.third_order_circuit import (
    CircuitState,
    advance,
    advance_both,
    rates,
    stored_energy,
)
from ars_mujoco.hydraulics.line import capacitance, middle_volume
from ars_mujoco.hydraulics.loss_polynomial import FlowLoss
from ars_mujoco.hydraulics.vane_motor import stop_torque
from ars_mujoco.schema.parameters import fill

BAR = 1e5
NO_COMMAND = (0.0, 0.0, 0.0)
SHIPPED = circuit()
BOTH = pytest.mark.parametrize("parameters", [SHIPPED, one_sided()], ids=["series", "one_sided"])
STATES = st.tuples(st.floats(-1, 1), st.floats(-100, 100), st.floats(-1.2, 1.2), st.floats(-250, 250), st.floats(-1, 1),
                   st.floats(-2, 2), st.floats(-0.5, 0.5))  # fmt: skip


def state(**values):
    record = blank(CircuitState)
    for name, value in values.items():
        record[name] = value
    return record


def run(parameters, start, seconds, stroke=0.0, twist=0.0):
    """State and energies after `seconds`, the pump told to hold a stroke."""
    now = at(start)
    advance(axle(parameters), now, now, (NO_COMMAND, 0.0, stroke, twist), seconds, round(seconds / 5e-5))
    return now.circuit, now.energy


def at(circuit_state):
    """The state of an axle whose circuit is in a state, without energies yet."""
    record = blank(AxleState)
    record.circuit = circuit_state
    return record


def blocked():
    """The circuit with a motor that does not move."""
    parameters = circuit()
    parameters.motor.inertia = 1e12
    return parameters


def test_oil_pumped_into_a_trapped_volume_raises_its_pressure_by_volume_over_capacitance():
    parameters = blocked()
    parameters.pump.leakage = parameters.motor.leakage = 0.0
    end, _ = run(parameters, state(stroke=0.1), 0.01, stroke=0.1)
    assert end.pressure == pytest.approx(0.1 * 9e-5 * 0.01 / 6e-14, rel=1e-9)


@pytest.mark.parametrize("side", [1, -1])
def test_one_sided_the_trapped_volume_is_that_of_the_side_pumped_into(side):
    parameters = one_sided()
    parameters.motor.inertia = 1e12
    parameters.pump.leakage = parameters.motor.leakage = 0.0
    start = state(stroke=side * 0.1, pressure=side * BAR, angle=0.5)
    end, _ = run(parameters, start, 0.01, stroke=side * 0.1, twist=0.5)
    share = 5.24e-4 / (2 * math.pi) * 0.5 / middle_volume(SHIPPED.line, SHIPPED.motor)
    rise = side * 0.1 * 9e-5 * 0.01 / (1.2e-13 * (1 + side * share))
    assert end.pressure == pytest.approx(side * BAR + rise, rel=1e-9)


def test_a_motor_turned_by_hand_compresses_the_oil():
    (_, _, _, pressure_rate, _, _), _ = rates(SHIPPED, STIFFNESS, (0.0, 0.0, 0.0, 0.0, 0.0, 0.1), 0.0, 0.0)
    assert pressure_rate == pytest.approx(-5.24e-4 / (2 * math.pi) * 0.1 / 6e-14)


def test_trapped_pressure_leaks_away_exponentially_into_the_two_leakages():
    end, energy = run(blocked(), state(pressure=100 * BAR), 0.05)
    assert end.pressure == pytest.approx(100 * BAR * math.exp(-4e-13 / 6e-14 * 0.05), rel=1e-9)
    lost = 0.5 * 6e-14 * ((100 * BAR) ** 2 - end.pressure**2)
    assert energy.pump_leakage == pytest.approx(0.5625 * lost, rel=1e-9)
    assert energy.motor_leakage == pytest.approx(0.4375 * lost, rel=1e-9)


def test_a_full_pump_against_a_blocked_motor_rests_on_the_relief_valve():
    end, _ = run(blocked(), state(), 0.1, stroke=1.0)
    flow = 9e-5 - 4e-13 * end.pressure
    assert end.pressure == pytest.approx(190 * BAR + flow / 8.33e-11, rel=1e-6)


def test_a_motor_pushed_beyond_its_angle_rests_between_oil_bar_and_stop():
    twist = math.radians(44.0)
    end, energy = run(SHIPPED, state(angle=twist), 2.0, stroke=1.0, twist=twist)
    assert end.angle > SHIPPED.motor.stop_angle
    bar, stop = STIFFNESS * (end.angle - twist), stop_torque(SHIPPED.motor, end.angle)
    assert SHIPPED.motor.displacement * end.pressure == pytest.approx(bar + stop, rel=1e-6)


def test_a_lossless_motor_bounces_off_its_stop_as_fast_as_it_came():
    parameters = circuit()
    parameters.motor.coulomb_friction = parameters.motor.viscous_friction = 0.0
    parameters.pump.leakage = parameters.motor.leakage = 0.0
    parameters.line.capacitance = 1.0  # so soft that no pressure builds up
    angle = SHIPPED.motor.stop_angle
    half = math.pi * math.sqrt(0.175 / (2e5 + STIFFNESS))
    end, _ = run(parameters, state(angle=angle, rate=0.2), half, twist=angle)
    assert end.rate == pytest.approx(-0.2, rel=1e-6)
    assert end.angle == pytest.approx(angle, abs=1e-6)


def test_without_dry_friction_oil_and_motor_ring_at_834_rad_s():
    parameters = circuit()
    parameters.motor.coulomb_friction = 0.0
    poles = np.linalg.eigvals(linearized(parameters)[0])
    assert np.abs(poles).max() == pytest.approx(834, rel=2e-3)


def test_dry_friction_holds_the_motor_like_3516_nms_per_rad_at_standstill():
    poles = np.linalg.eigvals(linearized(SHIPPED)[0])
    assert poles.real.min() == pytest.approx(-20060, rel=1e-3)


def lossy():
    """The circuit with a flow loss of second order, part of it there without pressure."""
    parameters = circuit()
    loss = FlowLoss.model_validate({
        "norm": "5.4 L/min", "normal_speed": "3000 rpm", "normal_pressure": "180 bar",
        "coefficients": {"k_000": 0.003, "k_100": 0.004, "k_011": 0.01, "k_101": -0.005, "k_102": 0.02, "k_220": 0.002},
        "validity": {"stroke": ["0", "1"], "speed": ["0 rpm", "6500 rpm"], "pressure": ["0 bar", "300 bar"]},
    })  # fmt: skip
    fill(parameters.pump.flow_loss, loss)
    return parameters


@pytest.mark.parametrize("parameters", [SHIPPED, one_sided(), lossy()], ids=["series", "one_sided", "polynomial"])
@given(STATES)
def test_what_the_shaft_gives_is_stored_or_lost_at_every_instant(parameters, drawn):
    *now, twist = drawn
    now[3] *= BAR
    derivatives, powers = rates(parameters, STIFFNESS, tuple(now), 0.3, twist)
    shaft, *lost, _, _ = powers
    h = 1e-7
    ahead, behind = (
        np.array(stored_energy(parameters, STIFFNESS, state(**along(now, derivatives, s)), twist)) for s in (h, -h)
    )
    gained = (ahead - behind) / (2 * h)
    assert gained.sum() == pytest.approx(shaft - sum(lost), abs=1e-4 * (np.abs(gained).sum() + abs(shaft) + 1.0))


@BOTH
@given(STATES)
def test_a_mirrored_state_moves_mirrored_to_the_last_bit(parameters, drawn):
    *now, twist = drawn
    now[3] *= BAR
    moving, _ = rates(parameters, STIFFNESS, tuple(now), 0.3, twist)
    mirrored, _ = rates(parameters, STIFFNESS, tuple(np.negative(now).tolist()), -0.3, -twist)
    assert mirrored == tuple(np.negative(moving))


def along(now, derivatives, step):
    return dict(zip(CircuitState.model_fields, np.add(now, np.multiply(step, derivatives)), strict=True))


def test_every_loss_but_the_capacitances_costs_at_any_state():
    random = np.random.default_rng(1)
    parameters = lossy()
    for now in random.uniform(-1, 1, (500, 6)) * [1, 100, 1.2, 250 * BAR, 0.7, 2]:
        _, (_, torque_loss, pump_leakage, motor_leakage, relief, friction, _, _, _) = rates(
            parameters, STIFFNESS, tuple(now), 0.0, 0.0
        )
        assert min(torque_loss, pump_leakage, motor_leakage, relief, friction) >= 0.0


def test_an_ideal_pump_takes_from_its_shaft_what_it_gives_the_oil_or_gives_it_back():
    parameters = circuit()
    parameters.pump.leakage = parameters.pump.torque_loss.norm = 0.0
    for stroke, pressure in product((0.5, -0.5), (100 * BAR, -100 * BAR)):
        _, (shaft, torque_loss, pump_leakage, *_) = rates(
            parameters, STIFFNESS, (0.0, 0.0, stroke, pressure, 0.0, 0.0), 0.0, 0.0
        )
        assert shaft == pytest.approx(stroke * 9e-5 * pressure)
        assert torque_loss == pump_leakage == 0.0


def test_advancing_leaves_the_state_it_starts_from():
    start, end = at(state(angle=0.1)), blank(AxleState)
    advance(axle(SHIPPED), start, end, (NO_COMMAND, 60.0, 0.0, 0.0), 1e-3, 8)
    assert start == at(state(angle=0.1))
    assert end != start


def test_two_circuits_in_lockstep_go_as_each_alone():
    axles = axle(SHIPPED), axle(circuit("rear"), 0.5 * STIFFNESS)
    starts = at(state(angle=0.1, pressure=20 * BAR)), at(state(stroke=0.2, rate=-0.3))
    demands = ((0.1, 0.3, 9.0), 60.0, 0.1, 0.01), ((0.005, -0.2, 7.0), 40.0, -0.2, 0.02)
    ends = both(blank(AxleState), blank(AxleState))
    torques = advance_both(both(*axles), both(*starts), ends, demands, 1e-3, 7)
    for i, end in enumerate((ends.front, ends.rear)):
        alone = blank(AxleState)
        assert torques[i] == advance(axles[i], starts[i], alone, demands[i], 1e-3, 7)
        assert end == alone


def both(front, rear):
    """A record of both axles."""
    record = np.zeros(1, [("front", front.dtype), ("rear", rear.dtype)]).view(np.recarray)[0]
    record.front, record.rear = front, rear
    return record


def test_the_returned_torque_is_the_mean_over_the_step():
    parameters, h = axle(SHIPPED), 1e-3
    demand = NO_COMMAND, 60.0, 0.0, 0.02
    parts = [at(state(rate=0.5))]
    mean = advance(parameters, parts[0], blank(AxleState), demand, h, 64)
    for _ in range(64):
        parts.append(blank(AxleState))
        advance(parameters, *parts[-2:], demand, h / 64, 1)
    torques = STIFFNESS * (np.array([each.circuit.angle for each in parts]) - 0.02)
    assert mean == pytest.approx(np.trapezoid(torques) / 64, rel=1e-6)


def test_work_of_the_shaft_is_recovered_where_it_comes_back_and_throughput_never_falls():
    parameters, now = axle(SHIPPED), at(state(angle=0.3, pressure=150 * BAR, stroke=0.2))
    given = back = through = 0.0
    for _ in range(200):
        later = blank(AxleState)
        advance(parameters, now, later, (NO_COMMAND, 60.0, 0.0, 0.0), 5e-5, 1)
        shaft, motor = later.energy.shaft - now.energy.shaft, later.energy.motor - now.energy.motor
        given, back, through = given + max(shaft, 0.0), back + max(-shaft, 0.0), through + abs(shaft) + abs(motor)
        now = later
    assert min(given, back) > 1.0  # J: it goes both ways
    assert now.energy.recovered == pytest.approx(back, rel=1e-9)
    assert now.energy.shaft == pytest.approx(given - back, rel=1e-9)
    assert now.energy.throughput == pytest.approx(through, rel=1e-9)


def test_the_pressure_follows_the_capacitance_of_the_turned_motor():
    for angle in (0.0, 0.3, -0.6):
        now = (0.0, 0.0, 0.5, 0.0, angle, 0.0)
        (_, _, _, pressure_rate, _, _), _ = rates(SHIPPED, STIFFNESS, now, 0.0, 0.0)
        assert pressure_rate == pytest.approx(0.5 * 9e-5 / capacitance(SHIPPED.line, SHIPPED.motor, angle, 0.0))


def test_at_rest_nothing_moves():
    derivatives, _ = rates(SHIPPED, STIFFNESS, AT_REST, 0.0, 0.0)
    assert not np.any(derivatives)
