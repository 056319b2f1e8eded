"""What the drive's speed does to the actuator: idle and 6000 rpm, an engine that is off, and who pays."""

import math

import numpy as np
import pytest
import shipped
from bench import STIFFNESS, circuit, drive
from test_energy import astray

from ars_mujoco.metrics.metric import G

RPM = math.pi / 30
H = 1e-3
BENCH, STEP_STEER, CIRCLE = "bench_s_curve", "step_steer_iso7401", "steady_circle_iso4138"
SCHEDULED = "actuator.control.loop.schedule=1"
ENGINE, ELECTRIC = "actuator.drive.kind=engine", "actuator.drive.kind=electric"
RATE_AND_PRESSURE = ("rate", "pressure")


def at(rpm: float) -> tuple[str, str]:
    return tuple(f"actuator.{axle}.pump.speed={rpm} rpm" for axle in ("front", "rear"))


def over_time(*knots: str) -> tuple[str, str]:
    return "actuator.drive.kind=table", f"actuator.drive.speed={{join: linear, knots: [{', '.join(knots)}]}}"


def lag(recording) -> float:
    """The largest error of the bar's angle, deg."""
    return np.degrees(np.abs(recording["front.bar.command"] - recording["front.bar.angle"])).max()


# ---- idle and 6000 rpm


def rate_by_the_flow(rpm: float, pressure: float) -> float:
    """Rate (rad/s) of the motor at full stroke: the flow, less what leaks, turns it and fills the oil as it loads."""
    parameters = circuit()
    pump, motor = parameters.pump, parameters.motor
    flow = pump.displacement * rpm * RPM - (pump.leakage + motor.leakage) * pressure
    return flow / (motor.displacement + parameters.line.capacitance * STIFFNESS / motor.displacement)


def test_at_idle_flow_limits_the_s_curve():
    recording = drive(BENCH, *at(800), SCHEDULED)
    stroke = recording["front.pump.stroke"]
    full = np.abs(stroke) > 0.9999
    rate, pressure = ((np.sign(stroke) * recording[f"front.motor.{name}"])[full].mean() for name in RATE_AND_PRESSURE)
    print(f"full stroke for {H * full.sum():.2f} s, lag {lag(recording):.2f} deg, {np.degrees(rate):.2f} deg/s")
    assert H * full.sum() > 0.5
    assert rate == pytest.approx(rate_by_the_flow(800, pressure), rel=0.01)
    assert lag(recording) > 1.0


def test_at_6000_rpm_it_takes_a_quarter_of_the_stroke_of_1500_rpm_for_the_same_run():
    slow, fast = (drive(BENCH, *at(rpm), SCHEDULED) for rpm in (1500, 6000))
    strokes = [np.abs(each["front.pump.stroke"]).max() for each in (slow, fast)]
    print(f"strokes {strokes}, lags {lag(slow):.3f} and {lag(fast):.3f} deg")
    assert strokes[0] / strokes[1] == pytest.approx(4.0, rel=0.02)
    assert lag(fast) == pytest.approx(lag(slow), rel=0.01)
    assert fast["front.energy.shaft"][-1] > 3 * slow["front.energy.shaft"][-1]  # idling costs more the faster it turns


@pytest.mark.parametrize("rpm", [800, 6000])
def test_a_step_of_10_deg_is_as_fast_as_the_flow(rpm):
    recording = drive("bench_step_10deg", *at(rpm), "duration=2 s")
    angle = np.degrees(recording["front.bar.angle"])
    between = (angle > 3.0) & (angle < 6.0) & (recording["front.pump.stroke"] > 0.9999)
    rate, pressure = (recording[f"front.motor.{name}"][between].mean() for name in RATE_AND_PRESSURE)
    print(f"{rpm} rpm: {np.degrees(rate):.1f} deg/s")
    assert rate == pytest.approx(rate_by_the_flow(rpm, pressure), rel=0.01)


# ---- a speed that changes

RAMP = over_time("[2 s, 800 rpm]", "[14 s, 6000 rpm]", "[17 s, 800 rpm]")


