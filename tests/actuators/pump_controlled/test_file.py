"""Pump-controlled bars: what their files must hold for the stage of simplification that they name."""

import pytest

from ars_mujoco.actuators.pump_controlled.file import FullPumpControlled, PumpControlled
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.library import shipped
from ars_mujoco.studies.inputs import read_inputs


def actuator(name="pump_controlled", *settings):
    return read_inputs("bench_step_1deg", name, settings=[f"actuator.{each}" for each in settings]).actuator.value


def test_the_circuit_that_a_file_names_decides_what_it_holds():
    assert type(actuator("pump_controlled")) is PumpControlled
    assert type(actuator("pump_controlled_full")) is FullPumpControlled


def test_a_stage_with_a_cylinder_needs_one(tmp_path):
    text = shipped("actuator")["pump_controlled"].read_text()
    start, end = text.index("  control_cylinder:"), text.index("  charge_power:")
    mine = tmp_path / "mine.yaml"
    mine.write_text(text[:start] + text[end:])
    assert actuator(str(mine)).front.control_cylinder is None
    with pytest.raises(InputError, match="pump_control 'full' needs front.control_cylinder, rear.control_cylinder"):
        actuator(str(mine), "pump_control=full")


def test_a_swash_plate_is_as_fast_as_its_cylinder():
    slow = [f"{axle}.swash_plate.max_rate=100 1/s" for axle in ("front", "rear")]
    assert actuator("pump_controlled", *slow).front.swash_plate.max_rate == 100.0
    with pytest.raises(InputError, match="max_rate is 100 1/s, but its metering edges move its cylinder at 248"):
        actuator("pump_controlled", "pump_control=full", *slow)
