"""The drive's block of an actuator's file: its default, its kinds, and what it refuses."""

import numpy as np
import pytest

from ars_mujoco.actuators.registry import actuator_schema
from ars_mujoco.machines.engine import Engine
from ars_mujoco.machines.pump_drive import PumpDrive
from ars_mujoco.schema.document import override, read
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

RPM = np.pi / 30


def drive(*settings):
    """The drive of the shipped actuator with settings such as "kind=engine"."""
    overrides = [override(f"drive.{each}") for each in settings]
    return read(actuator_schema(), "pump_controlled", "actuator", overrides).value.drive


def test_the_shipped_drive_is_constant_and_so_is_that_of_a_file_without_one(tmp_path):
    assert drive().kind == "constant"
    text = read(actuator_schema(), "pump_controlled", "actuator").path.read_text()
    block = "drive:\n  kind: constant"
    assert block in text
    own = tmp_path / "own.yaml"
    own.write_text(text.replace(block, "#"))
    assert read(actuator_schema(), own, "actuator").value.drive.kind == "constant"


@pytest.mark.parametrize(("kind", "schema"), [("engine", Engine), ("electric", PumpDrive)])
def test_naming_the_kind_is_enough(kind, schema):
    assert drive(f"kind={kind}") == schema(kind=kind)


def test_values_carry_units():
    engine = drive("kind=engine", "idle_speed=700 rpm", "ratios=[3.8, 2.2, 1.4]", "rolling_radius=31 cm")
    assert engine.idle_speed == pytest.approx(700 * RPM)
    assert engine.ratios == (3.8, 2.2, 1.4)
    assert engine.rolling_radius == pytest.approx(0.31)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["kind=diesel"], r"drive.kind: 'diesel': unknown.*allowed: constant, table, engine, electric"),
        (["kind=constant", "speed=3000 rpm"], r"drive.speed: unknown key"),
        (["kind=engine", "ratios=[]"], r"drive.ratios: ratios takes 1 to 10 gears, not 0"),
        (["kind=engine", f"ratios={list(range(11, 0, -1))}"], r"1 to 10 gears, not 11"),
        (["kind=engine", "ratios=[2, 3]"], r"ratios must fall from gear to gear"),
        (["kind=engine", "ratios=[2, -1]"], r"drive.ratios.1: '-1': must be greater than 0"),
        (["kind=engine", "idle_speed=7000 rpm"], r"drive: max_speed must be above idle_speed"),
        (["kind=engine", "max_speed=700 rpm"], r"drive.max_speed: '700 rpm': max_speed must be above idle_speed"),
        (["kind=engine", "upshift_speed=7000 rpm"], r"upshift_speed must lie between idle_speed and max_speed"),
        (["kind=engine", "downshift_speed=1700 rpm"], r"upshift_speed must be more than 1.68 times downshift_speed"),
        (["kind=engine", "rolling_radius=0 m"], r"drive.rolling_radius: '0 m': must be greater than 0 m"),
        (["kind=electric", "machine.modulation=110 %"], r"drive.machine.modulation: '110 %': must be at most 100 %"),
        (["kind=electric", "inertia=0 kg*m^2"], r"drive.inertia.*must be greater than 0"),
        (["kind=table"], r"drive.speed: is missing"),
        (["kind=table", "speed={knots: [[0 s, -1 rpm]]}"], r"drive.speed.knots.0.1: '-1 rpm': must be at least 0 rpm"),
        (["kind=table", "speed={knots: [[1 s, 1 rpm], [0 s, 1 rpm]]}"], r"times of a signal must rise"),
    ],
)
def test_what_cannot_be_is_refused_by_name(settings, message):
    with pytest.raises(InputError, match=message):
        drive(*settings)


@pytest.mark.parametrize("cycle", ["bench_step_1deg", "roll_plane_step"])
def test_an_engine_needs_a_road(cycle):
    with pytest.raises(InputError, match="drive.kind: 'engine' turns with the road speed, which this rig has not"):
        simulation_of(read_inputs(cycle, settings=["actuator.drive.kind=engine"]))
