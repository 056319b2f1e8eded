"""What the mass of the lines' oil costs."""

import math

import control
import numpy as np
import pytest
from bench import drive
from full_theory import FRONT, REAR, held, softness

from ars_mujoco.analysis.line_inertance import (
    counted_inertia,
    hydraulic_pair,
    limits,
    reflected_inertia,
    with_pipe,
    without_oil_mass,
)
from ars_mujoco.analysis.linearization import actuator
from ars_mujoco.analysis.margins import margins
from ars_mujoco.analysis.running_loop import step_response

LIMITS = {
    (name, checks, way): limits(build(hold(loop)))
    for name, loop in (("front", FRONT), ("rear", REAR))
    for checks, hold in (("shut", lambda loop: loop), ("held", held))
    for way, build in (("without", without_oil_mass), ("with", lambda loop: loop))
}


def ratio(name, checks, quantity):
    return LIMITS[name, checks, "with"][quantity] / LIMITS[name, checks, "without"][quantity]


def test_the_oil_of_both_lines_is_several_times_the_motor_s_inertia():
    assert reflected_inertia(FRONT) == pytest.approx(0.50, abs=0.01)
    assert reflected_inertia(REAR) == pytest.approx(0.89, abs=0.01)
    two_metres = with_pipe(FRONT, length=2.0, diameter=12.7e-3)
    assert reflected_inertia(two_metres) == pytest.approx(0.18, abs=0.01)
    assert REAR.circuit.motor.inertia == 0.175


@pytest.mark.parametrize(("loop", "frequency"), [(FRONT, 539), (REAR, 422)])
def test_without_mass_the_frequency_is_that_of_eq_43_with_the_series_capacitance(loop, frequency):
    motor, pipe = loop.circuit.motor, loop.detail.pipe
    volume = 0.25 * math.pi * pipe.diameter**2 * pipe.length + motor.displacement * motor.stop_angle
    series = 0.5 * volume * softness(loop, 2.042e6)
    found, _ = hydraulic_pair(without_oil_mass(loop))
    assert found == pytest.approx(motor.displacement / math.sqrt(series * motor.inertia), rel=0.01)
    assert found == pytest.approx(frequency, abs=1)


@pytest.mark.parametrize(("loop", "counted"), [(FRONT, 0.129), (REAR, 0.309)])
def test_a_quarter_to_a_third_of_the_oil_counts_as_if_it_were_on_the_motor(loop, counted):
    assert counted_inertia(loop) == pytest.approx(counted, abs=0.002)
    motor = without_oil_mass(loop).at({"inertia": loop.circuit.motor.inertia + counted_inertia(loop)})
    assert hydraulic_pair(motor)[0] == pytest.approx(hydraulic_pair(loop)[0], rel=0.01)


def test_all_of_it_on_the_motor_would_overstate_what_it_does():
    heavy = without_oil_mass(REAR).at({"inertia": REAR.circuit.motor.inertia + reflected_inertia(REAR)})
    assert hydraulic_pair(heavy)[0] == pytest.approx(171, abs=2)


def test_with_mass_it_is_409_and_254_rad_s():
    assert LIMITS["front", "shut", "with"]["frequency"] == pytest.approx(409, abs=1)
    assert LIMITS["rear", "shut", "with"]["frequency"] == pytest.approx(254, abs=1)


def test_the_rear_s_stable_gain_halves_and_the_front_s_loses_a_sixth():
    assert LIMITS["rear", "shut", "without"]["stable"] == pytest.approx(189, abs=0.5)
    assert LIMITS["rear", "shut", "with"]["stable"] == pytest.approx(105.4, abs=0.1)
    assert ratio("rear", "shut", "stable") == pytest.approx(0.56, abs=0.01)
    assert ratio("front", "shut", "stable") == pytest.approx(0.85, abs=0.01)


def test_with_the_low_side_held_both_lose_more():
    assert ratio("rear", "held", "stable") == pytest.approx(0.40, abs=0.01)
    assert ratio("front", "held", "stable") == pytest.approx(0.60, abs=0.01)


def test_the_rear_s_larger_volume_alone_hardly_moves_the_boundary():
    front, rear = (LIMITS[name, "shut", "without"]["stable"] for name in ("front", "rear"))
    assert rear > 0.95 * front


def test_a_shorter_line_costs_less():
    gains = [limits(with_pipe(REAR, length=length))["stable"] for length in (1.0, 2.0, 4.0, 8.0)]
    assert np.all(np.diff(gains) < 0)


def test_more_lumps_converge_with_their_square():
    gains = [limits(with_pipe(REAR, lumps=lumps))["stable"] for lumps in (1, 2, 4)]
    assert (gains[1] - gains[0]) / (gains[2] - gains[1]) == pytest.approx(4, rel=0.15)
    assert gains[2] == pytest.approx(gains[0], rel=0.055)  # 5.0 % above it


@pytest.mark.parametrize("loop", [FRONT, REAR, held(FRONT), held(REAR), with_pipe(REAR, lumps=4)])
def test_limits_are_where_margins_end(loop):
    system, found = actuator(loop)["angle", "stroke_command"], limits(loop)
    assert np.all(control.feedback(0.999 * found["stable"] * system).poles().real < 0)
    assert np.any(control.feedback(1.001 * found["stable"] * system).poles().real > 0)
    assert margins(found["gain_margin"] * system)["gain_margin"] == pytest.approx(6, abs=0.01)
    assert margins(0.99 * found["phase_margin"] * system)["phase_margin"] > 45
    assert margins(1.01 * found["phase_margin"] * system)["phase_margin"] < 45


@pytest.mark.parametrize(("share", "grows"), [(0.95, False), (1.05, True)])
def test_the_running_circuit_begins_to_oscillate_at_the_limit_with_both_checks_shut(share, grows):
    gain = share * LIMITS["rear", "shut", "with"]["stable"]
    angle = np.degrees(step_response(REAR.without_dry_friction(), gain, math.radians(0.02), 1e-3, 1000))
    early, late = (np.ptp(angle[start : start + 250]) for start in (250, 750))
    assert (late > early) == grows


def test_between_the_two_limits_it_trembles_no_wider_than_the_leakage_lets_it():
    gain = 100.0
    assert LIMITS["rear", "held", "with"]["stable"] < gain < LIMITS["rear", "shut", "with"]["stable"]
    angle = np.degrees(step_response(REAR.without_dry_friction(), gain, math.radians(0.02), 1e-3, 2000))
    assert 1e-4 < np.ptp(angle[1500:]) < 2e-3


def test_on_the_bench_a_gain_between_is_stable_without_the_oil_s_mass_and_swings_with_it(tmp_path):
    (tmp_path / "step.yaml").write_text(
        "title: Step\ndescription: One degree.\nrig: bench\nduration: 1.5 s\n"
        "manoeuvre: {kind: bar_command, command: {join: step, knots: [[0 s, 1 deg]]}}\n"
    )
    rear = (
        "actuator=pump_controlled_full",
        "actuator.front.pipe.length=5.98 m",
        "actuator.control.loop.gain=141 1/rad",
    )
    light = ("actuator.front.oil.density=0.86 kg/m^3", "actuator.front.oil.viscosity_40=32e3 mm^2/s",
             "actuator.front.oil.viscosity_100=5.4e3 mm^2/s")  # fmt: skip
    swings = {}
    for name, settings in (("with", rear), ("without", rear + light)):
        run = drive(tmp_path / "step.yaml", *settings)
        swings[name] = np.degrees(np.ptp(run["front.bar.angle"][run.time > 1.2]))
    assert swings["without"] < 0.02
    assert swings["with"] > 1.0
