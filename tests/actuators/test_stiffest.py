"""Equations that are too fast for a step are told with the one value that makes them so, wherever it stands."""

import pytest

from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of


@pytest.mark.parametrize(
    ("cycle", "actuator", "setting", "told"),
    [
        ("bench_step_1deg", None, "actuator.front.motor.inertia=1e-9 kg*m^2",
         "actuator.front.motor.inertia: 1e-09 kg*m^2 is too small"),
        ("roll_plane_step", None, "actuator.rear.motor.inertia=1e-9 kg*m^2",
         "actuator.rear.motor.inertia: 1e-09 kg*m^2 is too small"),
        ("bench_step_1deg", None, "actuator.front.line.capacitance=1e-20 m^3/Pa",
         "actuator.front.line.capacitance: 1e-20 m^3/Pa is too small"),
        ("bench_step_1deg", "electromechanical", "actuator.front.gear.stiffness=1e15 Nm/rad",
         "actuator.front.gear.stiffness: 1e+15 Nm/rad is too large"),
        ("bench_step_1deg", None, "vehicle.stiffness=1e15 Nm/rad",
         "vehicle: the front bar's stiffness: 1e+15 Nm/rad is too large"),
    ],
)  # fmt: skip
def test_the_value_at_fault_is_named(cycle, actuator, setting, told):
    with pytest.raises(InputError) as error:
        simulation_of(read_inputs(cycle, actuator, settings=[setting]))
    assert str(error.value).startswith(f"{told}: the circuit's fastest eigenvalue, ")
