"""The circuit: what one flow does for both axles, and what it takes (`reference/systems.md`, sections 1.5, 11, 12)."""

import math

import numpy as np
import pytest
from shipped import recording
from valve_runs import (
    AT_750,
    FLOW,
    LEAKAGE,
    OPEN_INTAKE,
    STIFFNESS,
    THETA,
    D,
    driven,
    parameters,
    smooth,
)

from ars_mujoco.actuators.valve_controlled import system
from ars_mujoco.actuators.valve_controlled.block import Setting
from ars_mujoco.actuators.valve_controlled.equations import Demand, State
from ars_mujoco.kernels.substeps import scales, slopes

L_MIN = 1e-3 / 60.0
C_FRONT, C_REAR = 2.5e-13, 3.9e-13  # m^3/Pa of node and chamber
OWN_LEAKAGE = 8e-13 + LEAKAGE + 2 * 2e-13  # of the pump, and of a motor, a pressure valve, the direction valve
# what the reference's quasi-static figures leave out
IDEAL = (
    "pump.leakage=0 m^3/s/Pa",
    "block.direction_valve.leakage=0 m^3/s/Pa",
    "block.front_valve.leakage=0 m^3/s/Pa",
    "block.rear_valve.leakage=0 m^3/s/Pa",
    "front.motor.coulomb_friction=0 Nm",
    "rear.motor.coulomb_friction=0 Nm",
)


def in_place(run) -> float:
    """The time (s) at which the direction valve has switched."""
    return run.time[np.argmax(np.abs(run.supply.switching.direction) > 0.9)]


# ---- the pump and its circulation


@pytest.mark.parametrize(("speed", "flow"), [(750, 5.5), (1450, 8.8), (3000, 9.0), (6000, 9.0)])
def test_the_flow_saturates(speed, flow):
    run = driven(0.0, 0.0, 0.01, OPEN_INTAKE, f"drive.speed={speed} rpm")
    assert run.supply.pump.flow[-1] / L_MIN == pytest.approx(flow, rel=0.02)


@pytest.mark.parametrize(("speed", "power"), [(1500, 120.0), (3000, 202.0), (6000, 463.0)])
def test_straight_ahead_the_shaft_takes_what_drag_and_circulation_do(speed, power):
    run = driven(0.0, 0.0, 0.5, OPEN_INTAKE, f"drive.speed={speed} rpm")
    assert run.supply.pump.shaft_power[-1] == pytest.approx(power, rel=0.01)


@pytest.mark.parametrize(("speed", "power"), [(1500, 58.0), (3000, 139.0), (6000, 399.0)])
def test_with_the_intake_restrictor_it_takes_less(speed, power):
    run = driven(0.0, 0.0, 0.5, f"drive.speed={speed} rpm")
    assert run.supply.pump.flow[-1] / L_MIN == pytest.approx(3.15, rel=0.001)
    assert run.supply.pump.shaft_power[-1] == pytest.approx(power, rel=0.04)


@pytest.mark.parametrize(("speed", "pressure"), [(750, 3.0), (3000, 5.0)])
def test_without_current_it_circulates_at_3_to_5_bar(speed, pressure):
    supply = driven(0.0, 0.0, 0.5, OPEN_INTAKE, f"drive.speed={speed} rpm").supply
    assert supply.front_valve.pressure[-1] * 1e-5 == pytest.approx(pressure, rel=0.01)
    assert supply.front_valve.current[-1] == supply.rear_valve.current[-1] == 0.0


def test_what_circulates_costs_the_same_at_3000_and_at_6000_rpm_but_for_the_drag():
    slow, fast = (driven(500.0, 300.0, 1.0, f"drive.speed={speed} rpm").supply for speed in (3000, 6000))
    assert fast.pump.hydraulic_power[-1] == pytest.approx(slow.pump.hydraulic_power[-1], rel=1e-3)


# ---- rates and times


def test_the_whole_flow_turns_the_front_motor_at_103_deg_a_second_less_what_leaks_and_is_compressed():
    assert np.degrees(FLOW / D) == pytest.approx(103.0, rel=0.02)
    run = driven(1000.0, 0.0, 0.4, OPEN_INTAKE)
    middle = np.argmin(np.abs(run.front - 600.0))
    leaked = OWN_LEAKAGE * run.supply.front_valve.pressure[middle]
    expected = (FLOW - leaked) / D / (1.0 + C_FRONT * STIFFNESS / D**2)
    assert run.outputs.front.motor.rate[middle] == pytest.approx(expected, rel=0.02)


