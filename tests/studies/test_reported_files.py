"""Files that people reported, read as they should have been, or refused with what is wrong in them."""

from pathlib import Path

import pytest

from ars_mujoco.analysis.fit_losses import fit_losses
from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs

CASES = Path(__file__).parents[3] / "shared/cases"
pytestmark = pytest.mark.skipif(not CASES.is_dir(), reason="the reported files are not beside this checkout")


def refused(read, *arguments, **named):
    with pytest.raises(InputError) as error:
        read(*arguments, **named)
    return str(error.value)


def test_a_table_with_commas_for_decimals_and_for_delimiters_is_refused(tmp_path):
    told = refused(fit_losses, CASES / "decimal_comma/deccomma.csv", (1, 1, 1), tmp_path)
    assert "line 2 has 8 cells, the header 5" in told


def test_american_pressures_and_plain_degrees_celsius_are_read():
    settings = ["actuator.front.relief_valve.pressure=2600 psi", "actuator.front.oil.temperature=50 °C"]
    front = read_inputs("bench_step_1deg", settings=settings).actuator.value.front
    assert front.relief_valve.pressure == pytest.approx(17.926e6, rel=1e-4)
    assert front.oil.temperature == pytest.approx(323.15)


def test_a_list_of_blocks_merges():
    command = read_inputs(str(CASES / "yaml_merge_list/merge.yaml")).cycle.value.manoeuvre.command
    assert (command.join, command.knots) == ("linear", ((0.0, 0.0),))


@pytest.mark.parametrize("cycle", ["bar.yaml", "drive.yaml", "drive_all.yaml"])
def test_published_logs_drive_bar_and_car(cycle):
    assert read_inputs(str(CASES / "public_data" / cycle)).remarks == ()


def test_a_published_car_is_read():
    vehicle = str(CASES / "public_data/bmw320i.yaml")
    assert read_inputs("step_steer_iso7401", vehicle=vehicle).vehicle.value.mass == pytest.approx(1093.3, rel=1e-3)


def test_a_log_without_units_asks_for_its_column_and_its_units():
    told = refused(read_inputs, str(CASES / "public_data/drive_rec.yaml"))
    assert "'drive.csv': line 1: needs two columns" in told and "name one: {file: log.csv, column: " in told


def test_a_published_pump_is_fitted(tmp_path):
    result = fit_losses(CASES / "public_data/p107.csv", (1, 2, 1), tmp_path)
    assert min(result[loss]["r_squared"] for loss in ("flow_loss", "torque_loss")) > 0.9999


@pytest.mark.parametrize("table", ["epoch", "offset", "ms"])
def test_recorded_times_that_miss_the_run_are_told(tmp_path, table):
    for source in (CASES / "recorded_times").glob("*.csv"):
        (tmp_path / source.name).write_bytes(source.read_bytes())
    cycle = (CASES / "recorded_times/rec.yaml").read_text().replace("offset.csv", f"{table}.csv")
    (tmp_path / "rec.yaml").write_text(cycle)
    if table == "ms":
        (remark,) = read_inputs(str(tmp_path / "rec.yaml")).remarks
        assert "'ms.csv' covers 0.00058 s of the run's 4 s" in remark
    else:
        assert "nothing of the run from 0 s to 4 s" in refused(read_inputs, str(tmp_path / "rec.yaml"))


@pytest.mark.parametrize(
    ("cycle", "setting", "told"),
    [
        ("bench_step_1deg", "duration=1e308 s", "duration: '1e308 s': must be at most 3600 s"),
        ("bench_step_1deg", "duration=1 s**9**9**9", "'s**9**9**9' is not a unit"),
        ("single_wheel_bump", "road.bump.side=[left]", "road.bump.side: needs a text; allowed: left, right"),
    ],
)
def test_what_would_exhaust_or_break_a_run_is_refused(cycle, setting, told):
    assert told in refused(read_inputs, cycle, settings=[setting])


def test_aliases_that_repeat_each_other_are_refused():
    told = refused(read_inputs, str(CASES / "robustness/bomb_alias.yaml"))
    assert told.endswith("bomb_alias.yaml: holds more than 50000 values, those counted that aliases repeat")