@pytest.mark.parametrize("schedule", [0, 1])
def test_the_energy_audit_closes_while_the_engine_speeds_up_and_down_through_the_s_curve(schedule):
    recording = drive(BENCH, *RAMP, f"actuator.control.loop.schedule={schedule}")
    asked = np.interp(recording.time, [2.0, 14.0, 17.0], np.array([800, 6000, 800]) * RPM)
    assert recording["front.pump.speed"] == pytest.approx(asked)
    error = np.abs(astray(recording)).max() / recording["front.energy.throughput"][-1]
    print(f"audit {100 * error:.5f} %")
    assert error < 1e-3
    assert H * np.sum(recording["drive.power"][:-1]) == pytest.approx(recording["front.energy.shaft"][-1])


def test_where_the_engine_is_off_the_bar_lets_go_as_fast_as_the_oil_leaks():
    off = over_time("[0.5 s, 3000 rpm]", "[1 s, 0 rpm]")
    frictionless = [f"actuator.front.motor.{name}" for name in ("coulomb_friction=0 Nm", "viscous_friction=0 Nms/rad")]
    small = "manoeuvre.command.knots=[[0 s, 1 deg]]"  # at which the capacitance hardly varies
    recording = drive("bench_step_10deg", *off, *frictionless, small, SCHEDULED, "duration=6 s")
    late = recording.time > 2.0
    decay = -np.polyfit(recording.time[late], np.log(recording["front.bar.angle"][late]), 1)[0]
    motor = circuit().motor
    expected = 4e-13 / (6e-14 + motor.displacement**2 / STIFFNESS)
    print(f"{decay:.4f} 1/s, {expected:.4f} 1/s by the closed form")
    assert decay == pytest.approx(expected, rel=2e-3)
    assert not np.any(recording["front.pump.shaft_power"][late])


# ---- the electric drive


