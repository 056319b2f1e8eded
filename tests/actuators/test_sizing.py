"""Sizing: what a system's parts must be for what a car requires."""

import json
import math

import pytest
from typer.testing import CliRunner

from ars_mujoco.actuators.electro_hydrostatic.sizing import SIZING as ELECTRO_HYDROSTATIC
from ars_mujoco.actuators.electromechanical.sizing import SIZING as ELECTROMECHANICAL
from ars_mujoco.actuators.pump_controlled.sizing import SIZING as PUMP_CONTROLLED
from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.actuators.sizing import stated
from ars_mujoco.actuators.valve_controlled.sizing import SIZING as VALVE_CONTROLLED
from ars_mujoco.cli import app as cli
from ars_mujoco.schema.document import read
from ars_mujoco.schema.errors import InputError

SIZINGS = {
    "pump_controlled": PUMP_CONTROLLED,
    "electro_hydrostatic": ELECTRO_HYDROSTATIC,
    "electromechanical": ELECTROMECHANICAL,
}
RPM = math.pi / 30.0


def file_of(name: str):
    return read(actuator_schema(), name, "actuator", [], None).value


def axle(name: str):
    return file_of(name).front


def sized(name: str, **required: float) -> dict:
    sizing = SIZINGS[name]
    return {each.name: each for each in sizing.size(file_of(name), stated(sizing.requirement, **required))}


@pytest.mark.parametrize("name", SIZINGS)
def test_a_shipped_file_is_what_its_requirement_asks_and_at_most_a_twentieth_more(name):
    own = {part: each for part, each in sized(name).items() if "." in part}
    assert own
    for part, each in own.items():
        assert -0.001 < each.in_file / each.value - 1.0 < 0.05, part


@pytest.mark.parametrize("name", ["pump_controlled", "electro_hydrostatic"])
def test_the_motor_gives_the_torque_with_its_friction_and_the_pump_its_rate_with_the_leakage(name):
    parts, front = sized(name, torque=1000.0, rate=1.0, speed=2000.0 * RPM, pressure=150e5), axle(name)
    displacement, pump = parts["motor.displacement"].value, parts["pump.displacement"].value
    assert displacement * 150e5 - 35.0 - 16.5 == pytest.approx(1000.0)
    leaked = (front.pump.leakage + front.motor.leakage) * 150e5
    assert pump * 2000.0 * RPM == pytest.approx(displacement * 1.0 + leaked)


@pytest.mark.parametrize(
    ("name", "part"), [("pump_controlled", "shaft torque"), ("electro_hydrostatic", "machine torque")]
)
def test_the_shaft_takes_the_oils_power_and_the_pumps_loss(name, part):
    parts, loss = sized(name), axle(name).pump.torque_loss
    oil = parts["pump.displacement"].value * 180e5
    at_its_norm = loss.norm * sum(loss.coefficients.values())  # 3000 rpm, 180 bar, full stroke
    assert parts[part].value == pytest.approx(oil + at_its_norm)


def test_the_pump_at_the_valves_is_a_fourteenth_too_small_for_a_loaded_front_at_idle():
    """Its size follows from a published flow, 5.5 L/min at 750 rpm."""
    parts = {
        each.name: each for each in VALVE_CONTROLLED.size(file_of("valve_controlled"), VALVE_CONTROLLED.requirement)
    }
    pump, both = parts["pump.displacement"], parts["flow of both axles"]
    assert pump.in_file / pump.value == pytest.approx(13.0 / 14.0, abs=0.005)
    assert both.in_file * 60e3 == pytest.approx(9.0)
    turned = both.value - 2.0 * 1.75e-13 * 180e5
    assert turned == pytest.approx(2.0 * parts["motor.displacement"].value * math.radians(57.5))


def test_a_gear_takes_the_machine_to_its_speed_at_the_bars_rate():
    parts = sized("electromechanical", torque=1000.0, rate=2.0, speed=400.0)
    assert parts["gear.ratio"].value == pytest.approx(200.0)
    assert parts["machine torque"].value * 200.0 * 0.88 - 8.0 == pytest.approx(1000.0)
    assert parts["machine current"].value * 0.12 == pytest.approx(parts["machine torque"].value)


def test_a_system_without_oil_has_no_pressure():
    with pytest.raises(InputError, match="--pressure: the system has none; allowed: --torque, --rate, --speed"):
        stated(ELECTROMECHANICAL.requirement, pressure=180e5)


def test_the_command_tells_formula_and_what_the_file_has():
    result = CliRunner().invoke(cli.app, ["size", "pump_controlled", "--speed", "1500 rpm", "--json"])
    told = {each["part"]: each for each in json.loads(result.stdout)["dimensions"]}
    assert told["pump.displacement"]["required"] == pytest.approx(2.0 * 1.763, rel=1e-3)
    assert told["pump.displacement"]["in the file"] == pytest.approx(1.8)
    assert told["pump.displacement"]["more than required"] == pytest.approx(1.8 / 3.526 - 1.0, rel=1e-3)
    assert told["motor.displacement"]["formula"] == "(M + r_C + r_v w) / dp"
    plain = CliRunner().invoke(cli.app, ["size", "pump_controlled"]).stdout
    assert "torque 1400 Nm, rate 57.5 deg/s, speed 3000 rpm, pressure 180 bar" in " ".join(plain.split())


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["passive"], "actuator 'passive': its kind, passive, has nothing to size"),
        (["pump_controlled", "--torque", "3 bar"], "--torque: wrong unit; allowed: Nm"),
        (["pump_controlled", "--rate", "0 deg/s"], "--rate: must be greater than 0 deg/s"),
    ],
)
def test_what_cannot_be_sized_is_refused(arguments, problem):
    result = CliRunner().invoke(cli.app, ["size", *arguments])
    assert problem in str(result.exception.problems)