def test_idling_it_turns_at_63_deg_a_second():
    flow = driven(0.0, 0.0, 0.01, OPEN_INTAKE, AT_750).supply.pump.flow[-1]
    assert np.degrees(flow / D) == pytest.approx(63.0, rel=0.02)


def test_where_both_motors_move_they_share_the_flow():
    run = driven(1000.0, 600.0, 0.5, OPEN_INTAKE)
    rows = slice(*np.searchsorted(run.time, (0.08, 0.12)))  # both fill
    taken = D * (run.outputs.front.motor.rate + run.outputs.rear.motor.rate)
    for axle, capacitance in (("front", C_FRONT), ("rear", C_REAR)):
        taken = taken + capacitance * np.gradient(run.supply[f"{axle}_valve"].pressure, run.time)
    lost = OWN_LEAKAGE * run.supply.front_valve.pressure + 4e-13 * run.supply.rear_valve.pressure
    over = run.supply.rear_valve.loss_power / run.supply.rear_valve.pressure  # what passes both valves
    assert (taken + lost + over)[rows].mean() == pytest.approx(FLOW, rel=0.02)
    assert run.outputs.front.motor.rate[rows].mean() < 0.75 * FLOW / D


@pytest.mark.parametrize(
    ("settings", "rear", "front_time", "rear_time"),
    [((), 600.0, 0.17, 0.18), ((), 0.0, 0.106, None), ((AT_750,), 600.0, 0.28, 0.31), ((AT_750,), 0.0, 0.177, None)],
    ids=["3000 rpm", "front alone", "750 rpm", "front alone at 750 rpm"],
)
def test_from_rest_a_torque_takes_the_time_of_its_oil(settings, rear, front_time, rear_time):
    """As the reference counts: from the moment the direction valve is in place, without leakage and dry friction."""
    run = driven(1000.0, rear, 0.8, OPEN_INTAKE, *IDEAL, *settings)
    start = in_place(run)
    assert run.reaches(run.front, 900.0) - start == pytest.approx(front_time, rel=0.15)
    if rear_time:
        assert run.reaches(run.rear, 540.0) - start == pytest.approx(rear_time, rel=0.15)


def test_leakage_and_friction_and_the_direction_valve_make_it_slower():
    run, ideal = driven(1000.0, 600.0, 2.0, OPEN_INTAKE), driven(1000.0, 600.0, 0.8, OPEN_INTAKE, *IDEAL)
    assert 0.0 < run.reaches(run.front, 900.0) - ideal.reaches(ideal.front, 900.0) < 0.03
    assert in_place(run) == pytest.approx(0.02, abs=0.005)
    assert run.front[-1] == pytest.approx(1000.0, rel=0.01)
    assert run.rear[-1] == pytest.approx(600.0, rel=0.01)


def test_a_front_valve_that_works_against_the_return_line_fills_the_front_first():
    absolute = driven(1000.0, 600.0, 1.0, OPEN_INTAKE, "block.front_reference=return")
    difference = driven(1000.0, 600.0, 1.0, OPEN_INTAKE)
    assert absolute.reaches(absolute.front, 900.0) < 0.75 * difference.reaches(difference.front, 900.0)
    assert absolute.front[-1] == pytest.approx(difference.front[-1], rel=0.01)


def test_the_oil_of_the_front_swings_at_its_mode_while_the_valves_are_shut():
    """D/sqrt(Theta C) = 399 rad/s, and the bar's own torsion beside it."""
    p = parameters(
        "front.motor.coulomb_friction=0 Nm",
        "block.direction_valve.flow=90 L/min",
        "block.fail_safe_valve.flow=90 L/min",
    )
    state = np.zeros(1, system.STATE["state"]).view(np.recarray)[0]
    state.supply.front_pressure = state.front.chamber_a = state.supply.rear_pressure = state.rear.chamber_a = 50e5
    state.supply.spool = state.supply.fail_safe = 1.0
    shut = Demand(Setting(FLOW, 0.0, 1.1, 1.1, 1.0, 1.0), 0.0, 0.0)
    state.supply.front_current = state.supply.rear_current = 1.1
    state.front.chamber_b = state.rear.chamber_b = 1.4e5
    found = np.linalg.eigvals(slopes(system._derivatives, p, shut, state, scales(State)))
    expected = math.hypot(D / math.sqrt(THETA * C_FRONT), math.sqrt(STIFFNESS / THETA))
    assert D / math.sqrt(THETA * C_FRONT) == pytest.approx(399.0, rel=0.05)
    assert min(abs(abs(found.imag) - expected)) < 0.05 * expected


