"""Catalogue: pumps by name, at their own size or at another."""

import math

import pytest

from ars_mujoco.hydraulics.pump import Pump
from ars_mujoco.hydraulics.pump_catalogue import catalogue_pump
from ars_mujoco.schema.errors import InputError
from ars_mujoco.schema.library import shipped
from ars_mujoco.studies.inputs import read_inputs

RPM, BAR, CUBIC_CENTIMETER = math.pi / 30.0, 1e5, 1e-6 / (2.0 * math.pi)
# at p_norm and 3000 rpm: volumetric and hydro-mechanical efficiency; drag (Nm) at 5 bar
EXPECTED = {
    "axial_piston": (0.955, 0.913, None),
    "radial_piston": (0.96, 0.945, 0.40),
    "vane": (0.92, 0.893, 1.15),
    "gear": (0.94, 0.91, None),
    "bent_axis": (0.94, 0.935, None),
}


def bench(*settings: str):
    return read_inputs("bench_step_1deg", "pump_controlled", settings=settings).actuator.value.front.pump


def test_these_are_shipped():
    assert set(shipped("pump")) == set(EXPECTED)


@pytest.mark.parametrize("name", EXPECTED)
def test_its_efficiencies_are_those_published_or_judged(name):
    pump, (volumetric, mechanical, drag) = catalogue_pump(name), EXPECTED[name]
    speed, pressure = 3000.0 * RPM, pump.torque_loss.normal_pressure
    assert 1.0 - pump.leakage * pressure / (pump.displacement * speed) == pytest.approx(volumetric, abs=0.001)
    ideal = pump.displacement * pressure
    assert ideal / (ideal + pump.torque_loss.at(1.0, speed, pressure)) == pytest.approx(mechanical, abs=0.001)
    assert drag is None or pump.torque_loss.at(1.0, speed, 5.0 * BAR) == pytest.approx(drag, rel=0.02)


def test_at_its_own_size_it_is_as_it_is():
    pump = catalogue_pump("vane")
    assert pump.sized(pump.displacement) == pump


def test_a_similar_pump_loses_the_same_shares_at_the_same_speed_of_its_sliding_parts():
    large = catalogue_pump("radial_piston")
    small = large.sized(large.displacement / 8.0)  # half the lengths, twice the speed
    for stroke, speed, pressure in ((1.0, 3000.0 * RPM, 180.0 * BAR), (0.3, 1000.0 * RPM, 40.0 * BAR)):
        torques = small.torque_loss.at(stroke, 2.0 * speed, pressure), large.torque_loss.at(stroke, speed, pressure)
        assert torques[0] == pytest.approx(torques[1] / 8.0)
        flows = small.leakage * pressure / (small.displacement * 2.0 * speed), large.leakage * pressure
        assert flows[0] == pytest.approx(flows[1] / (large.displacement * speed))
    assert small.boundary_friction.decay_speed == pytest.approx(2.0 * large.boundary_friction.decay_speed)


def test_an_actuator_takes_a_pump_by_name_at_its_own_size():
    pump = bench("actuator.front.pump={like: radial_piston, speed: 3000 rpm}")
    known = catalogue_pump("radial_piston")
    assert pump == Pump(
        displacement="7.4 cm^3/rev",
        speed="3000 rpm",
        leakage=f"{known.leakage!r} m^3/s/Pa",
        torque_loss=known.torque_loss,
    )


def test_or_at_another_and_what_it_states_besides_stands():
    pump = bench(
        "actuator.front.pump={like: vane, displacement: 1.8 cm^3/rev, speed: 2000 rpm, leakage: 1e-13 m^3/s/Pa}"
    )
    assert pump.displacement == pytest.approx(1.8 * CUBIC_CENTIMETER)
    assert pump.speed == pytest.approx(2000.0 * RPM)
    assert pump.leakage == 1e-13
    assert pump.torque_loss == catalogue_pump("vane").sized(pump.displacement).torque_loss


def test_an_electro_hydrostatic_unit_takes_one_with_its_boundary_friction():
    setting = "actuator.front.pump={like: bent_axis, displacement: 1.8 cm^3/rev}"
    pump = read_inputs("bench_step_1deg", "electro_hydrostatic", settings=[setting]).actuator.value.front.pump
    assert pump.boundary_friction == catalogue_pump("bent_axis").sized(pump.displacement).boundary_friction


def test_the_pumps_that_the_shipped_systems_have_are_in_it():
    own = bench()
    known = catalogue_pump("axial_piston")
    assert (own.displacement, own.torque_loss.coefficients) == (known.displacement, known.torque_loss.coefficients)
    assert known.leakage == pytest.approx(own.leakage)
    gear = read_inputs("bench_step_1deg", "electro_hydrostatic").actuator.value.front.pump
    assert gear.torque_loss.coefficients == catalogue_pump("gear").torque_loss.coefficients


@pytest.mark.parametrize(
    ("pump", "problem"),
    [
        ("{like: vain, speed: 3000 rpm}", "no pump 'vain'"),
        ("{like: vane}", "speed"),
        ("{like: vane, speed: 3000 rpm, displacement: 3 bar}", "wrong unit"),
        ("{like: vane, speed: 9000 rpm}", "outside the range of torque_loss"),
    ],
)
def test_what_is_no_pump_is_refused(pump, problem):
    with pytest.raises(InputError) as error:
        bench(f"actuator.front.pump={pump}")
    assert problem in " ".join(error.value.problems)
