"""In the car, with the 10 ms that sensors and bus take: how flat it is, and what that costs at the crankshaft."""

from functools import cache

import numpy as np
import pytest

from ars_mujoco.studies.inputs import read_compared
from ars_mujoco.studies.study import study

pytestmark = pytest.mark.slow


@cache
def driven(cycle: str, *settings: str):
    runs, references = read_compared(cycle, ["valve_controlled"], settings=settings)
    (result,) = study(runs, references, None, lambda name, share: None)
    return result


@pytest.mark.parametrize(("cycle", "least"), [("s_curve_120kmh", 7.0), ("step_steer_iso7401", 6.0)])
@pytest.mark.parametrize("speed", [750, 1500, 3000])
def test_it_holds_the_car_flat(cycle, least, speed):
    result = driven(cycle, f"actuator.drive.speed={speed} rpm")
    assert result.metrics["roll_reduction_factor"].value >= least
    assert result.metrics["energy_audit_error"].value <= 1e-3


@pytest.mark.parametrize(("speed", "energy"), [(1500, 19.5e3), (3000, 22.4e3), (6000, 30.3e3)])
def test_an_s_curve_takes_what_the_reference_expects_of_the_shaft(speed, energy):
    result = driven("s_curve_120kmh", "controller=level", f"actuator.drive.speed={speed} rpm")
    assert result.metrics["shaft_energy"].value == pytest.approx(energy, rel=0.15)


@pytest.mark.parametrize("cycle", ["s_curve_120kmh", "step_steer_iso7401"])
def test_the_front_pressure_is_never_below_the_rear(cycle):
    run = driven(cycle).recording
    assert (run["supply.front_valve.pressure"] >= run["supply.rear_valve.pressure"]).all()


def test_on_a_steady_circle_its_roll_is_the_published_curve():
    """0 deg to 0.3 g, 0.3 deg at 0.6 g, 1.3 deg at 0.8 g (BMW Dynamic Drive), as the controller's target has it."""
    result = driven("steady_circle_iso4138")
    assert result.metrics["target_map_error"].value <= 0.15  # deg
    run = result.recording
    roll = np.interp(
        np.array([0.3, 0.6, 0.8]) * 9.80665, run["body.lateral_acceleration"], np.degrees(run["body.roll"])
    )
    assert roll == pytest.approx([0.0, 0.3, 1.3], abs=0.15)


def test_with_the_front_sealed_and_the_rear_free_it_rolls_3_1_deg_a_g():
    """As the reference counts: without leakage, which lets the bar go with 7 s. The sealed chambers' oil makes the
    bar 6 % softer, and this car rolls 3.4 deg/g with a front bar that is held.
    """
    sealed = "inputs={front_fail_safe: {join: step, knots: [[0 s, 1], [0.1 s, 0]]}}"
    run = driven("step_steer_iso7401", sealed, "actuator.front.motor.leakage=0 m^3/s/Pa").recording
    gradient = np.degrees(run["body.roll"][-1]) / (run["body.lateral_acceleration"][-1] / 9.80665)
    assert gradient == pytest.approx(3.1, rel=0.15)


def test_the_engine_with_its_belt_drives_it_as_well():
    result = driven("s_curve_120kmh", "actuator.drive={kind: engine, idle_speed: 650 rpm, pump_ratio: 1.15}")
    assert result.metrics["roll_reduction_factor"].value >= 7.0
    assert result.recording["supply.pump.speed"].max() > 300.0