# ---- power


@pytest.mark.parametrize(("share", "hydraulic", "shaft"), [(0.3, 571.0, 747.0), (0.5, 902.0, 1110.0)])
def test_a_held_bend_takes_the_whole_flow_at_the_front_pressure(share, hydraulic, shaft):
    """The reference also asks for the pressure of the dry friction; but once the motor stands nothing opposes it."""
    front, rear = 919.0 * share, 613.0 * share
    run = driven(lambda t: smooth(t, (0, 0), (0.5, front)), lambda t: smooth(t, (0, 0), (0.5, rear)), 4.0)
    power = run.supply.pump.hydraulic_power[-1]
    assert power == pytest.approx(FLOW * (front / D + 1.4e5), rel=0.005)
    assert power + FLOW * 35.0 / D == pytest.approx(hydraulic, rel=0.08)
    assert run.supply.pump.shaft_power[-1] == pytest.approx(shaft, rel=0.08)


def test_the_largest_hydraulic_power_is_2_8_kw():
    run = driven(1501.0, 1000.0, 1.0)
    assert run.supply.pump.hydraulic_power.max() == pytest.approx(FLOW * 185e5, rel=0.03)


def test_the_front_alone_sets_what_the_pump_takes():
    powers = [driven(1000.0, rear, 1.5).supply.pump.shaft_power[-1] for rear in (0.0, 300.0, 600.0, 900.0)]
    assert powers == pytest.approx([powers[0]] * 4, rel=0.02)


def test_a_rear_that_asks_for_more_raises_the_front():
    run = driven(0.0, 600.0, 1.5)
    assert run.rear[-1] == pytest.approx(600.0, rel=0.01)
    assert run.front[-1] == pytest.approx(run.rear[-1] + 1.8e5 * D, rel=0.02)


def test_the_front_pressure_is_never_below_the_rear():
    def swing(time):
        return smooth(time, (0, 0), (0.3, 900), (0.6, -900), (0.9, -100), (1.2, -1200), (1.4, 0))

    runs = [driven(swing, lambda t, share=share: share * swing(t), 1.6) for share in (0.0, 0.67, 1.0, 1.5)]
    for run in [*runs, driven(1000.0, 600.0, 0.5), driven(600.0, 1000.0, 0.5, AT_750)]:
        assert (run.supply.front_valve.pressure >= run.supply.rear_valve.pressure).all()


# ---- the fail-safe valve


@pytest.mark.parametrize(("leakage", "expected"), [(LEAKAGE, 6.97), (5 * LEAKAGE, 1.39)], ids=["new", "worn"])
def test_a_sealed_front_motor_lets_go_by_its_leakage_alone(leakage, expected):
    assert D**2 / (leakage * STIFFNESS) == pytest.approx(expected, rel=0.005)
    run = driven(
        lambda t: smooth(t, (0, 0), (0.5, 800)),
        lambda t: smooth(t, (0, 0), (0.5, 500)),
        3.0,
        f"front.motor.leakage={leakage} m^3/s/Pa",
        "front.motor.coulomb_friction=0 Nm",
        fail_safe=lambda t: float(t < 1.0),
    )
    rows = run.time > 1.2
    tau = -1.0 / np.polyfit(run.time[rows], np.log(run.front[rows]), 1)[0]
    chambers = 7.5e-14 / 2.0  # both in series unload with the bar
    assert tau == pytest.approx((D**2 / STIFFNESS + chambers) / leakage, rel=0.01)
    assert tau == pytest.approx(expected, rel=0.05)
    # the rear lets go, and the pump circulates
    assert run.rear[-1] < 40.0
    assert run.supply.front_valve.pressure[-1] == pytest.approx(5e5, rel=0.02)


def test_an_s_curve_of_the_front_alone_takes_36_4_kj_of_hydraulic_work():
    energy = recording("bench_s_curve", "valve_controlled")
    work = energy["supply.energy.shaft"][-1] - energy["supply.energy.pump"][-1]
    assert work == pytest.approx(36.4e3, rel=0.05)
