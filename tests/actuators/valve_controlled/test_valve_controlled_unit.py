"""The control unit: which way, when, how precisely; its test before driving off."""

import numpy as np
import pytest
from valve_runs import AT_750, D, driven, smooth

KMH = 1.0 / 3.6
SWING = ((0, 0), (0.5, 800), (1.0, 800), (2.0, -800), (3.0, -800))


def swing(time):
    return smooth(time, *SWING)


@pytest.fixture(scope="module")
def swung():
    return driven(swing, lambda t: 0.667 * swing(t), 3.0)


def test_pressures_follow_the_torques_and_sensors_find_what_valves_leave(swung):
    for torque, wanted in ((swung.front, 800.0), (swung.rear, 533.6)):
        held = torque[np.searchsorted(swung.time, 0.99)]
        assert held == pytest.approx(wanted, abs=15.0)  # the dry friction, 35 Nm, lets go within a second
        assert torque[-1] == pytest.approx(-wanted, abs=5.0)


def test_without_its_loops_hysteresis_is_left(swung):
    loose = driven(swing, lambda t: 0.667 * swing(t), 1.0, "control.authority=0 bar")
    tight = np.searchsorted(swung.time, 0.9)
    assert abs(loose.front[tight] - 800.0) > 1.5 * abs(swung.front[tight] - 800.0)


def test_it_follows_a_changing_torque_by_15_ms(swung):
    rows = slice(*np.searchsorted(swung.time, (1.2, 1.42)))
    late = np.interp(swung.front[rows], [swing(t) for t in swung.time[1000:2000]][::-1], swung.time[1000:2000][::-1])
    assert np.mean(swung.time[rows] - late) == pytest.approx(0.013, abs=0.004)


def test_the_direction_valve_moves_only_at_low_pressure(swung):
    moving = np.abs(np.diff(swung.supply.switching.direction)) > 1e-3
    assert moving.sum() > 30
    highest = np.maximum(swung.supply.front_valve.pressure, swung.supply.rear_valve.pressure)[:-1][moving]
    assert highest[swung.time[:-1][moving] > 0.1].max() < 8e5


def test_pressure_is_raised_only_where_the_direction_valve_is_in_place(swung):
    supply = swung.supply
    raised = supply.unit.front_pressure > 0.0
    assert (np.abs(supply.switching.direction[raised] - supply.unit.side[raised]) < 0.1).all()


def test_a_direction_valve_that_sticks_gives_no_torque_to_the_wrong_side():
    run = driven(800.0, 500.0, 0.5, "block.direction_valve.time=1e6 s")
    assert np.abs(run.front).max() < 1.0
    assert run.supply.front_valve.current.max() == 0.0


def test_an_axle_cannot_be_given_a_torque_to_the_other_side():
    run = driven(800.0, -300.0, 1.0)
    assert run.front[-1] == pytest.approx(800.0, rel=0.02)
    assert 0.0 <= run.rear[-1] < 30.0


def test_straight_ahead_both_motors_lie_at_the_return_line():
    run = driven(0.0, 0.0, 0.5)
    assert np.abs(run.front).max() == np.abs(run.rear).max() == 0.0
    assert run.supply.switching.direction[-1] == 0.0


def test_less_than_the_least_torque_leaves_the_direction_valve_centred():
    assert driven(8.0, 5.0, 0.3).supply.unit.side.max() == 0.0
    assert driven(12.0, 8.0, 0.3).supply.unit.side.max() == 1.0


def test_it_acts_from_15_km_h_and_no_longer_below_12():
    run = driven(500.0, 300.0, 3.0, road_speed=lambda t: KMH * (5.0 + 15.0 * np.sin(np.pi * t / 3.0)))
    speed = 5.0 + 15.0 * np.sin(np.pi * run.time / 3.0)
    rows = np.flatnonzero(np.diff(run.supply.unit.active))
    assert speed[rows] == pytest.approx([15.0, 12.0], abs=0.2)
    assert np.abs(run.front[speed < 11.5][-1]) < 80.0
    assert run.front.max() == pytest.approx(500.0, rel=0.1)


def test_the_intake_opens_as_a_torque_is_asked_for_and_closes_2_s_after():
    run = driven(lambda t: 300.0 if 0.5 < t < 1.0 else 0.0, 0.0, 4.0)
    share = np.interp([0.4, 0.5 + 0.15, 1.0, 2.9, 3.1 + 0.15, 4.0], run.time, run.supply.pump.intake)
    opened = 1.0 - 0.65 * np.exp(-1.0)
    assert share[:2] == pytest.approx([0.35, opened], abs=0.01)
    assert share[2] > 0.97 and share[3] > 0.999
    assert share[4] < 0.6
    assert share[5] == pytest.approx(0.35, abs=0.01)


# ---- before driving off


def standing(*settings, **given):
    return driven(0.0, 0.0, 0.5, AT_750, *settings, road_speed=0.0, **given)


def test_before_driving_off_a_pressure_under_60_bar_proves_both_valves():
    run = standing()
    assert 45e5 < run.supply.front_valve.pressure.max() < 60e5
    assert run.supply.unit.failed[-1] == 0.0
    assert run.supply.switching.fail_safe[-1] == pytest.approx(1.0, abs=1e-9)
    assert max(np.abs(run.front).max(), np.abs(run.rear).max()) < 15.0


def test_a_car_that_drives_has_passed_it():
    run = driven(0.0, 0.0, 0.3, AT_750, road_speed=20.0)
    assert run.supply.front_valve.pressure.max() < 5e5


def test_a_fail_safe_valve_that_does_not_shut_fails_it():
    run = standing("block.fail_safe_valve.time=1e6 s")
    assert run.supply.unit.failed[-1] == 1.0


def test_a_front_pressure_valve_that_does_not_hold_fails_it():
    run = standing("block.front_valve.leakage=1e-10 m^3/s/Pa")
    assert run.supply.unit.failed[-1] == 1.0
    assert run.supply.switching.fail_safe[-1] == pytest.approx(0.0, abs=1e-9)


def test_after_a_failed_test_it_does_not_act():
    speed = lambda t: 0.0 if t < 0.5 else 20.0  # noqa: E731
    run = driven(600.0, 400.0, 1.0, AT_750, "block.fail_safe_valve.time=1e6 s", road_speed=speed)
    assert run.supply.unit.active.max() == 0.0
    assert run.supply.front_valve.pressure[-1] < 5e5


def test_the_torque_that_its_sensors_tell_is_that_of_the_pressures(swung):
    difference = swung.supply.front_valve.pressure - 1.4e5
    rows = np.flatnonzero((swung.time > 0.6) & (swung.time < 0.9))
    assert D * difference[rows] == pytest.approx(swung.front[rows], abs=40.0)
