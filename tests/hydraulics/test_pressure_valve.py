"""The pressure valve: current to setting with its hysteresis, opening and override, and a node that it holds."""

import gzip
import math
from pathlib import Path

import numpy as np
import pytest
from records import filled
from scipy.integrate import solve_ivp

from ars_mujoco.hydraulics.pressure_valve import (
    PressureValve,
    between_stops,
    current_for,
    hysteresis_rate,
    open_pressure,
    opening_wanted,
    setting_for,
    setting_pressure,
    valve_flow,
)

REFERENCE = Path(__file__).parents[3] / "shared/data/reference/circuits"
BAR, L_MIN = 1e5, 1e-3 / 60.0
FILE = {
    "resistance": "7 ohm", "current_lag": "5 ms", "least_current": "0.15 A", "current_limit": "1.1 A",
    "pressure_range": "180 bar", "hysteresis": "3 %", "turning_current": "30 mA", "flow": "9 L/min",
    "pressure": "1.6 bar", "laminar_pressure": "1 Pa", "override": "0.4 bar*min/L", "normal_pressure": "70 bar",
    "flow_force_share": "0.5", "spool_lag": "8 ms", "leakage": "0 m^3/s/Pa",
}  # fmt: skip


def valve(**changes: str):
    return filled(PressureValve(**FILE | changes))


def test_its_setting_goes_with_the_current_over_the_least():
    assert setting_pressure(valve(), 0.15, 0.0) == pytest.approx(0.0, abs=1e-6)
    assert setting_pressure(valve(), 1.1, 0.0) == pytest.approx(180 * BAR)
    assert setting_pressure(valve(), 0.0, 0.0) < 0.0


@pytest.mark.parametrize("setting", [0.0, 50 * BAR, 180 * BAR])
def test_a_current_is_found_for_a_setting(setting):
    assert setting_pressure(valve(), current_for(valve(), setting), 0.0) == pytest.approx(setting, abs=1e-3)


def test_no_coil_is_asked_for_more_than_it_can():
    assert current_for(valve(), 300 * BAR) == 1.1
    assert current_for(valve(), -100 * BAR) == 0.0


def swept(low: float, high: float, seconds: float) -> tuple[float, float]:
    """The settings (Pa) at the middle of a current that rises from `low` to `high` (A) and falls again."""
    own, settings, turned = valve(), [], 0.0
    for rate in ((high - low) / seconds, (low - high) / seconds):
        current, steps = (low if rate > 0.0 else high), 2000
        for _ in range(steps):
            turned += seconds / steps * hysteresis_rate(own, turned, rate)
            current += seconds / steps * rate
            if abs(current - 0.5 * (low + high)) < 0.5 * abs(rate) * seconds / steps:
                settings.append(setting_pressure(own, current, turned))
    return settings[0], settings[-1]


@pytest.mark.parametrize("seconds", [0.05, 5.0])
def test_its_loop_is_3_percent_of_the_range_wide_however_slow(seconds):
    rising, falling = swept(0.2, 1.0, seconds)
    assert falling - rising == pytest.approx(0.03 * 180 * BAR, rel=0.01)


def test_a_current_that_stands_keeps_its_side_of_the_loop():
    assert hysteresis_rate(valve(), 0.7, 0.0) == 0.0


def test_it_is_shut_up_to_its_setting_and_open_far_over_it():
    assert between_stops(opening_wanted(valve(), 99 * BAR, 100 * BAR, 99 * BAR)) == 0.0
    assert between_stops(opening_wanted(valve(), 250 * BAR, 50 * BAR, 250 * BAR)) == 1.0


def test_the_further_its_pressure_is_under_the_setting_the_faster_it_shuts():
    wanted = [opening_wanted(valve(), 10 * BAR, setting * BAR, 10 * BAR) for setting in (11, 50, 100)]
    assert 0.0 > wanted[0] > wanted[1] > wanted[2]