def at_the_shaft(power: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Power (W) at the shaft of a drive that draws `power` (W): less its windings', inverter's and rotor's losses."""
    back = np.sign(power - 6.0)
    constant, heat = 0.096 * speed + back * 0.012 * 24.0, 1.5 * 0.018
    current = (-constant + np.sqrt(constant**2 + 4.0 * heat * (power - 6.0))) / (2.0 * heat)
    return 0.096 * current * speed - (4e-4 * speed + 0.03 * np.tanh(speed / 1.5)) * speed


@pytest.mark.parametrize("settings", [(), ("actuator.drive.machine.current_limit=8 A",)])
def test_the_supply_pays_for_the_pumps_the_rotor_and_the_drives_losses(settings):
    recording = drive(BENCH, ELECTRIC, *settings)
    power, speed = recording["drive.power"][:-1], recording["drive.speed"]
    rotor = 0.5 * 0.004 * (speed[-1] ** 2 - speed[0] ** 2)
    shaft = H * at_the_shaft(power, 0.5 * (speed[:-1] + speed[1:])).sum()
    missing = shaft - rotor - recording["front.energy.shaft"][-1]
    error = abs(missing) / recording["front.energy.throughput"][-1]
    print(f"down to {speed.min() / RPM:.0f} rpm, {100 * error:.5f} % missing")
    assert error < 1e-3
    assert np.abs(astray(recording)).max() < 1e-3 * recording["front.energy.throughput"][-1]


def test_a_drive_without_slip_is_a_constant_speed():
    stiff = [f"actuator.drive.{each}" for each in ("speed_gain=1e4 Nms/rad", "machine.current_limit=1e4 A")]
    electric, constant = drive(BENCH, ELECTRIC, *stiff, "actuator.drive.voltage=1e3 V"), drive(BENCH)
    for name in ("front.bar.angle", "front.motor.pressure", "drive.speed"):
        assert np.abs(electric[name] - constant[name]).max() < 1e-4 * np.abs(constant[name]).max(), name


def test_what_a_weak_drive_cannot_give_its_rotor_does():
    ample, weak = (
        drive("bench_step_10deg", ELECTRIC, f"actuator.drive.machine.current_limit={amperes} A") for amperes in (125, 8)
    )
    speed = weak["drive.speed"]
    given, taken = 0.5 * 0.004 * (speed[0] ** 2 - speed.min() ** 2), weak["front.energy.shaft"][np.argmin(speed)]
    print(f"down to {speed.min() / RPM:.0f} rpm; the rotor gives {given:.0f} of {taken:.0f} J")
    assert ample["drive.speed"].min() > 0.95 * 3000 * RPM
    assert weak["drive.power"].max() <= 0.096 * 8 * 3000 * RPM + 1.5 * 0.018 * 64 + 6 + 0.012 * 24 * 8
    assert given > 0.5 * taken


def test_a_drive_that_stops_saves_its_idling_and_costs_the_step_its_start():
    stopping = (
        "actuator.drive.standby_speed=0 rpm",
        "manoeuvre.command={join: step, knots: [[0 s, 0 deg], [3 s, 8 deg]]}",
    )
    running, stopped = (
        drive("bench_step_10deg", ELECTRIC, each, stopping[1], "duration=5 s") for each in (SCHEDULED, stopping[0])
    )
    waiting = (running.time > 2.5) & (running.time < 3.0)
    saved = running["drive.power"][waiting].mean() - stopped["drive.power"][waiting].mean()
    late = [each.time[np.argmax(np.degrees(each["front.bar.angle"]) > 4.0)] for each in (running, stopped)]
    print(f"saves {saved:.0f} W straight ahead, costs {1e3 * (late[1] - late[0]):.0f} ms of a step")
    assert stopped["drive.speed"][waiting].max() < 1.0
    assert saved > 50.0
    assert 0.02 < late[1] - late[0] < 0.12


# ---- the sedan


@pytest.mark.parametrize("settings", [(ENGINE,), at(800), at(6000), (ELECTRIC,)], ids=lambda each: each[0])
def test_the_roll_reduction_factor_with_another_drive(settings):
    other, constant = (shipped.measured(STEP_STEER, *each).metrics for each in (settings, ()))
    factors = [each["roll_reduction_factor"].value for each in (other, constant)]
    print(f"{settings}: factor {factors[0]:.3f}, {factors[1]:.3f} at a constant 3000 rpm")
    assert factors[0] >= 7
    assert factors[0] <= factors[1] + 1e-3  # 3000 rpm are enough: more speed gains nothing
    assert other["energy_audit_error"].value <= 1e-3


def test_the_engine_follows_the_road_speed_through_its_gears():
    recording = shipped.recording(CIRCLE, None, ENGINE)
    gear, speed = recording["drive.gear"], recording["drive.speed"]
    ratio = np.array([4.23, 2.52, 1.66, 1.22, 1.0])[gear.astype(int) - 1]
    assert speed == pytest.approx(ratio * 3.38 * recording["body.speed"] / 0.313)
    assert gear[0] == 2.0 and gear[-1] == 5.0
    assert np.all(np.diff(gear) >= 0)  # the car speeds up, and no gear hunts
    assert speed.min() > 1500 * RPM
    assert speed[gear < 5].max() <= 2800 * RPM
    for axle in ("front", "rear"):
        np.testing.assert_array_equal(recording[f"{axle}.pump.speed"], speed)
    assert recording["body.lateral_acceleration"].max() / G > 0.8


def test_a_full_circuits_charge_pumps_load_the_electric_drive_too():
    settings = ("actuator=pump_controlled_full", "actuator.drive.kind=electric")
    recording = drive("bench_s_curve", *settings)
    energy = {name: recording[f"front.energy.{name}"][-1] for name in ("shaft", "charge_pump", "charge")}
    speed = recording["drive.speed"]
    taken = H * at_the_shaft(recording["drive.power"][:-1], 0.5 * (speed[:-1] + speed[1:])).sum()
    assert 0.9 * energy["charge"] < energy["charge_pump"] < energy["charge"]
    assert taken == pytest.approx(energy["shaft"] + energy["charge_pump"], rel=2e-3)
