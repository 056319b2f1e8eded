"""Set-up refuses, in one line, what its files' schemas cannot see."""

import pytest

from ars_mujoco.schema.errors import InputError
from ars_mujoco.studies.inputs import read_inputs
from ars_mujoco.studies.study import simulation_of


def problem(*settings: str, cycle: str = "roll_plane_step") -> str:
    with pytest.raises(InputError) as error:
        simulation_of(read_inputs(cycle, settings=settings))
    (line,) = error.value.problems
    return line


def test_a_body_without_mass_is_refused_in_mujocos_words():
    line = problem("vehicle.mass=1e-20 kg")
    assert line.startswith("vehicle: MuJoCo refuses its model: Error: mass and inertia of moving bodies must be larger")
    assert "'body'" in line


def test_a_target_at_which_the_accelerometer_is_ambiguous_is_refused():
    line = problem("controller.reference.target=[[0 g, 0 deg], [0.3 g, 3 deg], [0.32 g, 1 deg], [1 g, 1 deg]]")
    assert line.startswith("controller.reference.target: the roll falls so steeply")


def test_a_target_that_the_car_cannot_hold_is_refused():
    line = problem("controller.reference.target=[[0 g, 0 deg], [2 g, 1 deg]]", cycle="s_curve_120kmh")
    assert line.startswith("controller.reference.target: this vehicle does not hold it: no steady turn at 2.00 g")


@pytest.mark.parametrize(
    ("setting", "part"),
    [
        ("controller.reference.target=[[0 g, 0 deg], [0.8 g, 1e300 deg]]", "controller.reference: "),
        ("actuator.front.motor.displacement=1e300 m^3/rad", "actuator: its values do not go together: "),
        ("vehicle.mass=1e300 kg", "vehicle 'roll_plane': its statics cannot be computed: "),
        ("road.bump.position=1 m", "road.bump: a wheel that starts on it finds no stand: "),
    ],
)
def test_the_part_at_fault_is_blamed(setting, part):
    cycle = "single_wheel_bump" if setting.startswith("road") else "roll_plane_step"
    with pytest.raises(InputError) as error:
        simulation_of(read_inputs(cycle, settings=[setting]))
    assert str(error.value).startswith(part)
