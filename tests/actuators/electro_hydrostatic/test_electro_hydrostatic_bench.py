"""On the bench: how fast it is, what holding costs, what an S-curve takes (figures of `reference/systems.md`, 3.4)."""

import numpy as np
import pytest
from eha_runs import C_H, D_P, RATIO, RPM, STIFFNESS, WORN, D, bench_run, ramp_to, step_to
from shipped import recording

WORN_S_CURVE = tuple(f"actuator.{each}" for each in WORN)


@pytest.mark.parametrize(("torque", "expected"), [(200, 0.045), (500, 0.072), (1000, 0.134), (1200, 0.162)])
def test_a_torque_is_there_as_fast_as_the_pump_turns(torque, expected):
    run = bench_run(step_to(torque), 0.6)
    reached = np.maximum.accumulate(run["front.bar.torque"])
    start, end = np.interp([0.1 * torque, 0.9 * torque], reached, run.time)
    assert end - start == pytest.approx(expected, rel=0.2)
    assert reached[-1] == pytest.approx(torque, rel=0.01)


def test_at_its_speed_limit_the_pump_turns_the_bar_65_deg_a_second_less_what_the_oil_takes():
    run = bench_run(step_to(1200), 0.6)
    speed = run["front.pump.speed"].max()
    assert np.degrees(speed / RATIO) == pytest.approx(65.0, rel=0.03)
    # while a check valve holds the low side, oil of one side alone is compressed: 2 C_H beside the bar's D^2/c
    middle = np.argmin(np.abs(run["front.bar.torque"] - 600.0))
    flow = D_P * run["front.pump.speed"][middle] - 4e-13 * run["front.motor.pressure"][middle]
    stiff = 1.0 + 2.0 * C_H * STIFFNESS / D**2
    assert run["front.motor.rate"][middle] == pytest.approx(flow / D / stiff, rel=0.005)


def test_holding_600_it_creeps_at_96_rpm_and_takes_52_watts():
    run = bench_run(ramp_to(600), 8.0)
    assert run["front.pump.speed"][-1] / RPM == pytest.approx(96.0, rel=0.01)
    assert run["front.machine.power"][-1] == pytest.approx(52.0, rel=0.15)
    leakage = run["front.pump.leakage_power"][-1] + run["front.motor.leakage_power"][-1]
    assert leakage == pytest.approx(21.0, rel=0.15)
    assert leakage == pytest.approx(4e-13 * (600.0 / D) ** 2, rel=1e-4)


@pytest.mark.parametrize(
    ("settings", "electrical", "leakage"), [((), 2.26e3, 0.97e3), (WORN_S_CURVE, 6.65e3, 4.85e3)], ids=["new", "worn"]
)
def test_an_s_curve_takes_what_its_leakage_and_its_losses_do(settings, electrical, leakage):
    run = recording("bench_s_curve", "electro_hydrostatic", *settings)
    assert run["front.energy.electrical"][-1] == pytest.approx(electrical, rel=0.1)
    leaked = run["front.energy.pump_leakage"][-1] + run["front.energy.motor_leakage"][-1]
    assert leaked == pytest.approx(leakage, rel=0.1)


@pytest.mark.parametrize(("settings", "leakage"), [((), 4e-13), (WORN_S_CURVE, 2e-12)], ids=["new", "worn"])
def test_the_least_that_an_s_curve_can_take_is_what_leaks(settings, leakage):
    run = recording("bench_s_curve", "electro_hydrostatic", *settings)
    power = leakage * run["front.motor.pressure"] ** 2
    leaked = run["front.energy.pump_leakage"][-1] + run["front.energy.motor_leakage"][-1]
    assert leaked == pytest.approx(np.trapezoid(power, run.time), rel=1e-5)
    assert leaked < run["front.energy.electrical"][-1] - run["front.energy.bar"][-1]


def test_it_feeds_80_watts_back_at_most_as_the_bar_drives_it_on_an_s_curve():
    run = recording("bench_s_curve", "electro_hydrostatic")
    assert -run["front.machine.power"].min() == pytest.approx(80.0, rel=0.15)
