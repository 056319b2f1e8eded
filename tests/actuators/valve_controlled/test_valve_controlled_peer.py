"""Both pressure valves in series under given settings, against a peer's solution of the same circuit (Hopsan).

Its motors hang on the nodes: the edges of the direction valve are made wide, friction is viscous, and no spool leaks.
"""

import gzip
import json
from pathlib import Path

import numpy as np
import pytest
from test_valve_controlled_numerics import steps
from valve_runs import FLOW, parameters

REFERENCE = Path(__file__).parents[4] / "shared/data/reference/circuits"
pytestmark = pytest.mark.skipif(not REFERENCE.is_dir(), reason=f"the peer's solution is not at {REFERENCE}")

VALVE = ("hysteresis=0 %", "pressure=1.6 bar", "laminar_pressure=0.02 bar", "leakage=0 m^3/s/Pa")
SETTINGS = (
    *(f"block.{axle}_valve.{each}" for axle in ("front", "rear") for each in VALVE),
    *(f"block.{name}.flow=60 L/min" for name in ("direction_valve", "fail_safe_valve")),
    "block.direction_valve.leakage=0 m^3/s/Pa",
    "block.return_pressure=1.8 bar",
    "pump.leakage=0 m^3/s/Pa",
    "front.motor.coulomb_friction=0 Nm",
    "rear.motor.coulomb_friction=0 Nm",
)
IDLE, RETURN = -12e5, 1.8e5  # Pa
UP, DOWN = 0.5, 1.5  # s
FINE = 150  # substeps: wide edges are stiff


def current(setting: float) -> float:
    return 0.15 + 0.95 / 180e5 * setting


class Case:
    """A case of the peer, and the running circuit under the same settings, at the peer's times."""

    def __init__(self, name: str, reference: str):
        with gzip.open(REFERENCE / f"{name}.csv.gz", "rt") as file:
            self.peer = np.genfromtxt(file, delimiter=",", names=True)
        self.summary = json.loads((REFERENCE / "b_summary.json").read_text())[name]
        # the peer's absolute settings are over the tank, here they are over the return line
        over = (RETURN if reference == "return" else 0.0), RETURN
        front, rear = (1e5 * self.summary[f"set_{axle}_bar"] for axle in ("front", "rear"))
        idle = (current(IDLE - over[0]), current(IDLE - over[1]), 1.0)
        pieces = ((0.0, *idle), (UP, current(front - over[0]), current(rear - over[1]), 1.0), (DOWN, *idle))
        p = parameters(*SETTINGS, f"block.front_reference={reference}")
        self.states = steps(p, self.peer["t"][-1], pieces, count=FINE)
        self.time = 1e-3 * np.arange(len(self.states))

    def torque(self, axle: str) -> np.ndarray:
        return 5700.0 * self.states.state[axle].angle

    def energy(self, name: str) -> float:
        values = self.states.energy.supply[name]
        return float(np.diff(np.interp([UP, DOWN], self.time, values))[0])


@pytest.fixture(scope="module", params=[("b1_q9", "return"), ("b1d_q9", "rear_node")], ids=["absolute", "difference"])
def case(request) -> Case:
    return Case(*request.param)


def test_it_circulates_at_5_0_and_3_4_bar(case):
    row = np.searchsorted(case.time, UP - 0.01)
    supply = case.states.state.supply[row]
    assert np.array([supply.front_pressure, supply.rear_pressure]) * 1e-5 == pytest.approx(
        case.summary["idle"][:2], rel=0.01
    )


def test_steady_pressures_and_torques_agree(case):
    row = np.searchsorted(case.time, DOWN - 0.005)
    supply = case.states.state.supply[row]
    assert np.array([supply.front_pressure, supply.rear_pressure]) * 1e-5 == pytest.approx(
        case.summary["end"]["p"], rel=0.003
    )
    assert [case.torque("front")[row], case.torque("rear")[row]] == pytest.approx(case.summary["end"]["M"], rel=0.003)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_times_agree(case, axle):
    rows = (case.time >= UP) & (case.time < DOWN)
    torque, time = case.torque(axle)[rows], case.time[rows] - UP
    peer = case.peer[f"M_{axle}"]
    end = peer[np.searchsorted(case.peer["t"], DOWN) - 1]
    reached = np.interp(0.9 * end, np.maximum.accumulate(torque), time)
    assert 1e3 * reached == pytest.approx(case.summary[f"t10_t90_ms_{axle}"][1], rel=0.03)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_peaks_agree(case, axle):
    rows = (case.time >= UP) & (case.time < DOWN)
    final = case.summary["end"]["M"][axle == "rear"]
    assert case.torque(axle)[rows].max() == pytest.approx(case.summary[f"peak_M_{axle}"], abs=0.005 * final)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_torques_agree_all_along(case, axle):
    rows = case.time > 0.2  # here the direction valve has yet to move
    peer = np.interp(case.time, case.peer["t"], case.peer[f"M_{axle}"])
    assert case.torque(axle)[rows] == pytest.approx(peer[rows], abs=0.01 * peer.max())


def test_energies_agree(case):
    expected = case.summary["energy_up"]
    drag = case.energy("pump")
    assert case.energy("shaft") - drag == pytest.approx(expected["pump"], rel=0.02)
    assert case.energy("front_valve") == pytest.approx(expected["pvv"], rel=0.03)
    # the peer counts the whole rise over the return line's pressure
    assert case.energy("rear_valve") == pytest.approx(expected["pvh"], rel=0.03)


def test_the_two_references_of_the_front_valve_differ_by_60_percent_in_time(case):
    assert pytest.approx(case.summary["Q_lpm"] * 1e-3 / 60.0) == FLOW
    times = [Case(*each).summary["t10_t90_ms_front"][1] for each in (("b1d_q9", "rear_node"), ("b1_q9", "return"))]
    assert times[0] / times[1] == pytest.approx(1.6, abs=0.05)
