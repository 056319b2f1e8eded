"""A log drives the car: the lateral acceleration of a path as a recorded input, or as many knots with lines between."""

import numpy as np
import pytest
import shipped

from ars_mujoco.excitation.samples import MOST
from ars_mujoco.schema.errors import InputError
from ars_mujoco.simulation.simulation import simulate
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of

CYCLE = """title: A log
description: On the motorway.
rig: sedan
duration: 2 s
speed: 30 m/s
manoeuvre:
  kind: follow
  lateral_acceleration: {COURSE}
"""
FEW = np.linspace(0.0, 2.0, 21)
MANY = np.linspace(0.0, 2.0, 401)


def wanted(times):
    """A triangle, whose corners lie on the times of either."""
    return np.interp(times, [0.0, 0.8, 2.0], [0.0, 2.0, -1.0])


def knots(times, join="linear"):
    return f"{{join: {join}, knots: [{', '.join(f'[{t:.3f} s, {wanted(t):.9f} m/s^2]' for t in times)}]}}"


@pytest.fixture
def inputs(tmp_path):
    """The inputs of a cycle with this course, which may name log.csv."""
    rows = [f"{t:.3f},30,{wanted(t):.9f}" for t in MANY]
    (tmp_path / "log.csv").write_text("\n".join(["t,speed,lateral", *rows]))

    def read(course):
        (tmp_path / "log.yaml").write_text(CYCLE.replace("{COURSE}", course))
        return read_inputs(str(tmp_path / "log.yaml"), "passive")

    return read


def test_a_log_drives_the_car_as_the_same_knots_do(inputs):
    named = "{recorded: {file: log.csv, column: lateral, units: {t: s, lateral: m/s^2}}}"
    recordings = [simulate(simulation_of(inputs(course))) for course in (knots(FEW), knots(MANY), named)]
    few, many, log = (each["driver.steer"] for each in recordings)
    assert np.abs(few).max() > 0.005
    assert many == pytest.approx(few, abs=1e-9)
    assert np.array_equal(many, log)


def test_a_mirrored_log_drives_the_mirrored_way(inputs):
    simulation = simulation_of(inputs(knots(MANY)))
    mirrored, _ = shipped.own_copy(simulation)
    shipped.tables(mirrored).demand.values *= -1.0
    left, right = (simulate(each)["body.roll"] for each in (simulation, mirrored))
    assert right == pytest.approx(-left, abs=1e-9)


@pytest.mark.parametrize(
    ("course", "problem"),
    [
        (knots(MANY, "smooth"), f"knots: holds 401 knots; allowed: 1 to 32, or {MOST} with join: linear"),
        (knots([*FEW, *FEW]), "knots: times of a signal must rise: 0 s comes after 2 s"),
        ("{join: linear}", "lateral_acceleration: needs knots or recorded"),
        (knots(FEW)[:-1] + ", recorded: log.csv}", "recorded: 'log.csv': line 1: needs two columns"),
    ],
)
def test_a_course_that_is_none_is_refused(inputs, course, problem):
    with pytest.raises(InputError) as error:
        inputs(course)
    assert problem in str(error.value)
