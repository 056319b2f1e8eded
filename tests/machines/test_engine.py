"""Engine: speed from gear and road speed, and the hysteresis of its shifts."""

import numpy as np
import pytest
from records import filled

from ars_mujoco.machines.engine import GEARBOX, Engine, engine_speed, gear

RPM = np.pi / 30
ENGINE = Engine(kind="engine")
RECORD, TOP = filled(ENGINE), len(ENGINE.ratios) - 1
GEARS = np.zeros(1, GEARBOX).view(np.recarray)[0]
GEARS.count, GEARS.ratios[: len(ENGINE.ratios)] = len(ENGINE.ratios), ENGINE.ratios


def road_speed(rpm: float, number: int) -> float:
    """The road speed (m/s) at which the engine turns at `rpm` in gear `number`, 0 the first."""
    return rpm * RPM * ENGINE.rolling_radius / (ENGINE.ratios[number] * ENGINE.final_drive)


def driven(speeds, start=0.0) -> list[float]:
    """The gears along successive road speeds (m/s)."""
    chosen = [start]
    for speed in speeds:
        chosen.append(gear(RECORD, GEARS, chosen[-1], speed))
    return chosen[1:]


def test_a_standing_car_idles_in_first_gear():
    assert gear(RECORD, GEARS, float(TOP), 0.0) == 0.0
    assert engine_speed(RECORD, GEARS, 0.0, 0.0) == pytest.approx(800 * RPM)


@pytest.mark.parametrize("number", range(TOP + 1))
def test_the_engine_turns_as_fast_as_the_wheels_ask_through_gear_and_final_drive(number):
    expected = 20.0 / 0.313 * 3.38 * (4.23, 2.52, 1.66, 1.22, 1.0)[number]
    assert engine_speed(RECORD, GEARS, float(number), 20.0) == pytest.approx(min(expected, 6500 * RPM))


def test_at_100_km_h_in_fifth_gear_it_turns_at_2864_rpm():
    chosen = gear(RECORD, GEARS, 0.0, 100 / 3.6)
    assert chosen == 4.0
    assert engine_speed(RECORD, GEARS, chosen, 100 / 3.6) / RPM == pytest.approx(2864, abs=1)


def test_it_never_turns_faster_than_it_may():
    assert engine_speed(RECORD, GEARS, 0.0, 60.0) == pytest.approx(6500 * RPM)


def test_backwards_it_turns_as_forwards():
    assert engine_speed(RECORD, GEARS, 1.0, -5.0) == engine_speed(RECORD, GEARS, 1.0, 5.0)


@pytest.mark.parametrize("number", range(TOP))
def test_it_changes_up_above_the_one_speed_and_down_below_the_other_and_stays_between(number):
    up, down = road_speed(2800, number), road_speed(1500, number + 1)
    assert down < up
    assert driven([0.999 * up, 1.001 * up], float(number)) == [number, number + 1]
    assert driven([1.001 * down, 0.999 * down], number + 1.0) == [number + 1, number]
    between = np.linspace(1.001 * down, 0.999 * up, 50)
    assert set(driven(between, float(number))) == {number}
    assert set(driven(between, number + 1.0)) == {number + 1}


def test_from_a_stand_to_the_top_and_back_every_gear_comes_once_each_way():
    up = driven(np.linspace(0.0, 40.0, 4001))
    down = driven(np.linspace(40.0, 0.0, 4001), up[-1])
    assert np.all(np.diff(up) >= 0) and set(up) == set(range(TOP + 1))
    assert np.all(np.diff(down) <= 0) and set(down) == set(range(TOP + 1))


def test_a_car_that_starts_at_speed_starts_in_its_gear():
    assert driven([120 / 3.6] * 3) == [TOP] * 3