def test_at_its_normal_pressure_the_override_is_0_4_bar_a_litre_a_minute():
    own = valve()
    for litres in (2.0, 9.0):
        opening = opening_wanted(own, 70 * BAR, (70 - 0.4 * litres) * BAR, 70 * BAR)
        assert valve_flow(own, opening, 70 * BAR) / L_MIN == pytest.approx(litres, rel=1e-9)


@pytest.mark.parametrize("pressure", [20 * BAR, 70 * BAR, 150 * BAR])
def test_the_setting_for_a_pressure_is_the_one_at_which_the_flow_passes(pressure):
    own, flow = valve(), 7 * L_MIN
    setting = setting_for(own, pressure, pressure, flow)
    assert valve_flow(own, opening_wanted(own, pressure, setting, pressure), pressure) == pytest.approx(flow, rel=1e-9)


@pytest.mark.parametrize("laminar", ["1 Pa", "0.6 bar"])
def test_fully_open_it_takes_1_6_bar_at_9_litres_a_minute(laminar):
    own = valve(laminar_pressure=laminar)
    assert open_pressure(own, 9 * L_MIN) == pytest.approx(1.6 * BAR, rel=1e-9)
    for litres in (1.0, 5.5):
        pressure = open_pressure(own, litres * L_MIN)
        assert valve_flow(own, 1.0, pressure) / L_MIN == pytest.approx(litres, rel=1e-9)


def test_a_small_flow_is_laminar():
    own = valve(laminar_pressure="0.6 bar")
    assert open_pressure(own, 2e-3 * L_MIN) == pytest.approx(2.0 * open_pressure(own, 1e-3 * L_MIN), rel=1e-5)


# ---- a relief valve of the same law on a volume, as a peer solved it

VOLUME, FLOW, TANK, DISCHARGE = 1e-3 / 1e9, 5e-4, 1e5, 0.67 * math.sqrt(2.0 / 890.0)
RELIEF = valve(
    flow="1e-3 m^3/s", pressure="70 bar", override="2e8 Pa*s/m^3", normal_pressure="70 bar", spool_lag="10 ms"
)


def held(times):
    """Pressures (Pa) of the volume, its orifice closing from 1e-6 to 3e-7 m^2 at 0.5 s."""

    def rate(area):
        def of(t, y):
            over = y[0] - TANK
            flow = valve_flow(RELIEF, y[1], over) + DISCHARGE * area * math.copysign(math.sqrt(abs(over)), over)
            moving = (opening_wanted(RELIEF, y[0], 200 * BAR, over) - y[1]) / RELIEF.spool_lag
            return (FLOW - flow) / VOLUME, moving if y[1] > 0.0 or moving > 0.0 else 0.0

        return of

    first = solve_ivp(rate(1e-6), (0.0, 0.5), (TANK, 0.0), "LSODA", times[times < 0.5], rtol=1e-9, atol=(1.0, 1e-9))
    last = solve_ivp(rate(1e-6), (0.0, 0.5), (TANK, 0.0), "LSODA", rtol=1e-9, atol=(1.0, 1e-9)).y[:, -1]
    second = solve_ivp(rate(3e-7), (0.5, 1.0), last, "LSODA", times[times >= 0.5], rtol=1e-9, atol=(1.0, 1e-9))
    return np.concatenate((first.y[0], second.y[0]))


def test_as_a_relief_valve_it_holds_a_volume_at_the_closed_form():
    pressures = held(np.array([0.49, 1.0]))
    assert pressures / BAR == pytest.approx([200.8168, 201.0438], abs=0.001)


@pytest.mark.skipif(not REFERENCE.is_dir(), reason=f"the peer's solution is not at {REFERENCE}")
def test_as_a_relief_valve_it_agrees_with_a_peer():
    with gzip.open(REFERENCE / "a_relief.csv.gz", "rt") as file:
        peer = np.genfromtxt(file, delimiter=",", names=True)
    pressures = held(peer["t"])
    settled = ((peer["t"] > 0.3) & (peer["t"] < 0.5)) | (peer["t"] > 0.8)
    assert pressures[settled] == pytest.approx(peer["p"][settled], abs=0.01 * BAR)
    assert pressures == pytest.approx(peer["p"], abs=0.01 * peer["p"].max())
