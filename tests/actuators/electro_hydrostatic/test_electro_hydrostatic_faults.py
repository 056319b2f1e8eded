"""Faults: phases open or shorted, valves tripped, a supply that sags (figures of `reference/systems.md`, 3.6, 11)."""

import math

import numpy as np
import pytest
from eha_runs import (
    BYPASS,
    C_H,
    D_P,
    FAIL_SAFE,
    NO_FRICTION,
    NO_LEAKAGE,
    RATIO,
    STIFFNESS,
    WORN,
    D,
    after,
    bench_run,
    ramp_to,
    step_to,
    switch,
    time_constant,
)
from shipped import recording

from ars_mujoco.schema.errors import InputError

TRIP = 1.0  # s
OIL = 1.0 + C_H * STIFFNESS / D**2  # how much longer all decays take because the oil unloads with the bar
BLOCKED = ("front.rotor_inertia=1e6 kg*m^2",)
OPEN, SHORTED = switch("phases", 1, 0, TRIP), switch("phases", 1, -1, TRIP)


def let_go(fault: str, *settings: str, torque: float = 100.0, seconds: float = 3.0):
    """(time, torque) of the bar from 0.2 s after a fault in a bar that was held."""
    run = bench_run(ramp_to(torque), TRIP + seconds, *settings, inputs=fault)
    rows = after(run, TRIP + 0.2)
    return run.time[rows], run["front.bar.torque"][rows]


def test_with_open_phases_the_rotor_swings_on_the_bar():
    time, torque = let_go(OPEN, *NO_FRICTION, *NO_LEAKAGE)
    crossings = time[1:][np.diff(np.sign(torque)) != 0]
    omega = math.pi / np.diff(crossings).mean()
    assert omega == pytest.approx(D_P / math.sqrt(4e-4 * (C_H + D**2 / STIFFNESS)), rel=0.01)


def test_with_open_phases_a_bar_is_free_but_for_the_friction_of_its_pump():
    _, torque = let_go(OPEN, torque=600.0)
    # D/D_p times what turns no gear: 0.08 of the norm and the machine's drag; and the motor's own dry friction
    friction = RATIO * (5.157 * 0.08 + 0.03) + 35.0
    assert abs(torque[-1]) < friction
    assert friction < 0.3 * 600.0


def test_shorted_it_lets_go_with_a_time_constant_of_4_8_s():
    braking = 1.5 * 4**2 * 0.020**2 / 0.030  # Nms/rad, 1.5 p^2 psi^2/R
    free_of_oil = braking * RATIO**2 / STIFFNESS
    assert free_of_oil == pytest.approx(4.8, rel=0.01)
    tau = time_constant(*let_go(SHORTED, *NO_FRICTION, *NO_LEAKAGE))
    assert tau == pytest.approx(free_of_oil * OIL, rel=0.01)
    assert tau == pytest.approx(4.99, rel=0.01)


def test_with_leakage_besides_it_takes_1_9_s():
    assert time_constant(*let_go(SHORTED, *NO_FRICTION)) == pytest.approx(1.9, rel=0.03)


@pytest.mark.parametrize(("worn", "expected"), [((), 6.97), (WORN, 1.39)], ids=["new", "worn"])
def test_behind_a_shut_fail_safe_valve_a_bar_is_locked_but_for_its_motor_s_leakage(worn, expected):
    fault = switch("fail_safe", 1, 0, TRIP)
    tau = time_constant(*let_go(fault, *FAIL_SAFE, *worn, "front.motor.coulomb_friction=0 Nm"))
    assert tau == pytest.approx(expected * (1.0 + 0.2 * (OIL - 1.0)), rel=0.01)  # a fifth of the oil is in the chambers


def test_behind_a_rotor_that_is_stuck_pump_and_motor_leak():
    run = bench_run(
        "{join: step, knots: [[0 s, 0 rad]]}", 3.0, *NO_FRICTION, *BLOCKED,
        ends="{join: smooth, knots: [[0 s, 0 mm], [0.1 s, -3 mm]]}", inputs=switch("phases", 1, 0, 1e-3),
    )  # fmt: skip
    late = after(run, 0.3)
    tau = time_constant(run.time[late], run["front.bar.torque"][late])
    assert tau == pytest.approx(3.05 * OIL, rel=0.01)


def test_an_open_bypass_lets_the_bar_go_at_once():
    _, torque = let_go(switch("bypass", 0, 1, TRIP), *BYPASS, torque=600.0)
    assert abs(torque[0]) < 40.0  # the motor's own dry friction


def test_a_tripped_circuit_is_not_pumped_against():
    for settings, fault in ((FAIL_SAFE, switch("fail_safe", 1, 0, TRIP)), (BYPASS, switch("bypass", 0, 1, TRIP))):
        run = bench_run(ramp_to(600), 3.0, *settings, inputs=fault)
        assert run["front.machine.power"][-1] < 20.0
        assert run["front.relief.power"].max() == 0.0


def test_a_released_motor_turns_with_its_ends_but_for_its_friction():
    run = recording("bench_ends_free", "electro_hydrostatic")
    late = after(run, 0.5)  # at the start the ends jerk
    rate, inertia = np.abs(run["front.motor.rate"][late]).max(), 0.175 * math.asin(0.02 / 0.15) * (3.0 * math.pi) ** 2
    assert np.abs(run["front.bar.torque"][late]).max() == pytest.approx(35.0 + 16.5 * rate, abs=inertia)
    assert np.abs(run["front.pump.speed"]).max() < 0.1


def test_a_valve_that_is_not_there_cannot_be_commanded():
    with pytest.raises(InputError, match=r"inputs.front_bypass: the actuator has no front.bypass_valve"):
        bench_run(ramp_to(600), 3.0, inputs=switch("bypass", 0, 1, TRIP))


def test_a_supply_that_sags_to_36_volts_takes_a_quarter_of_its_speed():
    full = bench_run(step_to(1200), 0.6)
    weak = bench_run(step_to(1200), 0.6, "supply.voltage=36 V", "supply.least_voltage=30 V")
    assert weak["front.pump.speed"].max() == pytest.approx(0.75 * full["front.pump.speed"].max(), rel=0.01)
    assert weak["front.bar.torque"][-1] == pytest.approx(1200.0, rel=0.01)
